// Eight fetches for a coloured BRDF: lobes that the channels share, or a mixture for each channel?
//
//   lobelight_colour_bench [PANORAMA]
//
// Shared lobes are fitted to the mean of the channels, eight of them; each channel's weights follow
// by one of three rules: one step of EM's responsibilities, maximum likelihood (EM on the weights
// until it stands still; fit/channel_weights.h), or least squares with weights ≥ 0 and the
// channel's energy restored. Mixtures for each channel have 3, 3 and 2 lobes, blue getting the two.
//
// For every material: the error of the three channels' mixtures against ρ(i, o) i_z, as
// L1 = Σ_c ∫|m_c − f_c| / Σ_c ∫ f_c and L2 = √(Σ_c ∫(m_c − f_c)² / Σ_c ∫ f_c²), in per cent, mean
// over the views of the grid up to 75°. With a panorama, also the PSNR of the contract's sphere in
// 48 × 48 pixels (DESIGN.md, ./dev compare), lit by the panorama on a coarse grid, lobes convolved
// exactly.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "base/pi.h"
#include "fit/channel_weights.h"
#include "fit/table_fitter.h"
#include "image/panorama.h"

namespace {

using namespace lobelight;

// A lobe of a coloured material: a model times Schlick's Fresnel factor, from `normal` to 1.
struct Layer {
  std::string brdf;
  glm::dvec2 alpha;
  glm::dvec3 normal;   // reflectance at normal incidence
  glm::dvec3 grazing;  // and at grazing incidence
};

class Layered final : public Brdf {
 public:
  Layered(const char* name, const std::vector<Layer>& layers)
      : Brdf(layers.front().alpha), name_(name), layers_(layers) {
    for (const Layer& layer : layers) models_.push_back(make_brdf(layer.brdf, layer.alpha));
  }

  glm::dvec3 evaluate_rgb(const glm::dvec3& i, const glm::dvec3& o) const override {
    if (!(i.z > 0.0) || !(o.z > 0.0)) return glm::dvec3(0.0);
    const double cosine = glm::dot(glm::normalize(i + o), i);
    glm::dvec3 sum(0.0);
    for (std::size_t n = 0; n < layers_.size(); ++n) {
      const glm::dvec3 fresnel =
          glm::mix(layers_[n].normal, layers_[n].grazing, std::pow(1.0 - cosine, 5.0));
      sum += fresnel * models_[n]->evaluate(i, o);
    }
    return sum;
  }
  double evaluate(const glm::dvec3& i, const glm::dvec3& o) const override {
    const glm::dvec3 rgb = evaluate_rgb(i, o);
    return (rgb.x + rgb.y + rgb.z) / 3.0;
  }

  // The layers in equal parts, chosen by u.x.
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override {
    const double scaled = u.x * static_cast<double>(models_.size());
    const auto layer = std::min(static_cast<std::size_t>(scaled), models_.size() - 1);
    auto drawn = models_[layer]->sample(o, {scaled - static_cast<double>(layer), u.y});
    if (!drawn) return drawn;
    drawn->pdf = pdf(drawn->direction, o);
    drawn->weight = evaluate(drawn->direction, o) * drawn->direction.z / drawn->pdf;
    return drawn;
  }
  double pdf(const glm::dvec3& i, const glm::dvec3& o) const override {
    double sum = 0.0;
    for (const auto& model : models_) sum += model->pdf(i, o);
    return sum / static_cast<double>(models_.size());
  }
  std::string_view name() const override { return name_; }
  bool is_coloured() const override { return true; }

 private:
  std::string name_;
  std::vector<Layer> layers_;
  std::vector<std::unique_ptr<Brdf>> models_;
};

// One channel of a coloured BRDF.
class Channel final : public Brdf {
 public:
  Channel(const Brdf& whole, int channel) : Brdf(whole.alpha()), whole_(whole), channel_(channel) {}
  double evaluate(const glm::dvec3& i, const glm::dvec3& o) const override {
    return whole_.evaluate_rgb(i, o)[channel_];
  }
  std::optional<BrdfSample> sample(const glm::dvec3& o, const glm::dvec2& u) const override {
    auto drawn = whole_.sample(o, u);
    if (drawn) drawn->weight = evaluate(drawn->direction, o) * drawn->direction.z / drawn->pdf;
    return drawn;
  }
  double pdf(const glm::dvec3& i, const glm::dvec3& o) const override { return whole_.pdf(i, o); }
  std::string_view name() const override { return "channel"; }

 private:
  const Brdf& whole_;
  int channel_;
};

// A mixture for each channel.
using Colours = std::array<Mixture, 3>;

// Least squares with weights ≥ 0 by coordinate descent: minimises the mean of (Σ_k w_k g_k − f)²
// over the importance-sampled nodes, then restores the channel's energy.
std::vector<glm::dvec3> least_squares(const Brdf& brdf, const glm::dvec3& o, const Slice& slice,
                                      const std::vector<glm::dvec3>& node_weights,
                                      const Mixture& mixture) {
  const std::size_t lobes = mixture.size();
  std::vector<glm::dvec3> result(lobes, glm::dvec3(0.0));
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<double> normal(lobes * lobes, 0.0);
    std::vector<double> right(lobes, 0.0);
    double mass = 0.0;
    for (std::size_t n = 0; n < slice.weights.size(); ++n) {
      const glm::dvec3& i = slice.directions[n];
      const double mean = brdf.evaluate(i, o) * i.z;
      const double solid_angle = slice.weights[n] / mean;
      const double value = node_weights[n][channel] / solid_angle;
      mass += node_weights[n][channel];
      for (std::size_t k = 0; k < lobes; ++k) {
        const double g = density(mixture[k].gaussian, i);
        right[k] += solid_angle * g * value;
        for (std::size_t j = 0; j < lobes; ++j) {
          normal[k * lobes + j] += solid_angle * g * density(mixture[j].gaussian, i);
        }
      }
    }
    std::vector<double> weight(lobes, 0.0);
    for (int sweep = 0; sweep < 2000; ++sweep) {
      for (std::size_t k = 0; k < lobes; ++k) {
        double rest = right[k];
        for (std::size_t j = 0; j < lobes; ++j) {
          if (j != k) rest -= normal[k * lobes + j] * weight[j];
        }
        weight[k] = normal[k * lobes + k] > 0.0 ? std::max(0.0, rest / normal[k * lobes + k]) : 0.0;
      }
    }
    double sum = 0.0;
    for (const double w : weight) sum += w;
    for (std::size_t k = 0; k < lobes; ++k) {
      result[k][channel] = sum > 0.0 ? weight[k] * mass / sum : 0.0;
    }
  }
  return result;
}

Colours coloured(const Mixture& mixture, const std::vector<glm::dvec3>& weights) {
  Colours colours{mixture, mixture, mixture};
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    for (int channel = 0; channel < 3; ++channel) {
      colours[static_cast<std::size_t>(channel)][k].weight = weights[k][channel];
    }
  }
  return colours;
}

// A way to spend eight fetches: the mixtures for any view.
struct Method {
  const char* name;
  std::function<Colours(const glm::dvec3& o)> mixtures;
};

struct Sums {
  double l1 = 0.0;
  double l2 = 0.0;
  int views = 0;
};

void add_errors(const Brdf& brdf, const glm::dvec3& o, const Colours& colours, Sums& sums) {
  const Slice slice = sample_slice(brdf, o, 48, 0.5);
  double difference = 0.0, mass = 0.0, square = 0.0, squares = 0.0;
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    const glm::dvec3& i = slice.directions[n];
    const glm::dvec3 value = brdf.evaluate_rgb(i, o) * i.z;
    const double solid_angle = 3.0 * slice.weights[n] / (value.x + value.y + value.z);
    for (int channel = 0; channel < 3; ++channel) {
      const double f = value[channel];
      const double m = evaluate(colours[static_cast<std::size_t>(channel)], i);
      // Both have the same mass, so ∫|m − f| = 2 ∫ max(0, f − m), which needs nodes only where f
      // is.
      difference += 2.0 * solid_angle * std::max(0.0, f - m);
      mass += solid_angle * f;
      square += solid_angle * (m - f) * (m - f);
      squares += solid_angle * f * f;
    }
  }
  sums.l1 += difference / mass;
  sums.l2 += std::sqrt(square / squares);
  ++sums.views;
}

// The panorama as directions of equal rights, coarse enough for a sum over all of them.
struct Light {
  glm::dvec3 direction;
  glm::dvec3 radiance;  // times the solid angle
};

std::vector<Light> lights(const Panorama& panorama) {
  constexpr int kRows = 96;
  std::vector<Light> result;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < 2 * kRows; ++column) {
      const double theta = kPi * (row + 0.5) / kRows;
      const double phi = kPi * (column + 0.5) / kRows;
      const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                         -std::sin(theta) * std::cos(phi));
      const double solid_angle = std::sin(theta) * (kPi / kRows) * (kPi / kRows);
      result.push_back({d, panorama.sample(d) * solid_angle});
    }
  }
  return result;
}

using Picture = std::vector<glm::dvec3>;
constexpr int kSize = 48;

// The contract's sphere; `response(i, o)` is what the material makes of light from i, in the
// tangent frame.
Picture render(const std::vector<Light>& light,
               const std::function<std::function<glm::dvec3(const glm::dvec3&)>(const glm::dvec3&)>&
                   response_to_view) {
  Picture picture;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const double x = (2.0 * column + 1.0) / kSize - 1.0;
      const double y = 1.0 - (2.0 * row + 1.0) / kSize;
      const double r2 = x * x + y * y;
      if (r2 >= 0.9995) continue;
      const glm::dvec3 normal(x, y, std::sqrt(1.0 - r2));
      const glm::dvec3 tangent = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), normal));
      const glm::dvec3 bitangent = glm::cross(normal, tangent);
      const auto local = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal));
      };
      const auto response = response_to_view(local({0.0, 0.0, 1.0}));
      glm::dvec3 sum(0.0);
      for (const Light& l : light) sum += l.radiance * response(local(l.direction));
      picture.push_back(sum);
    }
  }
  return picture;
}

// PSNR in dB as ./dev compare defines it.
double psnr(const Picture& reference, const Picture& picture) {
  std::vector<double> means;
  for (const glm::dvec3& pixel : reference) means.push_back((pixel.x + pixel.y + pixel.z) / 3.0);
  std::nth_element(means.begin(), means.begin() + static_cast<std::ptrdiff_t>(means.size() / 2),
                   means.end());
  const double exposure = 0.18 / means[means.size() / 2];
  double sum = 0.0;
  for (std::size_t n = 0; n < reference.size(); ++n) {
    for (int channel = 0; channel < 3; ++channel) {
      const auto shown = [&](double value) {
        return std::pow(std::clamp(exposure * value, 0.0, 1.0), 1.0 / 2.2);
      };
      const double difference = shown(picture[n][channel]) - shown(reference[n][channel]);
      sum += difference * difference;
    }
  }
  return -10.0 * std::log10(sum / (3.0 * static_cast<double>(reference.size())));
}

void measure(const Brdf& brdf, const std::vector<Light>& light) {
  Progress progress;
  Recipe recipe;
  const LobeTable shared = fit_table(brdf, recipe, progress, nullptr);
  std::vector<LobeTable> own;
  for (int channel = 0; channel < 3; ++channel) {
    recipe.lobes = channel == 2 ? 2 : 3;
    own.push_back(fit_table(Channel(brdf, channel), recipe, progress, nullptr));
  }

  const auto shared_lobes = [&](const glm::dvec3& o, auto weights) {
    const Mixture mixture = shared.interpolate(o);
    const Slice slice = sample_slice(brdf, o);
    return coloured(mixture, weights(slice, channel_node_weights(brdf, o, slice), mixture));
  };
  const Method methods[] = {
      {"shared, one step",
       [&](const glm::dvec3& o) {
         return shared_lobes(o, [](const Slice& s, const auto& nodes, const Mixture& m) {
           return channel_weights(s, nodes, m, 1);
         });
       }},
      {"shared, likelihood",
       [&](const glm::dvec3& o) {
         return shared_lobes(o, [](const Slice& s, const auto& nodes, const Mixture& m) {
           return channel_weights(s, nodes, m);
         });
       }},
      {"shared, squares",
       [&](const glm::dvec3& o) {
         return shared_lobes(o, [&](const Slice& s, const auto& nodes, const Mixture& m) {
           return least_squares(brdf, o, s, nodes, m);
         });
       }},
      {"3 + 3 + 2",
       [&](const glm::dvec3& o) {
         return Colours{own[0].interpolate(o), own[1].interpolate(o), own[2].interpolate(o)};
       }},
  };

  Picture reference;
  if (!light.empty()) {
    reference = render(light, [&](const glm::dvec3& o) {
      return
          [&brdf, o](const glm::dvec3& i) { return brdf.evaluate_rgb(i, o) * std::max(0.0, i.z); };
    });
  }
  for (const Method& method : methods) {
    Sums sums;
    for (int p = 0; p < shared.views().y; ++p) {
      for (int t = 0; t < shared.views().x; ++t) {
        const glm::dvec3 o = shared.view(t, p);
        if (o.z > 0.25) add_errors(brdf, o, method.mixtures(o), sums);
      }
    }
    std::printf("%-14s %-18s %7.2f %7.2f", std::string(brdf.name()).c_str(), method.name,
                100.0 * sums.l1 / sums.views, 100.0 * sums.l2 / sums.views);
    if (!light.empty()) {
      const Picture picture = render(light, [&](const glm::dvec3& o) {
        return [colours = method.mixtures(o)](const glm::dvec3& i) {
          return glm::dvec3(evaluate(colours[0], i), evaluate(colours[1], i),
                            evaluate(colours[2], i));
        };
      });
      std::printf(" %7.2f", psnr(reference, picture));
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const glm::dvec3 white(1.0);
  const glm::dvec3 glass(0.04);
  const Layered materials[] = {
      {"copper", {{"ggx", {0.15, 0.15}, {0.955, 0.638, 0.538}, white}}},
      {"brushed copper", {{"ggx", {0.08, 0.25}, {0.955, 0.638, 0.538}, white}}},
      {"red vinyl",
       {{"ggx", {0.1, 0.1}, glass, white},
        {"ggx", {0.5, 0.5}, {0.5, 0.05, 0.04}, {0.5, 0.05, 0.04}}}},
      {"blue on gold",
       {{"ggx", {0.1, 0.1}, {0.4, 0.3, 0.13}, white},
        {"ggx", {0.4, 0.4}, {0.05, 0.1, 0.5}, {0.05, 0.1, 0.5}}}},
  };
  try {
    std::vector<Light> light;
    if (argc > 1) light = lights(load_panorama(argv[1]));
    std::printf("material       8 fetches             L1 %%    L2 %%%s\n",
                argc > 1 ? "    dB" : "");
    for (const Layered& material : materials) measure(material, light);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lobelight_colour_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
