#include "image/exr_layers.h"

#include <ImfChannelList.h>
#include <ImfPartType.h>

#include <algorithm>
#include <set>

#include "image/image_error.h"

namespace lobelight {
namespace {

constexpr int kShown = 6;
constexpr std::size_t kLongestLine = 300;

// The bytes of the UTF-8 character that begins at `at` (RFC 3629: no overlong forms, no surrogates,
// nothing beyond U+10FFFF); 0 where none does.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t n) -> unsigned {
    return at + n < text.size() ? static_cast<unsigned char>(text[at + n]) : 0U;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  for (std::size_t n = 1; n < length; ++n) {
    if ((byte(n) & 0xc0U) != 0x80U) return 0;
  }
  const unsigned second = byte(1);
  const bool is_wrong = (lead == 0xe0 && second < 0xa0) || (lead == 0xed && second > 0x9f) ||
                        (lead == 0xf0 && second < 0x90) || (lead == 0xf4 && second > 0x8f);
  return is_wrong ? 0 : length;
}

bool is_deep(const Imf::Header& header) { return header.hasType() && !Imf::isImage(header.type()); }

// At most kShown of the names, with commas.
template <class Names>
std::string enumerate(const Names& names) {
  std::string text;
  int count = 0;
  for (const std::string& name : names) {
    if (count < kShown) text += (count == 0 ? "" : ", ") + one_line(name);
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

std::string label_of(const std::vector<Imf::Header>& parts, int part, const std::string& layer) {
  if (parts.size() == 1) return layer;
  const Imf::Header& header = parts[static_cast<std::size_t>(part)];
  const std::string name = header.hasName() ? header.name() : std::to_string(part);
  return layer.empty() ? name : name + ":" + layer;
}

}  // namespace

std::string one_line(const std::string& text) {
  std::string line;
  for (std::size_t at = 0; at < text.size() && line.size() < kLongestLine;) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) {
      line += '?';
    } else if (length == 1 && (text[at] < ' ' || text[at] == 0x7f)) {
      line += ' ';
    } else {
      line.append(text, at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  return line;
}

std::vector<ExrLayer> find_layers(const std::vector<Imf::Header>& parts) {
  std::vector<ExrLayer> found;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    if (is_deep(parts[n])) continue;
    const Imf::ChannelList& channels = parts[n].channels();
    for (const std::string& name : layer_names(parts[n])) {
      const std::string prefix = name.empty() ? "" : name + ".";
      const auto find = [&](const char* channel) {
        return channels.findChannel(prefix + channel) ? prefix + channel : std::string();
      };
      ExrLayer layer;
      layer.part = static_cast<int>(n);
      layer.label = label_of(parts, layer.part, name);
      layer.channels = {find("R"), find("G"), find("B")};
      if (layer.channels == std::vector<std::string>(3)) {
        layer.channels = {find("Y"), find("RY"), find("BY")};
        if (layer.channels[0].empty()) continue;
        layer.kind = ExrLayer::Kind::luminance_chroma;
        if (layer.channels[1].empty() || layer.channels[2].empty()) {
          layer.kind = ExrLayer::Kind::grey;
          layer.channels.resize(1);
        }
      }
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
    if (is_deep(parts[0])) throw ImageError(name, "holds deep data, which is not supported");
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
