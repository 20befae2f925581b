#include "table_errors.h"

#include <cmath>

#include "base/pi.h"
#include "fit/view_error.h"

namespace lobelight {

namespace {

constexpr double kHalfPi = 0.5 * kPi;

// Half-way in elevation and azimuth between view (t, p) and the next of each, whatever the spacing.
glm::dvec3 view_between(const LobeTable& table, int t, int p) {
  const double elevation =
      0.5 * (std::acos(table.view(t, p).z) + std::acos(table.view(t + 1, p).z));
  const double azimuth = table.is_isotropic() ? 0.0 : kHalfPi * (p + 0.5) / (table.views().y - 1);
  return {std::sin(elevation) * std::cos(azimuth), std::sin(elevation) * std::sin(azimuth),
          std::cos(elevation)};
}

}  // namespace

TableErrors table_errors(const LobeTable& table, const Brdf& brdf) {
  TableErrors errors;
  const glm::ivec2 views = table.views();
  for (int p = 0; p < views.y; ++p) {
    for (int t = 0; t < views.x; ++t) {
      errors.at_views.add(l1_error(brdf, table.view(t, p), table.mixture_at_view(t, p)));
      if (t == views.x - 1 || (p == views.y - 1 && p > 0)) continue;
      const glm::dvec3 o = view_between(table, t, p);
      errors.between_views.add(l1_error(brdf, o, table.interpolate(o)));
    }
  }
  return errors;
}

}  // namespace lobelight
