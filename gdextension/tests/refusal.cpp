#include "refusal.h"

#include <cstddef>

namespace lobelight::testing {

namespace {

constexpr std::size_t kLongestMessage = 1000;

// Whether `text` is UTF-8 as RFC 3629 has it, without control characters.
bool is_one_clean_line(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t n) -> unsigned {
      return at + n < text.size() ? static_cast<unsigned char>(text[at + n]) : 0U;
    };
    const unsigned lead = byte(0);
    if (lead < 0x80) {
      if (lead < 0x20 || lead == 0x7f) return false;
      ++at;
      continue;
    }
    const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4) return false;
    for (std::size_t n = 1; n < length; ++n) {
      if ((byte(n) & 0xc0U) != 0x80U) return false;
    }
    // Overlong forms, surrogates, and what is beyond U+10FFFF.
    if (lead == 0xe0 && byte(1) < 0xa0) return false;
    if (lead == 0xed && byte(1) > 0x9f) return false;
    if (lead == 0xf0 && byte(1) < 0x90) return false;
    if (lead == 0xf4 && byte(1) > 0x8f) return false;
    at += length;
  }
  return true;
}

}  // namespace

std::string wrong_in_refusal(const std::string& message, const std::string& file) {
  const std::string start = file.empty() ? "" : file + ": ";
  if (message.rfind(start, 0) != 0) return "does not name the file";
  if (message.size() == start.size()) return "gives no reason";
  if (message.size() > kLongestMessage) return "is endless";
  if (!is_one_clean_line(message)) return "is not one line of text";
  return "";
}

}  // namespace lobelight::testing
