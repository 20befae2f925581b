#include <doctest/doctest.h>

#include <glm/glm.hpp>
#include <stdexcept>
#include <string>

#include "base/one_line.h"
#include "brdf/brdf.h"
#include "fit/roughness_fitter.h"
#include "fit/table_fitter.h"
#include "refusal.h"
#include "statistics.h"

namespace lobelight {
namespace {

TEST_CASE("Text of any bytes becomes one line of UTF-8") {
  CHECK(one_line("Grüße, 日本 😀") == "Grüße, 日本 😀");
  CHECK(one_line("two\nlines\tand\x7f") == "two lines and");
  CHECK(one_line("a sentence.") == "a sentence");
  // Overlong, a surrogate, beyond U+10FFFF, cut off: a question mark for each byte.
  CHECK(one_line("\xc0\xaf") == "??");
  CHECK(one_line("\xed\xa0\x80") == "???");
  CHECK(one_line("\xf4\x90\x80\x80") == "????");
  CHECK(one_line("x\xe6\x97") == "x??");
  testing::Uniform uniform(1);
  for (int n = 0; n < 2000; ++n) {
    std::string bytes;
    for (double length = 40.0 * uniform.next(); length > 0.0; --length) {
      bytes += static_cast<char>(static_cast<unsigned char>(256.0 * uniform.next()));
    }
    CHECK(testing::wrong_in_refusal("x" + one_line(bytes), "") == "");
  }
}

TEST_CASE("What a recipe calls its material or method is named in one line, whatever it is") {
  const std::string name = "phong\n\x1b[31m\xff" + std::string(5000, 'x');
  const auto wrong = [](auto refused) -> std::string {
    try {
      refused();
    } catch (const std::invalid_argument& error) {
      return testing::wrong_in_refusal(error.what(), "");
    }
    return "was not refused";
  };
  CHECK(wrong([&] { make_brdf(name, {0.1, 0.1}); }) == "");
  CHECK(wrong([&] { fit_method_from_string(name); }) == "");
  SetRecipe set;
  set.widths = {0.1, 0.2};
  set.brdf = name;
  CHECK(wrong([&] { validate(set); }) == "");
  set.brdf = name + ".bsdf";
  CHECK(wrong([&] { validate(set); }) == "");
}

}  // namespace
}  // namespace lobelight
