// Written by tools/oracles/rgl_oracle.py (Mitsuba 3's measured BSDF). Do not edit.
#pragma once

// clang-format off
namespace lobelight::oracle {

// The file; elevation and azimuth of o and of i in degrees; reflectance times cosine in the three channels.
struct Reflectance {
  const char* file;
  double o_elevation, o_azimuth, i_elevation, i_azimuth, channels[3];
};
constexpr Reflectance kReflectances[] = {
    {"isotropic", 20.0, 35.0, 30.0, -160.0, {0.0912247, 0.0803674, 0.1008538}},
    {"isotropic", 50.0, -100.0, 45.0, 70.0, {0.0844139, 0.0909538, 0.1909383}},
    {"isotropic", 70.0, 160.0, 60.0, -10.0, {0.1469375, 0.2207751, 0.1216878}},
    {"isotropic", 5.0, -20.0, 80.0, 110.0, {0.0954192, 0.2746390, 0.1244819}},
    {"circle", 20.0, 35.0, 30.0, -160.0, {0.0464742, 0.0590401, 0.0370513}},
    {"circle", 50.0, -100.0, 45.0, 70.0, {0.1898167, 0.1748819, 0.1034029}},
    {"circle", 70.0, 160.0, 60.0, -10.0, {0.2302159, 0.2122598, 0.1633651}},
    {"circle", 5.0, -20.0, 80.0, 110.0, {0.1862895, 0.3178626, 0.3558556}},
    {"half", 20.0, 35.0, 30.0, -160.0, {0.1913573, 0.2181502, 0.1735389}},
    {"half", 50.0, -100.0, 45.0, 70.0, {0.1715041, 0.1606026, 0.1073430}},
    {"half", 70.0, 160.0, 60.0, -10.0, {0.1258582, 0.0888941, 0.0893614}},
    {"half", 5.0, -20.0, 80.0, 110.0, {0.2839783, 0.3331686, 0.3976600}},
    {"quarter", 20.0, 35.0, 30.0, -160.0, {0.2140803, 0.2366104, 0.1655976}},
    {"quarter", 50.0, -100.0, 45.0, 70.0, {0.1325949, 0.1241355, 0.1351043}},
    {"quarter", 70.0, 160.0, 60.0, -10.0, {0.0779911, 0.0999957, 0.0768628}},
    {"quarter", 5.0, -20.0, 80.0, 110.0, {0.0957930, 0.3624032, 0.2398623}},
};

}  // namespace lobelight::oracle
