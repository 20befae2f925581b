// Samples as no analytic slice has them: identical, cancelling, of weight 0, denormal or huge, and
// not numbers at all, as measured data can be.

#include <cmath>
#include <limits>

#include "brdf/brdf.h"
#include "fit/em.h"
#include "fit/initial_guess.h"
#include "fit/slice.h"
#include "stability.h"
#include "stability_em.h"

namespace lobelight::stability {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

const glm::dvec3 kUp(0.0, 0.0, 1.0);
const glm::dvec3 kSide(1.0, 0.0, 0.0);
const glm::dvec3 kAcross(0.0, 1.0, 0.0);
const glm::dvec3 kOblique(0.6, 0.48, 0.64);

struct Data {
  std::string name;
  Slice slice;
};

Slice make_slice(std::vector<glm::dvec3> directions, std::vector<double> weights) {
  double sum = 0.0;
  for (const double w : weights) sum += w;
  return {std::move(directions), std::move(weights), sum};
}

// Points of equal weight all over the sphere, or on the ring z = height.
Slice sphere(int count) {
  std::vector<glm::dvec3> directions;
  for (int n = 0; n < count; ++n) {
    const double z = 1.0 - (2.0 * n + 1.0) / count;
    const double angle = n * 2.39996322972865332;
    const double sine = std::sqrt(1.0 - z * z);
    directions.emplace_back(sine * std::cos(angle), sine * std::sin(angle), z);
  }
  return make_slice(directions, std::vector<double>(directions.size(), 1.0 / count));
}

Slice ring(int count) {
  std::vector<glm::dvec3> directions;
  for (int n = 0; n < count; ++n) {
    const double angle = n * 2.39996322972865332;
    directions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  return make_slice(directions, std::vector<double>(directions.size(), 1.0 / count));
}

// A slice with every eighth node made worse by `damage`.
template <typename F>
Slice damaged(F damage) {
  Slice slice = sample_slice(*make_brdf("ward", {0.1, 0.3}), kOblique, 8);
  for (std::size_t n = 0; n < slice.weights.size(); n += 8) {
    damage(slice.directions[n], slice.weights[n]);
  }
  double sum = 0.0;
  for (const double w : slice.weights) sum += w;
  slice.albedo = sum;
  return slice;
}

std::vector<Data> awkward_data() {
  using Vectors = std::vector<glm::dvec3>;
  using Numbers = std::vector<double>;
  const Vectors axes{kUp, -kUp, kSide, -kSide, kAcross, -kAcross};
  const auto spoil_weight = [](double value) {
    return damaged([=](glm::dvec3&, double& weight) { weight = value; });
  };
  const auto spoil_direction = [](const glm::dvec3& value) {
    return damaged([=](glm::dvec3& direction, double&) { direction = value; });
  };
  return {
      {"one sample", make_slice({kOblique}, {0.7})},
      {"identical samples", make_slice(Vectors(100, kOblique), Numbers(100, 0.01))},
      {"two clusters", make_slice({kUp, kUp, kUp, kSide, kSide}, {0.1, 0.2, 0.1, 0.3, 0.3})},
      {"neighbours 1e-12 apart",
       make_slice({kUp, glm::normalize(glm::dvec3(1e-12, 0.0, 1.0))}, {0.5, 0.5})},
      {"antipodal", make_slice({kUp, -kUp}, {0.5, 0.5})},
      {"antipodal off the axes", make_slice({kOblique, -kOblique}, {0.5, 0.5})},
      {"six axes", make_slice(axes, Numbers(6, 1.0 / 6.0))},
      {"uniform sphere", sphere(2000)},
      {"ring", ring(101)},
      {"no sample", Slice{}},
      {"all weights zero", make_slice({kUp, kSide}, {0.0, 0.0})},
      {"some weights zero", make_slice({kUp, kSide, -kUp}, {0.0, 0.4, 0.0})},
      {"one weight 1e-300", make_slice({kUp, kSide}, {1.0, 1e-300})},
      {"one weight denormal", make_slice({kUp, kSide}, {1.0, kDenormal})},
      {"all weights 1e-300", make_slice({kUp, kSide, kOblique}, Numbers(3, 1e-300))},
      {"all weights denormal", make_slice({kUp, kSide, kOblique}, Numbers(3, 1000.0 * kDenormal))},
      {"least denormal", make_slice({kUp, kSide, kOblique}, Numbers(3, kDenormal))},
      {"weights 1e300", make_slice({kUp, kSide, kOblique}, Numbers(3, 1e300))},
      {"sum overflows", make_slice({kUp, kSide, kOblique}, Numbers(3, 1e308))},
      {"weights NaN", spoil_weight(kNan)},
      {"weights infinite", spoil_weight(kInfinity)},
      {"weights negative", spoil_weight(-1.0)},
      {"directions NaN", spoil_direction({kNan, 0.0, 1.0})},
      {"directions infinite", spoil_direction({0.0, -kInfinity, 0.0})},
      {"directions zero", spoil_direction(glm::dvec3(0.0))},
      {"directions not unit", spoil_direction({3.0, 4.0, 0.0})},
      {"nothing but NaN", make_slice({{kNan, kNan, kNan}, kUp}, {1.0, kNan})},
  };
}

struct Start {
  std::string name;
  Mixture (*make)(const Slice& slice, int lobes);
};

Mixture copies(int lobes, double weight, const glm::dvec3& mean, double kappa) {
  return Mixture(static_cast<std::size_t>(lobes), Lobe{weight, {mean, kappa}});
}

const Start kStarts[] = {
    {"guess", [](const Slice& slice, int lobes) { return initial_guess(slice, lobes); }},
    {"all alike", [](const Slice&, int lobes) { return copies(lobes, 1.0, kSide, 3.0); }},
    {"without weight", [](const Slice&, int lobes) { return copies(lobes, 0.0, -kUp, 0.0); }},
    {"far too narrow", [](const Slice&, int lobes) { return copies(lobes, 1.0, kSide, 1e30); }},
    {"infinite kappa", [](const Slice&, int lobes) { return copies(lobes, 1.0, kUp, kInfinity); }},
    {"NaN weight", [](const Slice&, int lobes) { return copies(lobes, kNan, kUp, 1.0); }},
    {"NaN kappa", [](const Slice&, int lobes) { return copies(lobes, 1.0, kUp, kNan); }},
    {"NaN mean",
     [](const Slice&, int lobes) {
       return copies(lobes, 1.0, {kNan, 0.0, 1.0}, 1.0);
     }},
};

void fit_data(Record& record, const Data& data, const Start& start, int lobes) {
  record.set("slice", data.slice).set("lobes", lobes).set("start_name", start.name);
  describe(record, run_em(data.slice, start.make(data.slice, lobes)));
}

// A reflectance as a file could hold it: every u in some parts of the unit square is answered by
// what `fault` makes of the sample.
class Faulty final : public Brdf {
 public:
  using Fault = void (*)(BrdfSample&);
  explicit Faulty(Fault fault)
      : Brdf({0.1, 0.3}), whole_(make_brdf("ward", {0.1, 0.3})), fault_(fault) {}
  double evaluate(const glm::dvec3& i, const glm::dvec3& o) const override {
    return whole_->evaluate(i, o);
  }
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override {
    auto sample = whole_->sample(o, u);
    if (sample && u.x > 0.4 && u.x < 0.5) {
      fault_(*sample);
    } else if (sample) {
      sum_ += sample->weight;
    }
    return sample;
  }
  double pdf(const glm::dvec3& i, const glm::dvec3& o) const override { return whole_->pdf(i, o); }
  std::string_view name() const override { return "faulty"; }

  // Of the weights of all samples without fault so far.
  double sum() const { return sum_; }

 private:
  std::unique_ptr<Brdf> whole_;
  Fault fault_;
  mutable double sum_ = 0.0;
};

struct NamedFault {
  std::string name;
  Faulty::Fault make;
};

const NamedFault kFaults[] = {
    {"NaN weight", [](BrdfSample& s) { s.weight = kNan; }},
    {"infinite weight", [](BrdfSample& s) { s.weight = kInfinity; }},
    {"negative weight", [](BrdfSample& s) { s.weight = -1.0; }},
    {"NaN direction", [](BrdfSample& s) { s.direction.y = kNan; }},
    {"infinite direction", [](BrdfSample& s) { s.direction.x = kInfinity; }},
};

void fit_faulty(Record& record, Faulty::Fault fault, int lobes) {
  const Faulty brdf(fault);
  const Slice slice = sample_slice(brdf, kOblique, 16);
  record.set("slice", slice)
      .set("lobes", lobes)
      .set("start_name", "guess")
      .set("albedo", slice.albedo)
      .set("expected_albedo", brdf.sum() / 256.0);
  describe(record, run_em(slice, initial_guess(slice, lobes)));
}

}  // namespace

std::vector<Case> data_cases(bool quick) {
  std::vector<Case> cases;
  for (const Data& data : awkward_data()) {
    for (const Start& start : kStarts) {
      for (const int lobes : {1, 2, 8, 32}) {
        if (quick && lobes == 8) continue;
        cases.push_back(
            {"data " + data.name + ", start " + start.name + ", lobes " + std::to_string(lobes),
             [=](Record& record) { fit_data(record, data, start, lobes); }});
      }
    }
  }
  for (const NamedFault& fault : kFaults) {
    cases.push_back({"data measured, " + fault.name,
                     [=](Record& record) { fit_faulty(record, fault.make, 8); }});
  }
  return cases;
}

}  // namespace lobelight::stability
