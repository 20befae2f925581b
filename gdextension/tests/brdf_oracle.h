// Written by tools/oracles/brdf_oracle.py (scipy.integrate.dblquad). Do not edit.
#pragma once

// clang-format off
namespace lobelight::oracle {

// Directional albedo; the view's elevation from the normal and its azimuth in degrees.
struct Albedo {
  const char* brdf;
  double alpha_x, alpha_y, elevation, azimuth, albedo;
};
constexpr Albedo kAlbedos[] = {
    {"ward", 0.1, 0.1, 0.0, 0.0, 0.9710517},
    {"ward", 0.1, 0.1, 40.0, 25.0, 0.7451352},
    {"ward", 0.1, 0.1, 75.0, 90.0, 0.2594887},
    {"ward", 0.05, 0.2, 0.0, 0.0, 0.9422583},
    {"ward", 0.05, 0.2, 40.0, 25.0, 0.7228731},
    {"ward", 0.05, 0.2, 75.0, 90.0, 0.2828850},
    {"ward", 0.5, 0.2, 0.0, 0.0, 0.7235199},
    {"ward", 0.5, 0.2, 40.0, 25.0, 0.5690752},
    {"ward", 0.5, 0.2, 75.0, 90.0, 0.2198488},
    {"ward_bounded", 0.1, 0.1, 0.0, 0.0, 0.9900000},
    {"ward_bounded", 0.1, 0.1, 40.0, 25.0, 0.9863702},
    {"ward_bounded", 0.1, 0.1, 75.0, 90.0, 0.9175236},
    {"ward_bounded", 0.05, 0.2, 0.0, 0.0, 0.9787500},
    {"ward_bounded", 0.05, 0.2, 40.0, 25.0, 0.9753061},
    {"ward_bounded", 0.05, 0.2, 75.0, 90.0, 0.8359454},
    {"ward_bounded", 0.5, 0.2, 0.0, 0.0, 0.8561819},
    {"ward_bounded", 0.5, 0.2, 40.0, 25.0, 0.8128168},
    {"ward_bounded", 0.5, 0.2, 75.0, 90.0, 0.7472677},
    {"ggx", 0.1, 0.1, 0.0, 0.0, 0.9883041},
    {"ggx", 0.1, 0.1, 40.0, 25.0, 0.9836303},
    {"ggx", 0.1, 0.1, 75.0, 90.0, 0.9244174},
    {"ggx", 0.05, 0.2, 0.0, 0.0, 0.9718140},
    {"ggx", 0.05, 0.2, 40.0, 25.0, 0.9676681},
    {"ggx", 0.05, 0.2, 75.0, 90.0, 0.8799945},
    {"ggx", 0.5, 0.2, 0.0, 0.0, 0.8022245},
    {"ggx", 0.5, 0.2, 40.0, 25.0, 0.7882824},
    {"ggx", 0.5, 0.2, 75.0, 90.0, 0.7440952},
    {"charlie", 0.1, 0.1, 0.0, 0.0, 0.0015592},
    {"charlie", 0.1, 0.1, 40.0, 25.0, 0.0224543},
    {"charlie", 0.1, 0.1, 75.0, 90.0, 0.2718866},
    {"charlie", 0.5, 0.5, 0.0, 0.0, 0.0874366},
    {"charlie", 0.5, 0.5, 40.0, 25.0, 0.1634048},
    {"charlie", 0.5, 0.5, 75.0, 90.0, 0.4550338},
};

}  // namespace lobelight::oracle
