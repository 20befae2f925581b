#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "allocated_bytes.h"
#include "bake/memory.h"
#include "image/exr.h"
#include "measured_files.h"

namespace lobelight {

namespace {

using testing::TemporaryFile;

// The most that `work` holds at a time beyond what was held before.
template <class Work>
std::size_t peak_of(const Work& work) {
  bench::reset_peak_bytes();
  const std::size_t before = bench::held_bytes();
  work();
  return bench::peak_bytes() - before;
}

template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

SetRecipe large_set(int widths, int lobes, const glm::ivec2& views) {
  SetRecipe recipe;
  for (int n = 0; n < widths; ++n) recipe.widths.push_back(0.01 + 0.03 * n);
  recipe.lobes = lobes;
  recipe.views = views;
  return recipe;
}

}  // namespace

TEST_CASE("a table's bake needs no more memory than its bound") {
  for (const int threads : {1, 4}) {
    TableRequest request;
    request.recipe.brdf = "ggx";
    request.recipe.alpha = {0.1, 0.3};
    request.recipe.lobes = 4;
    request.recipe.views = {4, 4};
    request.recipe.threads = threads;
    Progress progress;
    CHECK(peak_of([&] { bake_table(request, progress); }) <= memory_bound(request));
  }
}

TEST_CASE("the bake of measurements needs no more memory than its bound") {
  const TemporaryFile file(".binary");
  file.write(testing::merl_file([](const glm::dvec3& i, const glm::dvec3& o) {
    const double value = make_brdf("ggx", {0.3, 0.3})->evaluate(i, o);
    return glm::dvec3(0.9 * value, 0.5 * value, 0.1 * value);
  }));
  TableRequest request;
  request.recipe.brdf = file.path();
  request.recipe.alpha = {0.0, 0.0};
  request.recipe.lobes = 32;
  request.recipe.views = {2, 1};
  request.recipe.threads = 2;
  Progress progress;
  LobeCountOptions options;
  options.fit.em.max_iterations = 3;
  CHECK(peak_of([&] { bake_table(request, progress, options); }) <= memory_bound(request));
}

TEST_CASE("counting lobes needs no more memory than its bound, however large a panorama is") {
  const TemporaryFile file(".exr");
  const int width = 3000;
  const int height = 1500;
  write_exr(file.path(), width, height, {"R", "G", "B"},
            std::vector<float>(3u * width * height, 0.5f));
  TableRequest request;
  request.recipe.views = {2, 1};
  request.recipe.threads = 2;
  request.target.emplace();
  request.target->psnr = 1.0;
  request.target->max_lobes = 1;
  request.target->environments = {file.path(), file.path()};
  LobeCountOptions options;
  options.size = 4;
  options.samples = 16;
  Progress progress;
  const std::size_t peak = peak_of([&] { bake_table(request, progress, options); });
  CHECK(peak <= memory_bound(request));
  // And the bound is no fancy.
  CHECK(2 * peak > memory_bound(request));
}

TEST_CASE("a set's bake needs no more memory than its bound") {
  for (const int threads : {1, 3}) {
    SetRecipe recipe = large_set(3, 4, {16, 4});
    recipe.threads = threads;
    Progress progress;
    CHECK(peak_of([&] { bake_set(recipe, progress); }) <= memory_bound(recipe));
  }
}

TEST_CASE("a picture needs no more memory than its bound") {
  const TemporaryFile file(".exr");
  write_exr(file.path(), 600, 300, {"R", "G", "B"}, std::vector<float>(3u * 600 * 300, 0.5f));
  SphereRequest request;
  request.environment = file.path();
  request.options.size = 200;
  request.options.samples = 16;
  request.options.threads = 2;
  Progress progress;
  CHECK(peak_of([&] { render_picture(request, progress); }) <= memory_bound(request, 600, 300));
}

TEST_CASE("what would not fit is refused before memory is taken, by key and value") {
  // Tables of 32 GiB: too many texels for an image of the engine.
  const SetRecipe huge = large_set(64, 32, {256, 256});
  std::string said;
  CHECK(peak_of([&] { said = refusal_of([&] { validate_set(huge); }); }) < 1 << 20);
  CHECK(said ==
        "widths has 64 numbers, lobes is 32 and views is (256, 256), which makes 4362600448 "
        "texels, but an image of the engine holds at most 268435456.");
  Progress progress;
  CHECK(refusal_of([&] { bake_set(huge, progress); }) == said);
  CHECK(progress.fraction() == 0.0);

  // Every set that is taken becomes an image: on both sides of the limit.
  int taken = 0;
  int refused = 0;
  for (const int widths : {2, 8, 20, 33, 64}) {
    for (const int lobes : {1, 8, 32}) {
      for (const glm::ivec2& views :
           {glm::ivec2(16, 8), glm::ivec2(64, 64), glm::ivec2(256, 256)}) {
        const SetRecipe recipe = large_set(widths, lobes, views);
        const bool fits = refusal_of([&] { validate_set(recipe); }).empty();
        const std::size_t texels = SetLayout(recipe).total() / 4;
        if (fits) CHECK(texels <= kMaxImageTexels);
        CHECK(fits == (texels <= kMaxImageTexels && memory_bound(recipe) <= kMemoryLimit));
        ++(fits ? taken : refused);
      }
    }
  }
  CHECK(taken > 10);
  CHECK(refused > 3);

  // Many large tables at a time.
  SetRecipe parallel = large_set(12, 32, {256, 256});
  parallel.threads = 256;
  said = refusal_of([&] { validate_set(parallel); });
  CHECK(said.find("widths has 12 numbers, lobes is 32 and views is (256, 256), which takes ") == 0);
  CHECK(said.find(" GiB of memory, but may take at most 8 GiB.") != std::string::npos);

  TableRequest many;
  many.target.emplace();
  many.target->environments.assign(100, "hall.exr");
  said = refusal_of([&] { validate(many); });
  CHECK(said.find("environments has 100 paths, which takes ") == 0);
  many.target->environments.resize(10);
  CHECK(refusal_of([&] { validate(many); }).empty());

  SphereRequest sphere;
  CHECK(refusal_of([&] { check_memory(sphere, 8192, 4096); }).empty());
  CHECK(refusal_of([&] {
          check_memory(sphere, 16384, 16384);
        }).find("env is a panorama of 16384 x 16384 texels, which takes ") == 0);
}

TEST_CASE("a file too large to be fitted is refused unread") {
  const TemporaryFile file(".bsdf");
  file.write({'x'});
  // Sparse: nothing of it is on the disk.
  std::filesystem::resize_file(file.path(), std::uintmax_t{2000} << 20);
  TableRequest request;
  request.recipe.brdf = file.path();
  request.recipe.alpha = {0.0, 0.0};
  const std::string said = refusal_of([&] { validate(request); });
  CHECK(said.find("brdf is \"" + file.path() + "\", a file of 1.95 GiB, which takes ") == 0);
}

}  // namespace lobelight
