#include "base/one_line.h"

#include <algorithm>
#include <cstddef>

namespace lobelight {

namespace {

constexpr std::size_t kLongestLine = 300;

// The bytes of the UTF-8 character that begins at `at` (RFC 3629: no overlong forms, no surrogates,
// nothing beyond U+10FFFF); 0 where none does.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t n) -> unsigned {
    return at + n < text.size() ? static_cast<unsigned char>(text[at + n]) : 0U;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  for (std::size_t n = 1; n < length; ++n) {
    if ((byte(n) & 0xc0U) != 0x80U) return 0;
  }
  const unsigned second = byte(1);
  const bool is_wrong = (lead == 0xe0 && second < 0xa0) || (lead == 0xed && second > 0x9f) ||
                        (lead == 0xf0 && second < 0x90) || (lead == 0xf4 && second > 0x8f);
  return is_wrong ? 0 : length;
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  for (std::size_t at = 0; at < text.size() && line.size() < kLongestLine;) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) {
      line += '?';
    } else if (length == 1 && (text[at] < ' ' || text[at] == 0x7f)) {
      line += ' ';
    } else {
      line.append(text.substr(at, length));
    }
    at += std::max<std::size_t>(length, 1);
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  return line;
}

}  // namespace lobelight
