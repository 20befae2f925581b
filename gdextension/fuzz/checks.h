#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "brdf/measured_data.h"
#include "image/panorama.h"

// What a fuzzed reader says about itself, and what has to hold of whatever it makes of an input.
namespace lobelight::fuzz {

using Bytes = std::vector<std::uint8_t>;

// Defined by each reader's file: its name, and whole files, small ones, from which inputs are made.
extern const char* const kReader;
std::vector<Bytes> seeds();

// What became of the inputs so far.
struct Counts {
  std::uint64_t accepted = 0;
  std::uint64_t refused = 0;
};
extern Counts counts;

// Called when a property does not hold, with a clause such as "accepts a texel that is no number";
// null: the clause is printed and the program aborted, which is what libFuzzer wants.
extern void (*on_violation)(const std::string& clause);
void require(bool holds, const std::string& clause);

// An accepted picture: the stated size, within the limits, and after sanitise() no texel that is
// negative or no number.
void accept(Panorama picture);

// Accepted measurements: finite and not negative in all channels, down to the horizon.
void accept(const MeasuredData& data);

// A refusal, as testing::wrong_in_refusal() has it; `file` is empty for what is no file.
void refuse(const std::string& message, const std::string& file);

// A file for readers that take a path: $LOBELIGHT_FUZZ_SCRATCH, or one in the system's folder.
std::string scratch_path();
void write_scratch(const std::string& path, const std::uint8_t* bytes, std::size_t count);

}  // namespace lobelight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
