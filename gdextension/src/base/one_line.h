#pragma once

#include <string>
#include <string_view>

namespace lobelight {

// Text from a file or a recipe for use in a message: one line of UTF-8, without control characters
// and a full stop, of bounded length. A byte that belongs to no character becomes a question mark.
std::string one_line(std::string_view text);

}  // namespace lobelight
