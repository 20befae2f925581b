#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/panorama.h"

namespace lobelight {

// Whether `bytes` begin as an OpenEXR file does.
bool looks_like_exr(const std::vector<std::uint8_t>& bytes);

// Decodes a scan-line or tiled (level 0) OpenEXR file with half or float channels R, G, B (an A
// beside them is left aside) or Y, in any compression that the linked library knows. The result
// has the size of the display window: what the data window leaves free is 0, what it has beyond
// is cut. Colours with other primaries are converted to Rec. 709. Everything else (deep, several
// parts, integers, luminance/chroma, layers, subsampled channels, cube maps, absurd sizes) throws
// ImageError, as do damaged files. `name` stands for the file in messages.
Panorama decode_exr(const std::vector<std::uint8_t>& bytes, const std::string& name);

enum class ExrPixelType { kHalf, kFloat };

// Writes a ZIP-compressed scan-line OpenEXR file; it appears under its name only when it is
// complete.
// `path`: UTF-8. `channels`: names of the channels. `pixels`: width · height · channels values,
// row by row from the top, interleaved in the order of `channels`. As half, values beyond ±65504
// are stored as ±65504. Throws ImageError when the file cannot be written and
// std::invalid_argument when the sizes do not fit together.
void write_exr(const std::string& path, int width, int height,
               const std::vector<std::string>& channels, const std::vector<float>& pixels,
               ExrPixelType type = ExrPixelType::kFloat);

}  // namespace lobelight
