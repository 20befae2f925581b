#pragma once

#include <stdexcept>
#include <string>

namespace lobelight {

// An image file that cannot be read or written. The message is one sentence, "FILE: reason".
class ImageError : public std::runtime_error {
 public:
  ImageError(const std::string& file, const std::string& reason)
      : std::runtime_error(file + ": " + reason) {}
};

}  // namespace lobelight
