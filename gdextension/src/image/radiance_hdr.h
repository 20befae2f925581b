#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/panorama.h"

namespace lobelight {

// Whether `bytes` begin as a Radiance picture does ("#?").
bool looks_like_radiance_hdr(const std::vector<std::uint8_t>& bytes);

// Decodes a Radiance picture: RGBE or XYZE; flat, old or new run-length coding; in any of the eight
// orientations. XYZE, and RGBE with PRIMARIES, become Rec. 709; what else of the header matters is
// left aside, as the engine's own loader does, and named in the result's notes. Throws ImageError,
// with `name` for the file, and Cancelled when `progress`, which may be null, is cancelled.
Panorama decode_radiance_hdr(const std::vector<std::uint8_t>& bytes, const std::string& name,
                             std::int64_t max_side = kMaxPanoramaSide,
                             const Progress* progress = nullptr);

}  // namespace lobelight
