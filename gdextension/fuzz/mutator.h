#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace lobelight::fuzz {

// Makes inputs from seeds and from mutants that were accepted or went new ways. The same seeds,
// number and answers give the same inputs on every machine: of the standard library only the
// generator is used, whose numbers the standard fixes, not its distributions.
class Mutator {
 public:
  using Bytes = std::vector<std::uint8_t>;

  // `seeds`: at least one, none empty. Inputs grow to at most twice the longest seed and 4 KiB.
  Mutator(std::vector<Bytes> seeds, std::uint64_t number);

  // The next input: one of the files known, changed in 1 to 8 places.
  Bytes next();

  // Says that the last input was accepted, or that it reached code that none before it has, so
  // that later ones may start from it. Those that reach more are kept as long as there is room.
  void keep(const Bytes& input, bool reaches_more);

 private:
  std::size_t below(std::size_t bound);
  std::size_t place(const Bytes& bytes, std::size_t length);
  const Bytes& any_file();
  void change(Bytes& bytes);

  std::mt19937_64 random_;
  std::vector<Bytes> seeds_;
  std::vector<Bytes> accepted_;
  std::vector<Bytes> far_;  // those that reached more
  std::size_t longest_;
};

}  // namespace lobelight::fuzz
