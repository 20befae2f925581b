#pragma once

#include <string>

namespace lobelight::testing {

// What is wrong with the message of a refusal, as a clause, or nothing. A message is one line of
// UTF-8 without control characters that fits into a line of the editor, a reason after "FILE: "; no
// file is named where `file` is empty.
std::string wrong_in_refusal(const std::string& message, const std::string& file);

}  // namespace lobelight::testing
