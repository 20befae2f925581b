#include "image/exr_layers.h"

#include <ImfChannelList.h>
#include <ImfPartType.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string_view>

#include "base/one_line.h"
#include "image/image_error.h"

namespace lobelight {
namespace {

constexpr int kShown = 6;

bool is_deep(const Imf::Header& header) { return header.hasType() && !Imf::isImage(header.type()); }

// At most kShown of the names, with commas.
template <class Names>
std::string enumerate(const Names& names) {
  std::string text;
  int count = 0;
  for (const std::string& name : names) {
    const std::string shown = one_line(name);
    if (count < kShown) text += (count == 0 ? "" : ", ") + (shown.empty() ? "''" : shown);
    ++count;
  }
  if (count > kShown) text += " and " + std::to_string(count - kShown) + " more";
  return count == 0 ? "none at all" : text;
}

std::vector<std::string> channel_names(const Imf::Header& header) {
  std::vector<std::string> names;
  const Imf::ChannelList& channels = header.channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    names.emplace_back(channel.name());
  }
  return names;
}

// The layers of the channels, "" first where there are plain channels.
std::set<std::string> layer_names(const Imf::Header& header) {
  std::set<std::string> layers;
  for (const std::string& channel : channel_names(header)) {
    const std::size_t dot = channel.rfind('.');
    layers.insert(dot == std::string::npos ? "" : channel.substr(0, dot));
  }
  return layers;
}

std::string in_small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

// The channels of one layer by what they are, however they are spelled.
class LayerChannels {
 public:
  LayerChannels(const Imf::Header& header, const std::string& layer)
      : prefix_(layer.empty() ? "" : layer + ".") {
    for (const std::string& channel : channel_names(header)) {
      if (channel.rfind(prefix_, 0) == 0) names_.push_back(channel.substr(prefix_.size()));
    }
  }

  // The channel with that very name; "" where there is none.
  std::string exactly(const std::string& name) const {
    const bool is_there = std::find(names_.begin(), names_.end(), name) != names_.end();
    return is_there ? prefix_ + name : "";
  }

  // The channel with the first of the names that there is, and in capitals if it can be.
  std::string spelled(std::initializer_list<std::string_view> small) const {
    for (const std::string_view wanted : small) {
      for (const std::string& name : names_) {
        if (in_small_letters(name) == wanted) return prefix_ + name;
      }
    }
    return "";
  }

 private:
  std::string prefix_;
  std::vector<std::string> names_;
};

bool has_gaps(const std::vector<std::string>& channels) {
  return std::find(channels.begin(), channels.end(), "") != channels.end();
}

// Positions, normals and motion are stored as X, Y and Z.
bool has_coordinates(const LayerChannels& channels) { return !channels.spelled({"x"}).empty(); }

// The channels that make up the layer's colours, and their kind; without channels if none do.
ExrLayer colours_of(const LayerChannels& channels) {
  ExrLayer layer;
  layer.channels = {channels.spelled({"r", "red"}), channels.spelled({"g", "green"}),
                    channels.spelled({"b", "blue"})};
  if (!has_gaps(layer.channels)) return layer;
  // One letter more or less may mean anything, but not in capitals.
  layer.channels = {channels.exactly("R"), channels.exactly("G"), channels.exactly("B")};
  if (layer.channels != std::vector<std::string>(3)) return layer;
  layer.channels.clear();
  const std::string luminance = channels.spelled({"y"});
  if (luminance.empty() || has_coordinates(channels)) return layer;
  layer.channels = {luminance, channels.spelled({"ry"}), channels.spelled({"by"})};
  layer.kind = ExrLayer::Kind::luminance_chroma;
  if (has_gaps(layer.channels)) {
    layer.kind = ExrLayer::Kind::grey;
    layer.channels.resize(1);
  }
  return layer;
}

std::string label_of(const std::vector<Imf::Header>& parts, int part, const std::string& layer) {
  if (parts.size() == 1) return layer;
  const Imf::Header& header = parts[static_cast<std::size_t>(part)];
  const std::string name = header.hasName() ? header.name() : std::to_string(part);
  return layer.empty() ? name : name + ":" + layer;
}

}  // namespace

std::vector<ExrLayer> find_layers(const std::vector<Imf::Header>& parts) {
  std::vector<ExrLayer> found;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    if (is_deep(parts[n])) continue;
    for (const std::string& name : layer_names(parts[n])) {
      ExrLayer layer = colours_of(LayerChannels(parts[n], name));
      if (layer.channels.empty()) continue;
      layer.part = static_cast<int>(n);
      layer.label = label_of(parts, layer.part, name);
      found.push_back(layer);
    }
  }
  return found;
}

ExrLayer choose_layer(const std::vector<Imf::Header>& parts, const std::string& label,
                      const std::string& name) {
  if (parts.empty()) throw ImageError(name, "holds no picture at all");
  const std::vector<ExrLayer> layers = find_layers(parts);
  if (label.empty()) {
    if (!layers.empty()) return layers.front();
    if (is_deep(parts[0])) {
      throw ImageError(name, "holds deep data, which is not supported; flatten it before");
    }
    for (const std::string& layer : layer_names(parts[0])) {
      if (!has_coordinates(LayerChannels(parts[0], layer))) continue;
      throw ImageError(name, "has no colours but coordinates, such as positions or normals (" +
                                 enumerate(channel_names(parts[0])) +
                                 "); save CIE XYZ as R, G and B with its chromaticities");
    }
    throw ImageError(
        name, "has none of the channels R, G, B and Y, but " + enumerate(channel_names(parts[0])));
  }
  std::vector<std::string> labels;
  for (const ExrLayer& layer : layers) {
    if (layer.label == label) return layer;
    if (!layer.label.empty()) labels.push_back(layer.label);
  }
  throw ImageError(name,
                   "has no layer '" + one_line(label) + "'; its layers are " + enumerate(labels));
}

}  // namespace lobelight
