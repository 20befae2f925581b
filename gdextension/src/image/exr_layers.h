#pragma once

#include <ImfHeader.h>

#include <string>
#include <vector>

namespace lobelight {

// What an OpenEXR file can be read for: some channels of one part that make up a colour.
struct ExrLayer {
  enum class Kind {
    colour,            // any of R, G, B; those that are missing are 0
    grey,              // Y alone
    luminance_chroma,  // Y, RY, BY, the latter two often with half the columns and rows
  };
  int part = 0;
  // The layer's name, behind "PART:" in files of several parts (the part alone stands for its
  // channels without a layer). Empty for the plain channels of a file with one part.
  std::string label;
  Kind kind = Kind::colour;
  // R, G, B, or Y, or Y, RY, BY as the file has them; "" for one that is missing.
  std::vector<std::string> channels;
};

// The colours of a file with these headers: part by part, plain channels before layers, layers by
// their names. Deep parts have none. A layer "light.diffuse" has channels "light.diffuse.R", …. All
// three of r, g, b and of red, green, blue are colours too, in capitals or not. A Y beside an X is
// a coordinate and no luminance.
std::vector<ExrLayer> find_layers(const std::vector<Imf::Header>& parts);

// The layer of that label, or the first one for an empty label. Throws ImageError, with `name` for
// the file.
ExrLayer choose_layer(const std::vector<Imf::Header>& parts, const std::string& label,
                      const std::string& name);

}  // namespace lobelight
