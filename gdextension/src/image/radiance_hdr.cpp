#include "image/radiance_hdr.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "image/image_error.h"
#include "image/primaries.h"
#include "image/radiance_header.h"

// Format: G. Ward, "Real Pixels", Graphics Gems II, 1991; the run-length codings are those of
// Radiance's color.c.

namespace lobelight {
namespace {

constexpr std::size_t kPixelBytes = 4;

// The file from its first pixel on.
class Reader {
 public:
  Reader(const std::vector<std::uint8_t>& bytes, const RadianceHeader& header,
         const std::string& name)
      : bytes_(bytes), header_(header), name_(name), position_(header.size) {}

  void begin_line(int line) { line_ = line; }

  [[noreturn]] void fail(const std::string& reason) const {
    throw ImageError(name_, reason + " scan line " + std::to_string(line_ + 1) + " of " +
                                std::to_string(header_.lines));
  }

  std::size_t remaining() const { return bytes_.size() - position_; }

  const std::uint8_t* peek(std::size_t count) const {
    if (remaining() < count) fail("is damaged: it ends within");
    return bytes_.data() + position_;
  }

  const std::uint8_t* take(std::size_t count) {
    const std::uint8_t* data = peek(count);
    position_ += count;
    return data;
  }

 private:
  const std::vector<std::uint8_t>& bytes_;
  const RadianceHeader& header_;
  const std::string& name_;
  std::size_t position_;
  int line_ = 0;
};

// New run-length coding: the four components of a line one after the other, each in runs (length
// above 128: one value repeated) and literal stretches.
void read_component_runs(Reader& reader, int length, std::vector<std::uint8_t>& line) {
  for (int component = 0; component < 4; ++component) {
    for (int at = 0; at < length;) {
      const int code = *reader.take(1);
      const bool run = code > 128;
      const int count = run ? code - 128 : code;
      if (count == 0) reader.fail("is damaged: there is a run of no pixels in");
      if (count > length - at) reader.fail("is damaged: a run goes beyond the end of");
      const std::uint8_t* values = reader.take(run ? 1 : static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) {
        line[static_cast<std::size_t>(4 * (at + i) + component)] = values[run ? 0 : i];
      }
      at += count;
    }
  }
}

// Flat pixels and the old run-length coding: a pixel (1, 1, 1, n) repeats the one before n times,
// and each such pixel that follows directly counts 256 times as much.
void read_pixel_runs(Reader& reader, int length, std::vector<std::uint8_t>& line) {
  int shift = 0;
  for (int at = 0; at < length;) {
    const std::uint8_t* pixel = reader.take(kPixelBytes);
    std::uint8_t* target = &line[static_cast<std::size_t>(4 * at)];
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      std::copy_n(pixel, kPixelBytes, target);
      ++at;
      shift = 0;
      continue;
    }
    if (at == 0 || shift > 24) reader.fail("is damaged: a run has no pixel to repeat in");
    const std::int64_t count = static_cast<std::int64_t>(pixel[3]) << shift;
    if (count > length - at) reader.fail("is damaged: a run goes beyond the end of");
    for (std::int64_t i = 0; i < count; ++i) {
      std::copy_n(target - kPixelBytes, kPixelBytes, target + 4 * i);
    }
    at += static_cast<int>(count);
    shift += 8;
  }
}

void read_line(Reader& reader, int length, std::vector<std::uint8_t>& line) {
  const std::uint8_t* start = reader.peek(kPixelBytes);
  const bool by_component = length >= 8 && length < 32768 && start[0] == 2 && start[1] == 2 &&
                            (start[2] << 8 | start[3]) == length;
  if (by_component) {
    reader.take(kPixelBytes);
    read_component_runs(reader, length, line);
  } else {
    read_pixel_runs(reader, length, line);
  }
}

// value = mantissa · 2^(exponent − 136), and an exponent of 0 is black. (Radiance itself adds ½ to
// the mantissa; Godot and most others do not.)
void append_line(const std::uint8_t* pixels, std::size_t bytes, std::vector<float>& rgb) {
  for (std::size_t i = 0; i < bytes; i += kPixelBytes) {
    const float scale = pixels[i + 3] == 0 ? 0.0f : std::ldexp(1.0f, pixels[i + 3] - 136);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      rgb.push_back(static_cast<float>(pixels[i + channel]) * scale);
    }
  }
}

// The values of all lines in the file's order. They are appended line by line, so that a header
// that lies costs no memory.
std::vector<float> read_coded(Reader& reader, const RadianceHeader& header, bool is_flat_size,
                              const Progress* progress) {
  std::vector<float> values;
  std::vector<std::uint8_t> line(kPixelBytes * static_cast<std::size_t>(header.length));
  for (int n = 0; n < header.lines; ++n) {
    throw_if_cancelled(progress);
    reader.begin_line(n);
    read_line(reader, header.length, line);
    append_line(line.data(), line.size(), values);
  }
  if (is_flat_size && reader.remaining() > 0) reader.fail("has pixels left over after");
  return values;
}

std::vector<float> read_values(const std::vector<std::uint8_t>& bytes, const RadianceHeader& header,
                               const std::string& name, const Progress* progress) {
  Reader reader(bytes, header, name);
  const std::size_t flat_size = kPixelBytes * static_cast<std::size_t>(header.lines) *
                                static_cast<std::size_t>(header.length);
  const bool is_flat_size = reader.remaining() == flat_size;
  try {
    return read_coded(reader, header, is_flat_size, progress);
  } catch (const ImageError&) {
    if (!is_flat_size) throw;
  }
  // The pixels have the size that they have without any coding, and what looks like runs in them
  // is none: some of their colours are written as only runs should be.
  std::vector<float> values;
  values.reserve(flat_size / kPixelBytes * 3);
  append_line(bytes.data() + header.size, flat_size, values);
  return values;
}

// From the file's order of scan lines to rows from the top, each from the left.
std::vector<float> in_rows(std::vector<float> values, const RadianceHeader& header) {
  if (!header.by_columns && !header.lines_reversed && !header.pixels_reversed) return values;
  const std::size_t lines = static_cast<std::size_t>(header.lines);
  const std::size_t length = static_cast<std::size_t>(header.length);
  std::vector<float> rows(values.size());
  const float* source = values.data();
  for (std::size_t n = 0; n < lines; ++n) {
    const std::size_t line = header.lines_reversed ? lines - 1 - n : n;
    for (std::size_t i = 0; i < length; ++i, source += 3) {
      const std::size_t at = header.pixels_reversed ? length - 1 - i : i;
      const std::size_t texel = header.by_columns ? at * lines + line : line * length + at;
      std::copy_n(source, 3, &rows[3 * texel]);
    }
  }
  return rows;
}

}  // namespace

bool looks_like_radiance_hdr(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() >= 2 && bytes[0] == '#' && bytes[1] == '?';
}

Panorama decode_radiance_hdr(const std::vector<std::uint8_t>& bytes, const std::string& name,
                             std::int64_t max_side, const Progress* progress) {
  if (!looks_like_radiance_hdr(bytes)) throw ImageError(name, "is not a Radiance picture");
  RadianceHeader header = read_radiance_header(bytes, name);
  check_panorama_size(header.width(), header.height(), name, max_side);
  Panorama image;
  image.width = header.width();
  image.height = header.height();
  image.rgb = in_rows(read_values(bytes, header, name, progress), header);
  image.notes = std::move(header.notes);
  image.warnings = std::move(header.warnings);
  if (header.is_xyze) {
    convert_to_rec709(image, kCieXyz, "XYZE", name);
  } else if (header.primaries) {
    convert_to_rec709(image, *header.primaries, "PRIMARIES", name);
  }
  return image;
}

}  // namespace lobelight
