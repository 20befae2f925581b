#include "fit/arc.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit/continuation.h"

namespace lobelight {

namespace {

// Points at which the strip is evaluated: per lobe along the axis, and across it.
constexpr int kStepsPerLobe = 10;
constexpr int kPointsAcross = 16;
// Ward's points lie within this distance of the axis, in t; 1e-5 of the light lies beyond.
constexpr double kWardReachAcross = 3.1;

bool is_ggx(const Brdf& brdf) { return brdf.name() == "ggx"; }

// The light at a point of t.
struct Reflection {
  glm::dvec3 light;
  double o_dot_h;
  double area;  // solid angle of light per area of t; 0 where no light comes from
};

class Strip {
 public:
  Strip(const Brdf& brdf, const glm::dvec3& o);

  // At a along the axis and b across it.
  Reflection reflect(double a, double b) const;
  // The length of light per a at (a, b).
  double length_per_step(double a, double b) const;
  double reflected(double a, double b) const;  // ρ(i, o) i_z · area

  // The square of the ratio of the strip's width to its length; 1 if the highlight is round.
  double ratio() const { return ratio_; }

 private:
  const Brdf& brdf_;
  glm::dvec3 o_;
  glm::dvec2 along_;
  glm::dvec2 across_;
  double ratio_;
};

// About the mirror direction |di|² = 4 dt·M dt with
//   M_11 = α_x² (o_x² + o_z²),  M_12 = α_x α_y o_x o_y,  M_22 = α_y² (o_y² + o_z²),
// whose eigenvalues are the squares of the half axes; its determinant is (α_x α_y o_z)².
Strip::Strip(const Brdf& brdf, const glm::dvec3& o) : brdf_(brdf), o_(o) {
  const glm::dvec2 alpha = brdf.alpha();
  const double xx = alpha.x * alpha.x * (o.x * o.x + o.z * o.z);
  const double yy = alpha.y * alpha.y * (o.y * o.y + o.z * o.z);
  const double xy = alpha.x * alpha.y * o.x * o.y;
  const double half_difference = 0.5 * (xx - yy);
  const double root = std::hypot(half_difference, xy);
  // The eigenvector can be written in two ways; this is the one without cancellation. For views in
  // the first quadrant, where tables have them, both point into it.
  along_ = half_difference >= 0.0 ? glm::dvec2(root + half_difference, xy)
                                  : glm::dvec2(xy, root - half_difference);
  const double length = glm::length(along_);
  along_ = length > 0.0 ? along_ / length : glm::dvec2(1.0, 0.0);
  across_ = {-along_.y, along_.x};
  const double product = alpha.x * alpha.y * o.z / (0.5 * (xx + yy) + root);
  ratio_ = std::min(1.0, product * product);
}

Reflection Strip::reflect(double a, double b) const {
  const glm::dvec2 alpha = brdf_.alpha();
  const glm::dvec2 slope = alpha * (a * along_ + b * across_);
  const glm::dvec3 h = glm::normalize(glm::dvec3(slope, 1.0));
  const double o_dot_h = glm::dot(o_, h);
  const glm::dvec3 light = glm::normalize(2.0 * o_dot_h * h - o_);
  const bool shines = o_dot_h > 0.0 && light.z > 0.0;
  return {light, o_dot_h, shines ? 4.0 * o_dot_h * h.z * h.z * h.z * alpha.x * alpha.y : 0.0};
}

double Strip::length_per_step(double a, double b) const {
  constexpr double kStep = 1e-4;
  const glm::dvec3 d = reflect(a + kStep, b).light - reflect(a - kStep, b).light;
  return glm::length(d) / (2.0 * kStep);
}

double Strip::reflected(double a, double b) const {
  const Reflection there = reflect(a, b);
  return there.area > 0.0 ? brdf_.evaluate(there.light, o_) * there.light.z * there.area : 0.0;
}

// A piece of the strip, or a cell made of pieces.
struct Piece {
  double weight = 0.0;  // the integral of its light
  double place = 0.0;   // the integral of a times the light; in cells, the mean of a
  double aside = 0.0;   // the same of b
  double length = 0.0;  // along the axis, in radians on the sphere
};

// Pieces of equal da from −reach to reach.
std::vector<Piece> cut(const Strip& strip, bool ggx, double reach, int count) {
  std::vector<Piece> pieces(static_cast<std::size_t>(count));
  const double step = 2.0 * reach / count;
  for (int n = 0; n < count; ++n) {
    Piece& piece = pieces[static_cast<std::size_t>(n)];
    const double a = (n + 0.5) * step - reach;
    if (strip.reflect(a, 0.0).area > 0.0) piece.length = step * strip.length_per_step(a, 0.0);
    for (int k = 0; k < kPointsAcross; ++k) {
      // GGX's points are its quantiles across, b = √(1 + a²) x / √(1 − x²).
      const double x = 2.0 * (k + 0.5) / kPointsAcross - 1.0;
      const double root = std::sqrt(1.0 - x * x);
      const double scale = ggx ? std::sqrt(1.0 + a * a) / root : kWardReachAcross;
      const double share = ggx ? scale / (root * root) : scale;
      const double b = scale * x;
      const double weight = strip.reflected(a, b) * share * (2.0 / kPointsAcross) * step;
      piece.weight += weight;
      piece.place += weight * a;
      piece.aside += weight * b;
    }
  }
  return pieces;
}

// Joins the pieces into cells of equal measure (ArcShape::evenness). A piece across a border is
// divided between the two cells.
std::vector<Piece> gather(const std::vector<Piece>& pieces, double step, double evenness,
                          int count) {
  std::vector<double> measure;
  measure.reserve(pieces.size());
  double whole = 0.0;
  for (const Piece& piece : pieces) {
    measure.push_back(piece.weight > 0.0 && piece.length > 0.0
                          ? std::pow(piece.weight / step, evenness) * piece.length
                          : 0.0);
    whole += measure.back();
  }
  std::vector<Piece> cells(static_cast<std::size_t>(count));
  double passed = 0.0;  // in cells
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    const double own = measure[n] * count / whole;
    if (!(own > 0.0)) continue;
    const double end = passed + own;
    for (int cell = static_cast<int>(passed); cell < std::min(count, static_cast<int>(end) + 1);
         ++cell) {
      const double share =
          (std::min(end, cell + 1.0) - std::max(passed, static_cast<double>(cell))) / own;
      if (!(share > 0.0)) continue;
      Piece& into = cells[static_cast<std::size_t>(cell)];
      into.weight += share * pieces[n].weight;
      into.place += share * pieces[n].place;
      into.aside += share * pieces[n].aside;
      into.length += share * pieces[n].length;
    }
    passed = end;
  }
  for (Piece& cell : cells) {
    if (!(cell.weight > 0.0)) continue;
    cell.place /= cell.weight;
    cell.aside /= cell.weight;
  }
  return cells;
}

}  // namespace

ArcShape arc_shape(const Brdf& brdf, double reach) {
  ArcShape shape;
  shape.reach = reach;
  if (is_ggx(brdf)) {
    // These keep the lobes' sizes and distances in proportion to √(1 + a²).
    shape.evenness = 1.0 / 3.0;
    shape.across = 0.63;
    shape.gap = 0.343;
    shape.softness = 0.5;
    shape.drawing_in = 1.05;
  }
  return shape;
}

bool has_arc(std::string_view brdf, const glm::dvec2& alpha) {
  return (brdf == "ward" || brdf == "ward_bounded" || brdf == "ggx") && alpha.x != alpha.y;
}

bool has_arc(const Brdf& brdf) { return has_arc(brdf.name(), brdf.alpha()); }

Mixture arc_lobes(const Brdf& brdf, const glm::dvec3& o, int lobes, const ArcShape& shape,
                  double albedo) {
  const Strip strip(brdf, o);
  const bool ggx = is_ggx(brdf);
  const int steps = kStepsPerLobe * lobes;
  std::vector<Piece> cells =
      gather(cut(strip, ggx, shape.reach, steps), 2.0 * shape.reach / steps, shape.evenness, lobes);

  // Sums over the cells, weighted by their light; variances are in t².
  double whole = 0.0;
  double middle = 0.0;
  double added = 0.0;  // variance that the lobes' widths add, less that within the cells
  double all = 0.0;    // variance of the strip along its axis
  std::vector<double> variance;
  variance.reserve(cells.size());
  for (const Piece& cell : cells) {
    const double a = cell.place;
    const double per_step = std::max(strip.length_per_step(a, cell.aside), 1e-9);
    const double round = ggx ? 1.0 + a * a : 1.0;
    const double across = strip.reflect(a, cell.aside).area / per_step;  // light's width per b
    const double narrow = across * across * shape.across * round;
    const double wanted = shape.gap * shape.gap * cell.length * cell.length;
    variance.push_back(wanted > narrow ? narrow * std::pow(wanted / narrow, shape.softness)
                                       : narrow);
    const double cell_step = cell.length / per_step;
    whole += cell.weight;
    middle += cell.weight * a;
    added += cell.weight * (variance.back() / (per_step * per_step) - cell_step * cell_step / 12.0);
    all += cell.weight * 0.5 * round;
  }
  Mixture mixture;
  mixture.reserve(cells.size());
  if (whole > 0.0) middle /= whole;
  // A strip that is as wide as it is long has no axis: lobes then lie in its middle.
  const double left = all > 0.0 ? 1.0 - shape.drawing_in * std::max(0.0, added / all) : 1.0;
  const double stretch = std::sqrt(std::max(0.0, left) * (1.0 - strip.ratio()));
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const double place = middle + stretch * (cells[k].place - middle);
    Lobe lobe;
    // For very wide materials all points may lie below the horizon; the lobes then lie in the
    // middle and share the albedo equally.
    const double share = whole > 0.0 ? cells[k].weight / whole : 1.0 / lobes;
    lobe.weight = share * albedo;
    lobe.gaussian.mean = strip.reflect(place, cells[k].aside).light;
    lobe.gaussian.kappa = 1.0 / std::max(variance[k], 1e-8);
    mixture.push_back(lobe);
  }
  lift_above_horizon(mixture);
  return mixture;
}

}  // namespace lobelight
