// Runs one reader on mutated files for a while: see usage(). A violated property, a sanitizer's
// report, a crash, an input that takes too long or one that takes too much memory ends the run; the
// input is kept and named in one sentence.

#include <fcntl.h>
#include <sanitizer/common_interface_defs.h>
#include <sanitizer/lsan_interface.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cinttypes>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "checks.h"
#include "coverage.h"
#include "mutator.h"

// Of sanitizer/allocator_interface.h, which g++ does not install; its library has them.
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* pointer);
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace lobelight::fuzz {
namespace {

constexpr unsigned kSecondsAnInput = 20;

// Memory of one input: what a picture within the limits may cost (kMaxPanoramaTexels, twice, as it
// grows), and what a file may cost that is refused: a row of the largest tiles is 768 MiB.
constexpr std::int64_t kMostBytes = std::int64_t{8} << 30;
constexpr std::int64_t kMostBytesRefused = std::int64_t{1} << 30;

struct Options {
  double seconds = 10.0;
  std::uint64_t seed = 1;
  std::uint64_t inputs = ~0ULL;
  std::string keep = ".";
  std::string json;
  std::vector<std::string> files;
};

Options options;
const Bytes* current = nullptr;
std::uint64_t tried = 0;
std::chrono::steady_clock::time_point started;

double elapsed() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

// Only bytes while an input is being read count.
std::atomic<bool> counting{false};
std::atomic<std::int64_t> live{0};
std::atomic<std::int64_t> peak{0};

void write_json(const std::string& failure, const std::string& kept) {
  if (options.json.empty()) return;
  std::FILE* const file = std::fopen(options.json.c_str(), "w");
  if (!file) return;
  std::fprintf(file,
               "{\"reader\": \"%s\", \"inputs\": %" PRIu64 ", \"accepted\": %" PRIu64
               ", \"refused\": %" PRIu64 ", \"blocks\": %" PRIu64
               ", \"seconds\": %.1f, \"failure\": ",
               kReader, tried, counts.accepted, counts.refused, blocks_reached(), elapsed());
  if (failure.empty()) {
    std::fputs("null, \"input\": null}", file);
  } else {
    std::fprintf(file, "\"%s\", \"input\": \"%s\"}", failure.c_str(), kept.c_str());
  }
  std::fclose(file);
}

std::uint64_t fnv1a(const Bytes& bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
  return hash;
}

// Keeps the current input and says what is wrong with it. Also called when the sanitizers are about
// to end the program, and from signal handlers: the state of the heap does not matter any more, and
// a second fault on the way must not begin it again.
void report(const std::string& what) {
  static std::atomic<bool> reported{false};
  if (!current || reported.exchange(true)) return;
  counting = false;
  std::string kept = "the file given";
  if (options.files.empty()) {
    char name[64];
    std::snprintf(name, sizeof name, "/%s-%016" PRIx64, kReader, fnv1a(*current));
    kept = options.keep + name;
    const int file = open(kept.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const auto length = static_cast<ssize_t>(current->size());
    if (file < 0 || write(file, current->data(), current->size()) != length) {
      kept = "an input that could not be kept";
    }
    if (file >= 0) close(file);
  }
  std::fprintf(stderr, "%s: %s %s (input %" PRIu64 " of seed %" PRIu64 ").\n", kReader,
               kept.c_str(), what.c_str(), tried, options.seed);
  write_json(what, kept);
}

[[noreturn]] void fail(const std::string& what) {
  report(what);
  std::fflush(nullptr);
  _exit(1);
}

void on_death() { report("crashes the reader, as the sanitizer's report above says"); }

void on_alarm(int) { fail("takes longer than " + std::to_string(kSecondsAnInput) + " seconds"); }

void on_malloc(const volatile void*, std::size_t size) {
  if (!counting) return;
  const std::int64_t now = live += static_cast<std::int64_t>(size);
  if (now > peak) peak = now;
  if (now > kMostBytes) fail("takes more than 8 GiB of memory");
}

void on_free(const volatile void* pointer) {
  if (!counting || !pointer) return;
  live -= static_cast<std::int64_t>(__sanitizer_get_allocated_size(pointer));
}

// Whether the input was accepted.
bool run(const Bytes& input) {
  const std::uint64_t accepted = counts.accepted;
  current = &input;
  alarm(kSecondsAnInput);
  live = 0;
  peak = 0;
  counting = true;
  LLVMFuzzerTestOneInput(input.data(), input.size());
  counting = false;
  alarm(0);
  ++tried;
  const bool is_accepted = counts.accepted > accepted;
  if (!is_accepted && peak > kMostBytesRefused) {
    fail("takes more than 1 GiB of memory to be refused");
  }
  current = nullptr;
  return is_accepted;
}

int usage(std::FILE* target) {
  std::fprintf(target,
               "usage: lobelight_fuzz_%s [--seconds S] [--inputs N] [--seed N] [--keep DIR] "
               "[--json FILE]\n"
               "       lobelight_fuzz_%s FILE…   (only these inputs)\n",
               kReader, kReader);
  return target == stdout ? 0 : 2;
}

Bytes contents(const std::string& path) {
  std::ifstream stream(std::filesystem::u8path(path), std::ios::binary);
  if (!stream) {
    std::fprintf(stderr, "%s cannot be read\n", path.c_str());
    std::exit(2);
  }
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool parse(int count, char** arguments) {
  for (int n = 1; n < count; ++n) {
    const std::string argument = arguments[n];
    if (argument.rfind("--", 0) != 0) {
      options.files.push_back(argument);
      continue;
    }
    if (n + 1 == count) return false;
    const char* const value = arguments[++n];
    char* end = nullptr;
    if (argument == "--seconds") {
      options.seconds = std::strtod(value, &end);
    } else if (argument == "--inputs") {
      options.inputs = std::strtoull(value, &end, 10);
    } else if (argument == "--seed") {
      options.seed = std::strtoull(value, &end, 10);
    } else if (argument == "--keep") {
      options.keep = value;
    } else if (argument == "--json") {
      options.json = value;
    } else {
      return false;
    }
    if (end && (end == value || *end != '\0')) return false;
  }
  return true;
}

void fuzz_for_a_while() {
  const std::vector<Bytes> files = seeds();
  for (const Bytes& seed : files) {
    if (!run(seed)) {
      current = &seed;
      fail("is a seed, but refused");
    }
  }
  Mutator mutator(files, options.seed);
  std::uint64_t blocks = blocks_reached();
  double next_line = 5.0;
  while (tried < options.inputs && elapsed() < options.seconds) {
    const Bytes input = mutator.next();
    const bool accepted = run(input);
    const bool reaches_more = blocks_reached() > blocks;
    blocks = blocks_reached();
    if (reaches_more || accepted) mutator.keep(input, reaches_more);
    if (elapsed() < next_line) continue;
    next_line += 5.0;
    std::fprintf(stderr, "  %s: %" PRIu64 " inputs, %.0f of %.0f s\n", kReader, tried, elapsed(),
                 options.seconds);
  }
}

}  // namespace
}  // namespace lobelight::fuzz

// Read before main(). Allocations that fail must throw or return null, as without sanitizers; an
// abort (an exception that nobody catches) is reported like any other crash. Leaks are looked for
// by main(), so that they count as a failure like the others.
extern "C" const char* __asan_default_options() {
  return "allocator_may_return_null=1:handle_abort=1:leak_check_at_exit=0";
}
extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1"; }

int main(int count, char** arguments) {
  using namespace lobelight::fuzz;
  if (count == 2 && std::strcmp(arguments[1], "--help") == 0) return usage(stdout);
  if (!parse(count, arguments)) return usage(stderr);
  on_violation = [](const std::string& clause) { fail(clause); };
  std::signal(SIGALRM, on_alarm);
  __sanitizer_set_death_callback(on_death);
  __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);
  started = std::chrono::steady_clock::now();
  if (options.files.empty()) {
    fuzz_for_a_while();
  } else {
    for (const std::string& path : options.files) run(contents(path));
  }
  std::printf("%-8s %9" PRIu64 " inputs, %9" PRIu64 " accepted, %9" PRIu64 " refused, %6" PRIu64
              " basic blocks reached\n",
              kReader, tried, counts.accepted, counts.refused, blocks_reached());
  if (__lsan_do_recoverable_leak_check() != 0) {
    const char* const leak = "leaks memory, as the sanitizer's report above says";
    std::fprintf(stderr, "%s: the reader %s.\n", kReader, leak);
    write_json(leak, "");
    return 1;
  }
  write_json("", "");
  return 0;
}
