#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "fit/slice.h"
#include "sg/mixture.h"

// The native half of ./dev stability. Each case runs a piece of the library on hard input and puts
// what went in and what came out into a record; tools/stability computes the same with 50 digits
// and judges. Doubles are written with 17 digits, so that both sides mean the same numbers.

namespace lobelight::stability {

// One line of JSON. NaN and infinities are written as Python's json module reads them.
class Record {
 public:
  Record& set(std::string_view key, double value);
  Record& set(std::string_view key, int value);
  Record& set(std::string_view key, bool value);
  Record& set(std::string_view key, std::string_view value);
  Record& set(std::string_view key, const char* value) { return set(key, std::string_view(value)); }
  Record& set(std::string_view key, const std::vector<double>& values);
  Record& set(std::string_view key, const glm::dvec2& v) {
    return set(key, std::vector<double>{v.x, v.y});
  }
  Record& set(std::string_view key, const glm::dvec3& v) {
    return set(key, std::vector<double>{v.x, v.y, v.z});
  }
  // Five numbers a lobe: weight, mean, kappa.
  Record& set(std::string_view key, const Mixture& mixture);
  // Four numbers a node: direction, weight.
  Record& set(std::string_view key, const Slice& slice);

  std::string line() const { return '{' + text_ + '}'; }

 private:
  void key(std::string_view name);

  std::string text_;
};

struct Case {
  std::string name;
  std::function<void(Record&)> run;
};

// The groups; `quick` is the reduced set.
std::vector<Case> gaussian_cases(bool quick);
std::vector<Case> brdf_cases(bool quick);
std::vector<Case> step_cases(bool quick);
std::vector<Case> slice_cases(bool quick);
std::vector<Case> data_cases(bool quick);
std::vector<Case> table_cases(bool quick);

// Unit vector at an elevation from the normal and an azimuth, both in degrees.
glm::dvec3 view_at(double elevation, double azimuth);

// Shortest decimal form of a number for the name of a case.
std::string short_number(double value);

}  // namespace lobelight::stability
