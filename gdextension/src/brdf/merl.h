#pragma once

#include <memory>
#include <string>

#include "brdf/measured_data.h"

namespace lobelight {

// The MERL database's format: W. Matusik et al. 2003, "A data-driven reflectance model". Three
// int32 (90, 90, 180), then for red, green and blue 90·90·180 doubles over Rusinkiewicz's angles
// (θ_h, θ_d, φ_d), the last one fastest. Bin k of θ_h begins at (k/90)² · 90°, of θ_d at k · 1°, of
// φ_d at k · 1°; swapping the directions turns φ_d by 180°. Isotropic.
//
// A stored number stands for the middle of its bin (in √θ_h), and between middles the reflectance
// is interpolated. Numbers that are negative (the database's sign for "not measured") or not finite
// take no part in that: the reflectance is the weighted mean of the others, 0 where there is none.
//
// Throws MeasuredFileError for a file that is anything else.
std::unique_ptr<MeasuredData> read_merl(const std::string& path);

}  // namespace lobelight
