#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/panorama.h"

namespace lobelight {

// Whether `bytes` begin as a Radiance picture does ("#?").
bool looks_like_radiance_hdr(const std::vector<std::uint8_t>& bytes);

// Decodes a Radiance picture (RGBE; flat, old or new run-length coding; orientation "-Y H +X W").
// Throws ImageError for XYZE, other orientations and damaged files. `name` stands for the file in
// messages.
Panorama decode_radiance_hdr(const std::vector<std::uint8_t>& bytes, const std::string& name);

}  // namespace lobelight
