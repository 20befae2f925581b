// Runs the cases of one group of ./dev stability and prints one line of JSON for each.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "base/pi.h"
#include "stability.h"

namespace lobelight::stability {

namespace {

std::string number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0.0 ? "Infinity" : "-Infinity";
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

}  // namespace

void Record::key(std::string_view name) {
  if (!text_.empty()) text_ += ", ";
  text_ += quoted(name) + ": ";
}

Record& Record::set(std::string_view name, double value) {
  key(name);
  text_ += number(value);
  return *this;
}

Record& Record::set(std::string_view name, int value) {
  key(name);
  text_ += std::to_string(value);
  return *this;
}

Record& Record::set(std::string_view name, bool value) {
  key(name);
  text_ += value ? "true" : "false";
  return *this;
}

Record& Record::set(std::string_view name, std::string_view value) {
  key(name);
  text_ += quoted(value);
  return *this;
}

Record& Record::set(std::string_view name, const std::vector<double>& values) {
  key(name);
  text_ += '[';
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (n > 0) text_ += ", ";
    text_ += number(values[n]);
  }
  text_ += ']';
  return *this;
}

Record& Record::set(std::string_view name, const Mixture& mixture) {
  std::vector<double> values;
  values.reserve(5 * mixture.size());
  for (const Lobe& lobe : mixture) {
    const glm::dvec3& mean = lobe.gaussian.mean;
    values.insert(values.end(), {lobe.weight, mean.x, mean.y, mean.z, lobe.gaussian.kappa});
  }
  return set(name, values);
}

Record& Record::set(std::string_view name, const Slice& slice) {
  std::vector<double> values;
  values.reserve(4 * slice.weights.size());
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    const glm::dvec3& d = slice.directions[n];
    values.insert(values.end(), {d.x, d.y, d.z, slice.weights[n]});
  }
  return set(name, values);
}

glm::dvec3 view_at(double elevation, double azimuth) {
  constexpr double kDegree = kPi / 180.0;
  const double sine = std::sin(elevation * kDegree);
  // Exactly in the planes of symmetry where the azimuth says so.
  const double x = azimuth == 90.0 ? 0.0 : std::cos(azimuth * kDegree);
  return {sine * x, sine * std::sin(azimuth * kDegree), std::cos(elevation * kDegree)};
}

std::string short_number(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

namespace {

struct Group {
  std::string_view name;
  std::vector<Case> (*cases)(bool quick);
};

constexpr Group kGroups[] = {{"gaussian", gaussian_cases}, {"brdf", brdf_cases},
                             {"step", step_cases},         {"slice", slice_cases},
                             {"data", data_cases},         {"table", table_cases}};

void run(const std::vector<Case>& cases) {
  std::printf("{\"cases\": %zu}\n", cases.size());
  std::fflush(stdout);
  for (const Case& one : cases) {
    Record record;
    record.set("name", one.name);
    try {
      one.run(record);
    } catch (const std::exception& error) {
      record.set("exception", std::string_view(error.what()));
    }
    std::printf("%s\n", record.line().c_str());
    std::fflush(stdout);
  }
}

}  // namespace

}  // namespace lobelight::stability

int main(int count, char** arguments) {
  using namespace lobelight::stability;
  const std::string_view wanted = count > 1 ? arguments[1] : "";
  const bool quick = count == 3 && std::string_view(arguments[2]) == "--quick";
  const auto group = std::find_if(std::begin(kGroups), std::end(kGroups),
                                  [&](const Group& g) { return g.name == wanted; });
  if (group == std::end(kGroups) || count > 3 || (count == 3 && !quick)) {
    std::fprintf(stderr, "usage: lobelight_stability GROUP [--quick], GROUP one of");
    for (const Group& g : kGroups) {
      std::fprintf(stderr, " %.*s", static_cast<int>(g.name.size()), g.name.data());
    }
    std::fprintf(stderr, "\n");
    return EXIT_FAILURE;
  }
  run(group->cases(quick));
  return EXIT_SUCCESS;
}
