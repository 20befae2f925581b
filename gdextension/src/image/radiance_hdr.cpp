#include "image/radiance_hdr.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "image/image_error.h"

// Format: G. Ward, "Real Pixels", Graphics Gems II, 1991; the run-length codings are those of
// Radiance's color.c. EXPOSURE and COLORCORR are left aside, as Godot's own loader does: the
// picture is what the file's pixels say.

namespace lobelight {
namespace {

constexpr std::size_t kMaxHeaderBytes = 1 << 16;

class Reader {
 public:
  Reader(const std::vector<std::uint8_t>& bytes, const std::string& name)
      : bytes_(bytes), name_(name) {}

  [[noreturn]] void fail(const std::string& reason) const { throw ImageError(name_, reason); }

  const std::string& name() const { return name_; }

  std::size_t remaining() const { return bytes_.size() - position_; }

  const std::uint8_t* peek(std::size_t count) const {
    if (remaining() < count) fail("ends in the middle of its pixels");
    return bytes_.data() + position_;
  }

  const std::uint8_t* take(std::size_t count) {
    const std::uint8_t* data = peek(count);
    position_ += count;
    return data;
  }

  std::string_view take_line() {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(position_);
    const auto limit = begin + static_cast<std::ptrdiff_t>(std::min(remaining(), kMaxHeaderBytes));
    const auto end = std::find(begin, limit, std::uint8_t{'\n'});
    if (end == limit) fail("is not a complete Radiance picture: its header does not end");
    const std::size_t length = static_cast<std::size_t>(end - begin);
    std::string_view line(reinterpret_cast<const char*>(bytes_.data() + position_), length);
    position_ += length + 1;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

 private:
  const std::vector<std::uint8_t>& bytes_;
  const std::string& name_;
  std::size_t position_ = 0;
};

struct Size {
  int width;
  int height;
};

std::string printable(std::string_view text) {
  std::string result(text.substr(0, 40));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

// "-Y 512 +X 1024": rows from the top, each from the left.
Size parse_resolution(std::string_view line, const Reader& reader) {
  int numbers[2] = {0, 0};
  const char* const signs[2] = {"-Y ", " +X "};
  std::string_view rest = line;
  bool good = true;
  for (int i = 0; i < 2 && good; ++i) {
    const std::size_t length = std::strlen(signs[i]);
    good = rest.substr(0, length) == signs[i];
    if (!good) break;
    rest.remove_prefix(length);
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), numbers[i]);
    good = error == std::errc();
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  }
  if (!good || !rest.empty()) {
    reader.fail("has the resolution line \"" + printable(line) +
                "\"; only \"-Y height +X width\" is supported");
  }
  check_panorama_size(numbers[1], numbers[0], reader.name());
  return {numbers[1], numbers[0]};
}

Size read_header(Reader& reader) {
  reader.take_line();  // "#?RADIANCE"
  for (std::size_t bytes = 0;;) {
    const std::string_view line = reader.take_line();
    if (line.empty()) break;
    bytes += line.size() + 1;
    if (bytes > kMaxHeaderBytes) reader.fail("has a header of more than 64 KiB");
    constexpr std::string_view kFormat = "FORMAT=";
    if (line.substr(0, kFormat.size()) == kFormat &&
        line.substr(kFormat.size()) != "32-bit_rle_rgbe") {
      reader.fail("has the pixel format \"" + printable(line.substr(kFormat.size())) +
                  "\"; only 32-bit_rle_rgbe is supported");
    }
  }
  return parse_resolution(reader.take_line(), reader);
}

// New run-length coding: the four components of a row one after the other, each in runs (length
// above 128: one value repeated) and literal stretches.
void read_component_runs(Reader& reader, int width, std::vector<std::uint8_t>& row) {
  for (int component = 0; component < 4; ++component) {
    for (int column = 0; column < width;) {
      const int code = *reader.take(1);
      const bool run = code > 128;
      const int count = run ? code - 128 : code;
      if (count == 0 || count > width - column) reader.fail("is damaged: a run leaves its row");
      const std::uint8_t* values = reader.take(run ? 1 : static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) {
        row[static_cast<std::size_t>(4 * (column + i) + component)] = values[run ? 0 : i];
      }
      column += count;
    }
  }
}

// Flat pixels and the old run-length coding: a pixel (1, 1, 1, n) repeats the one before n times,
// and each such pixel that follows directly counts 256 times as much.
void read_pixel_runs(Reader& reader, int width, std::vector<std::uint8_t>& row) {
  int shift = 0;
  for (int column = 0; column < width;) {
    const std::uint8_t* pixel = reader.take(4);
    std::uint8_t* target = &row[static_cast<std::size_t>(4 * column)];
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      std::copy_n(pixel, 4, target);
      ++column;
      shift = 0;
      continue;
    }
    if (column == 0 || shift > 24) reader.fail("is damaged: a run without a pixel to repeat");
    const std::int64_t count = static_cast<std::int64_t>(pixel[3]) << shift;
    if (count > width - column) reader.fail("is damaged: a run leaves its row");
    for (std::int64_t i = 0; i < count; ++i) std::copy_n(target - 4, 4, target + 4 * i);
    column += static_cast<int>(count);
    shift += 8;
  }
}

void read_row(Reader& reader, int width, std::vector<std::uint8_t>& row) {
  const std::uint8_t* start = reader.peek(4);
  const bool by_component = width >= 8 && width < 32768 && start[0] == 2 && start[1] == 2 &&
                            (start[2] << 8 | start[3]) == width;
  if (by_component) {
    reader.take(4);
    read_component_runs(reader, width, row);
  } else {
    read_pixel_runs(reader, width, row);
  }
}

// value = mantissa · 2^(exponent − 136), and an exponent of 0 is black. (Radiance itself adds ½ to
// the mantissa; Godot and most others do not.)
void append_row(const std::vector<std::uint8_t>& row, std::vector<float>& rgb) {
  for (std::size_t i = 0; i < row.size(); i += 4) {
    const float scale = row[i + 3] == 0 ? 0.0f : std::ldexp(1.0f, row[i + 3] - 136);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      rgb.push_back(static_cast<float>(row[i + channel]) * scale);
    }
  }
}

}  // namespace

bool looks_like_radiance_hdr(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() >= 2 && bytes[0] == '#' && bytes[1] == '?';
}

Panorama decode_radiance_hdr(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  if (!looks_like_radiance_hdr(bytes)) throw ImageError(name, "is not a Radiance picture");
  Reader reader(bytes, name);
  const Size size = read_header(reader);
  Panorama image;
  image.width = size.width;
  image.height = size.height;
  // The rows are appended as they are decoded, so that a header that lies costs no memory.
  std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(size.width));
  for (int y = 0; y < size.height; ++y) {
    read_row(reader, size.width, row);
    append_row(row, image.rgb);
  }
  return image;
}

}  // namespace lobelight
