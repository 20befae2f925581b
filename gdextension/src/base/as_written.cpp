#include "base/as_written.h"

#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>
#include <string>

namespace lobelight {

double as_written(float value) {
  if (!std::isfinite(value)) return static_cast<double>(value);
  char digits[32];
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, value);
  // Not std::from_chars, which not every standard library here has for double.
  std::istringstream stream(std::string(digits, end.ptr));
  stream.imbue(std::locale::classic());
  double decimal = static_cast<double>(value);
  stream >> decimal;
  return decimal;
}

}  // namespace lobelight
