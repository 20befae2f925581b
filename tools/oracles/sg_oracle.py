"""Reference values for spherical Gaussians, written to gdextension/tests/sg_oracle.h.

Densities come from scipy.stats.vonmises_fisher where it is stable and from the same formula in
mpmath with 50 digits everywhere; the script stops where the two disagree. Needs scipy and mpmath.

    python tools/oracles/sg_oracle.py
"""

from pathlib import Path

import mpmath as mp
import numpy as np
from scipy.stats import vonmises_fisher

mp.mp.dps = 50

KAPPAS = ["1e-8", "1e-4", "0.03", "0.2499", "0.2501", "1", "5", "20.5", "100", "1e4", "1e7", "1e10"]
# Angles from the mean in units of the lobe's width 1/sqrt(kappa), at most pi.
WIDTHS = ["0", "0.5", "3"]
COVERAGES = ["0.01", "0.47", "0.9", "0.999"]


def log_density(kappa, angle):
    """log of kappa / (4 pi sinh kappa) exp(kappa cos angle), 1/sr."""
    return mp.log(kappa / (4 * mp.pi * mp.sinh(kappa))) + kappa * mp.cos(angle)


def check_against_scipy(kappa, angle, value):
    """SciPy's density in float64: within its own rounding of kappa * cos(angle)."""
    if not 1e-3 <= kappa <= 1e4:
        return
    mean = np.array([0.0, 0.0, 1.0])
    x = np.array([float(mp.sin(angle)), 0.0, float(mp.cos(angle))])
    scipy_value = vonmises_fisher(mean, float(kappa)).logpdf(x)
    assert abs(scipy_value - float(value)) < 1e-11 * (1 + float(kappa)), (kappa, angle)


def literal(value):
    return mp.nstr(mp.mpf(value), 20, min_fixed=0, max_fixed=0)


def main():
    lines = [
        "// Written by tools/oracles/sg_oracle.py (mpmath, 50 digits; checked against",
        "// scipy.stats.vonmises_fisher where that is stable). Do not edit.",
        "#pragma once",
        "",
        "// clang-format off",
        "namespace lobelight::oracle {",
        "",
        "struct LogDensity {",
        "  double kappa, angle, value;",
        "};",
        "constexpr LogDensity kLogDensities[] = {",
    ]
    for kappa in map(mp.mpf, KAPPAS):
        # The angle is a double in the test: exactly that double is used here.
        for angle in sorted({float(min(w / mp.sqrt(kappa), mp.pi)) for w in map(mp.mpf, WIDTHS)}):
            angle = mp.mpf(angle)
            value = log_density(kappa, angle)
            check_against_scipy(kappa, angle, value)
            lines.append(f"    {{{literal(kappa)}, {literal(angle)}, {literal(value)}}},")
    lines += [
        "};",
        "",
        "// 1 - (coth kappa - 1/kappa).",
        "struct MeanResultant {",
        "  double kappa, one_minus_r;",
        "};",
        "constexpr MeanResultant kMeanResultants[] = {",
    ]
    for kappa in map(mp.mpf, KAPPAS):
        lines.append(f"    {{{literal(kappa)}, {literal(1 - mp.coth(kappa) + 1 / kappa)}}},")
    lines += [
        "};",
        "",
        "// 1 - cos of the cap that holds `coverage` of the mass.",
        "struct Coverage {",
        "  double kappa, coverage, one_minus_cosine;",
        "};",
        "constexpr Coverage kCoverages[] = {",
    ]
    for kappa in map(mp.mpf, KAPPAS):
        for text in COVERAGES:
            coverage = mp.mpf(text)
            value = -mp.log(1 - coverage * (1 - mp.exp(-2 * kappa))) / kappa
            lines.append(f"    {{{literal(kappa)}, {text}, {literal(value)}}},")
    lines += ["};", "", "}  // namespace lobelight::oracle", ""]
    target = Path(__file__).resolve().parents[2] / "gdextension" / "tests" / "sg_oracle.h"
    target.write_text("\n".join(lines))


if __name__ == "__main__":
    main()
