#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/primaries.h"

namespace lobelight {

// What a Radiance picture says of itself before its pixels.
struct RadianceHeader {
  // Scan lines are rows or, with `by_columns`, columns; they come one after the other, each of
  // `length` pixels.
  int lines = 0;
  int length = 0;
  bool by_columns = false;
  // Whether the lines, and the pixels of each, run against the picture's own order, which is from
  // the top and from the left.
  bool lines_reversed = false;
  bool pixels_reversed = false;

  bool is_xyze = false;  // CIE XYZ instead of RGB
  std::optional<Primaries> primaries;
  // What else matters and is left aside, as predicates of the file.
  std::vector<std::string> notes, warnings;

  std::size_t size = 0;  // bytes up to the first pixel

  int width() const { return by_columns ? lines : length; }
  int height() const { return by_columns ? length : lines; }
};

// Reads the header of `bytes`. White space around names and values, carriage returns, a missing
// FORMAT and any of the eight orientations are taken; lines that begin with white space describe
// the pictures that this one was made from and count only where they alone name the format.
// Throws ImageError, with `name` for the file.
RadianceHeader read_radiance_header(const std::vector<std::uint8_t>& bytes,
                                    const std::string& name);

}  // namespace lobelight
