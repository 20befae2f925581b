#pragma once

#include <memory>
#include <string>

#include "brdf/measured_data.h"

namespace lobelight {

// The RGL material database's format, RGB files (NAME_rgb.bsdf): J. Dupuy and W. Jakob 2018, "An
// adaptive parameterization for efficient material acquisition and rendering". A tensor file with
//   theta_i, phi_i   the directions o for which there are slices, in radians
//   ndf, sigma       D(m) and the projected area σ(o) of a microfacet surface like the material
//   vndf             (phi_i, theta_i, ·, ·): density of that surface's visible normals
//   rgb              (phi_i, theta_i, 3, ·, ·): ρ(i, o) i_z, divided by D(m)/4σ(o) if jacobian is
//   1,
//                    at the places u to which the visible normals' density maps [0, 1]²
// Normals m are stored over the square as x = √(2 θ_m/π), y = (φ_m + π)/2π, φ_m being relative to
// φ_o in isotropic files, which have at most two nodes of phi_i. Files whose phi_i covers a half or
// a quarter of the circle are continued by point symmetry or by mirroring.
//
// The other fields of a file (description, luminance, valid) are not needed. Values that are
// negative or not finite count as 0.
//
// Throws MeasuredFileError for a file that is anything else, and for one that holds spectra only.
std::unique_ptr<MeasuredData> read_rgl(const std::string& path);

}  // namespace lobelight
