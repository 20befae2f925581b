#include "image/radiance_header.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "image/image_error.h"

// Format: Radiance's reference manual, "Picture File Format", and its header.c, resolu.c and
// color.c.

namespace lobelight {
namespace {

constexpr std::size_t kMaxHeaderBytes = 1 << 16;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const auto end = std::find_if(text.begin(), text.end(), is_space);
    words.push_back(text.substr(0, static_cast<std::size_t>(end - text.begin())));
    text.remove_prefix(words.back().size());
  }
  return words;
}

std::string printable(std::string_view text) {
  std::string result(text.substr(0, 40));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

// The numbers of a text, empty where something else is in it.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(text)) {
    const std::string copy(word);
    char* end = nullptr;
    numbers.push_back(std::strtod(copy.c_str(), &end));
    if (*end != '\0' || !std::isfinite(numbers.back())) return {};
  }
  return numbers;
}

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", number);
  return text;
}

struct Axis {
  char name = ' ';
  bool is_negative = false;
  int length = 0;
};

// "-Y 512" of a line's words.
std::optional<Axis> axis_of(std::string_view sign_and_name, std::string_view length) {
  if (sign_and_name.size() != 2) return std::nullopt;
  const char sign = sign_and_name[0];
  Axis axis;
  axis.name = sign_and_name[1];
  axis.is_negative = sign == '-';
  if ((sign != '-' && sign != '+') || (axis.name != 'X' && axis.name != 'Y')) return std::nullopt;
  const char* const last = length.data() + length.size();
  const auto [end, error] = std::from_chars(length.data(), last, axis.length);
  if (error != std::errc() || end != last) return std::nullopt;
  return axis;
}

// Scan lines run along the second axis and follow each other along the first; y counts upwards, so
// that "-Y" begins at the top.
void read_resolution(std::string_view line, RadianceHeader& header, const std::string& name) {
  const std::vector<std::string_view> words = words_of(line);
  std::optional<Axis> outer, inner;
  if (words.size() == 4) {
    outer = axis_of(words[0], words[1]);
    inner = axis_of(words[2], words[3]);
  }
  if (!outer || !inner || outer->name == inner->name) {
    throw ImageError(name, "has the resolution line \"" + printable(line) +
                               "\" instead of one such as \"-Y 512 +X 1024\"");
  }
  const auto is_reversed = [](const Axis& axis) { return axis.is_negative == (axis.name == 'X'); };
  header.by_columns = outer->name == 'X';
  header.lines = outer->length;
  header.length = inner->length;
  header.lines_reversed = is_reversed(*outer);
  header.pixels_reversed = is_reversed(*inner);
}

// What a VIEW shows: the type is the letter behind the last "-vt", a perspective without one.
std::string view_of(std::string_view value) {
  char type = 'v';
  for (const std::string_view word : words_of(value)) {
    if (word.size() == 4 && word.substr(0, 3) == "-vt") type = word[3];
  }
  switch (type) {
    case 'v':
      return "a perspective";
    case 'l':
      return "a parallel projection";
    case 'c':
      return "a cylindrical panorama";
    case 'h':
      return "a hemispherical fisheye";
    case 'a':
      return "an angular fisheye";
    case 's':
      return "a stereographic projection";
    default:
      return "of another kind";
  }
}

class HeaderReader {
 public:
  HeaderReader(const std::vector<std::uint8_t>& bytes, const std::string& name)
      : bytes_(bytes), name_(name) {}

  RadianceHeader read() {
    take_line();  // "#?RADIANCE"
    for (;;) {
      const std::string_view line = take_line();
      if (trimmed(line).empty()) break;
      read_variable(line);
    }
    read_resolution(trimmed(take_line()), header_, name_);
    read_format();
    tell_what_is_left_aside();
    header_.size = position_;
    return header_;
  }

 private:
  std::string_view take_line() {
    const std::string_view all(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
    const std::size_t end = all.find('\n', position_);
    if (end == std::string_view::npos && all.size() <= kMaxHeaderBytes) {
      throw ImageError(name_, "is damaged: its header does not end");
    }
    if (end == std::string_view::npos || end > kMaxHeaderBytes) {
      throw ImageError(name_, "has a header of more than 64 KiB");
    }
    const std::string_view line = all.substr(position_, end - position_);
    position_ = end + 1;
    return line;
  }

  void read_variable(std::string_view line) {
    const std::size_t sign = line.find('=');
    if (line.front() == '#' || sign == std::string_view::npos) return;
    const std::string_view variable = trimmed(line.substr(0, sign));
    const std::string_view value = trimmed(line.substr(sign + 1));
    const bool is_of_a_source = is_space(line.front());
    if (variable == "FORMAT") (is_of_a_source ? format_of_source_ : format_) = value;
    if (is_of_a_source) return;
    const std::vector<double> numbers = numbers_of(value);
    if (variable == "EXPOSURE" && numbers.size() == 1) exposure_ *= numbers[0];
    if (variable == "PIXASPECT" && numbers.size() == 1) aspect_ *= numbers[0];
    if (variable == "GAMMA" && numbers.size() == 1) gamma_ = numbers[0];
    if (variable == "COLORCORR" && numbers.size() == 3) {
      for (std::size_t c = 0; c < 3; ++c) correction_[c] *= numbers[c];
    }
    if (variable == "PRIMARIES" && numbers.size() == 8) {
      const double* n = numbers.data();
      header_.primaries = {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
    }
    if (variable == "VIEW") view_ = view_of(value);
  }

  void read_format() {
    const std::string_view format = format_.empty() ? format_of_source_ : format_;
    header_.is_xyze = format == "32-bit_rle_xyze";
    if (!format.empty() && !header_.is_xyze && format != "32-bit_rle_rgbe") {
      throw ImageError(name_, "has the pixel format \"" + printable(format) +
                                  "\"; only 32-bit_rle_rgbe and 32-bit_rle_xyze are supported");
    }
  }

  void tell_what_is_left_aside() {
    if (exposure_ != 1.0) {
      std::string note = "has an EXPOSURE of " + text_of(exposure_) + ", which is left aside";
      if (exposure_ > 0.0) {
        char text[64];
        std::snprintf(text, sizeof text, "; an Exposure of %+.2f EV takes it back",
                      -std::log2(exposure_));
        note += text;
      }
      header_.notes.push_back(note);
    }
    if (correction_[0] != 1.0 || correction_[1] != 1.0 || correction_[2] != 1.0) {
      header_.notes.push_back("has a COLORCORR of " + text_of(correction_[0]) + ", " +
                              text_of(correction_[1]) + ", " + text_of(correction_[2]) +
                              ", which is left aside");
    }
    if (gamma_ != 1.0) {
      header_.warnings.push_back("has a GAMMA of " + text_of(gamma_) +
                                 ", which is left aside: the light of a panorama is linear");
    }
    if (aspect_ != 1.0) {
      header_.notes.push_back("has a PIXASPECT of " + text_of(aspect_) + ", which is left aside");
    }
    if (!view_.empty()) {
      header_.warnings.push_back("has a VIEW that is " + view_ +
                                 ", but is read as a latitude-longitude panorama");
    }
  }

  const std::vector<std::uint8_t>& bytes_;
  const std::string& name_;
  std::size_t position_ = 0;
  RadianceHeader header_;
  std::string_view format_, format_of_source_;
  std::string view_;
  double exposure_ = 1.0, aspect_ = 1.0, gamma_ = 1.0;
  double correction_[3] = {1.0, 1.0, 1.0};
};

}  // namespace

RadianceHeader read_radiance_header(const std::vector<std::uint8_t>& bytes,
                                    const std::string& name) {
  return HeaderReader(bytes, name).read();
}

}  // namespace lobelight
