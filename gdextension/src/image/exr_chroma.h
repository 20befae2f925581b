#pragma once

#include <ImfInputPart.h>

#include <string>
#include <vector>

#include "image/exr_window.h"
#include "image/panorama.h"

namespace lobelight {

// The picture of channels Y, RY and BY, in the file's own primaries; `display` as large as
// check_panorama_size() allows. Chroma may have fewer columns and rows; between them it is linear.
// Throws Cancelled when `progress`, which may be null, is cancelled.
Panorama read_luminance_chroma(Imf::InputPart& part, const Window& display, const Window& data,
                               const std::vector<std::string>& channels, const Progress* progress);

}  // namespace lobelight
