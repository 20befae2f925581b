#include "brdf/binary_file.h"

namespace lobelight {

namespace {

// Far above any of the databases' files.
constexpr int kMostGib = 2;

InputFile opened(const std::string& path) try {
  return InputFile(path, kMostGib);
} catch (const FileProblem& problem) {
  throw MeasuredFileError(path, problem.what());
}

}  // namespace

BinaryFile::BinaryFile(const std::string& path) : path_(path), file_(opened(path)) {}

void BinaryFile::fail(const std::string& reason) const { throw MeasuredFileError(path_, reason); }

void BinaryFile::require(std::uint64_t offset, std::uint64_t bytes, const std::string& what) const {
  // Written so that no sum can overflow.
  if (offset > size() || bytes > size() - offset) fail("ends before the end of " + what);
}

void BinaryFile::read_bytes(std::uint64_t offset, char* bytes, std::uint64_t count,
                            const std::string& what) {
  require(offset, count, what);
  try {
    file_.read(offset, bytes, count);
  } catch (const FileProblem& problem) {
    fail(problem.what());
  }
}

}  // namespace lobelight
