#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/panorama.h"

namespace lobelight {

// Whether `bytes` begin as an OpenEXR file does.
bool looks_like_exr(const std::vector<std::uint8_t>& bytes);

// The layers of a file that decode_exr() takes, in the file's order; an empty name stands for plain
// channels (image/exr_layers.h). Throws ImageError.
std::vector<std::string> exr_layers(const std::vector<std::uint8_t>& bytes,
                                    const std::string& name);

// Decodes a scan-line or tiled (level 0) OpenEXR file in any compression that the linked library
// knows: the channels R, G and B of `layer`, as half, float or whole numbers, those that are
// missing being 0; or Y; or Y, RY and BY. An empty `layer` is the first that there is. The result
// has the size of the display window: what the data window leaves free is 0, what it has beyond is
// cut. Colours with other primaries are converted to Rec. 709. Everything else (deep data,
// subsampled colours, cube maps, absurd sizes, files without such channels) throws ImageError, as
// do damaged files. `name` stands for the file in messages. Throws Cancelled when `progress`, which
// may be null, is cancelled.
Panorama decode_exr(const std::vector<std::uint8_t>& bytes, const std::string& name,
                    const std::string& layer = "", std::int64_t max_side = kMaxPanoramaSide,
                    const Progress* progress = nullptr);

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
