#pragma once

#include "base/progress.h"
#include "image/panorama.h"

namespace lobelight {

// The panorama with at most `width` × `height` texels: each is the mean, over solid angle, of those
// that it stands for, so that the light of the whole stays what it is. One that is no larger comes
// back as it was. Values must be finite (Panorama::sanitise()). Throws Cancelled when `progress`,
// which may be null, is cancelled.
Panorama reduce_panorama(Panorama panorama, int width, int height,
                         const Progress* progress = nullptr);

}  // namespace lobelight
