// That the binding refuses an engine that lacks anything it calls, and binds methods as godot-cpp
// does.
#include <doctest/doctest.h>

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/godot.hpp>

#include "example.h"
#include "fake_engine.h"

namespace {

using binding_test::Example;

// What the engine is asked by the library's entry point: whether it takes the library.
bool loads() {
  GDExtensionInitialization initialization{};
  const godot::GDExtensionBinding::InitObject binding(fake_engine::get_proc_address, nullptr,
                                                      &initialization);
  return binding.init() != 0;
}

// `method`, called with `arguments` through Variants; gives what it returns in `result`.
GDExtensionCallError call(const fake_engine::Method& method, const std::vector<int>& arguments,
                          std::int64_t& result) {
  const std::vector<godot::Variant> values(arguments.begin(), arguments.end());
  std::vector<GDExtensionConstVariantPtr> pointers;
  for (const godot::Variant& value : values) pointers.push_back(value._native_ptr());
  GDExtensionCallError error{};
  godot::Variant returned;
  Example instance;
  method.call(method.bound, &instance, pointers.data(), static_cast<GDExtensionInt>(values.size()),
              returned._native_ptr(), &error);
  result = returned;
  return error;
}

}  // namespace

TEST_CASE("an engine that has everything is taken, without a word") {
  fake_engine::reset();
  CHECK(loads());
  CHECK(fake_engine::errors.empty());
}

TEST_CASE("an engine that lacks one thing is refused, and the thing is named") {
  fake_engine::reset();
  REQUIRE(loads());
  const std::set<std::string> wanted = fake_engine::found;
  for (const char* one : {"array_operator_index_const", "constructors of Callable",
                          "conversions of PackedFloat32Array", "Callable(object, method)",
                          "Array.size() with the signature hash 3173160232",
                          "push_error() with the signature hash 2648703342",
                          "Object.notification() with the signature hash 4023243586"}) {
    CAPTURE(one);
    CHECK(wanted.count(one) == 1);
  }
  for (const std::string& one : wanted) {
    CAPTURE(one);
    fake_engine::reset();
    fake_engine::missing = {one};
    CHECK_FALSE(loads());
    // The one thing that cannot be reported to the engine, but on stderr.
    if (one == "print_error_with_message") continue;
    REQUIRE(fake_engine::errors.size() == 1);
    const std::string& error = fake_engine::errors[0];
    CAPTURE(error);
    CHECK(error.find(one) != std::string::npos);
  }
}

TEST_CASE("methods are registered with godot-cpp's flags") {
  fake_engine::reset();
  REQUIRE(loads());
  GDREGISTER_CLASS(Example);
  const auto& methods = fake_engine::methods;
  REQUIRE(methods.size() == 3);
  CHECK(methods.at("Example.add").flags == GDEXTENSION_METHOD_FLAGS_DEFAULT);
  CHECK(methods.at("Example.twice").flags ==
        (GDEXTENSION_METHOD_FLAGS_DEFAULT | GDEXTENSION_METHOD_FLAG_CONST));
  CHECK(methods.at("Example.sum").flags == GDEXTENSION_METHOD_FLAG_STATIC);
  CHECK(methods.at("Example.sum").argument_count == 3);
  CHECK(methods.at("Example.sum").default_count == 2);
  godot::ClassDB::_unregister_classes();
}

TEST_CASE("a call fills in defaults, and a wrong number of arguments is told the right one") {
  fake_engine::reset();
  REQUIRE(loads());
  GDREGISTER_CLASS(Example);
  const fake_engine::Method sum = fake_engine::methods.at("Example.sum");
  const fake_engine::Method add = fake_engine::methods.at("Example.add");
  std::int64_t result = 0;
  CHECK(call(sum, {1}, result).error == GDEXTENSION_CALL_OK);
  CHECK(result == 321);
  CHECK(call(sum, {1, 2}, result).error == GDEXTENSION_CALL_OK);
  CHECK(result == 303);
  CHECK(call(sum, {1, 2, 3}, result).error == GDEXTENSION_CALL_OK);
  CHECK(result == 6);
  CHECK(call(add, {41}, result).error == GDEXTENSION_CALL_OK);
  CHECK(result == 42);

  const GDExtensionCallError many = call(sum, {1, 2, 3, 4}, result);
  CHECK(many.error == GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS);
  CHECK(many.expected == 3);
  const GDExtensionCallError few = call(sum, {}, result);
  CHECK(few.error == GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS);
  CHECK(few.expected == 3);
  godot::ClassDB::_unregister_classes();
}
