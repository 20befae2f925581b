// An engine of a few lines, as far as the binding's tests call it: it answers look-ups, keeps what
// is registered and reported, and has Variants that hold nothing or an int.
#pragma once

#include <gdextension_interface.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace fake_engine {

// What is registered of a method; `bound` and `call` serve to call it.
struct Method {
  std::uint32_t flags = 0;
  std::uint32_t argument_count = 0;
  std::uint32_t default_count = 0;
  void* bound = nullptr;
  GDExtensionClassMethodCall call = nullptr;
};

// What the engine does not have, in the words in which the binding says so:
// "array_operator_index_const" for a function of the interface, "Array.size() with the signature
// hash 3173160232" for a method, "constructors of Array" and "conversions of Array" for a builtin
// type.
inline std::set<std::string> missing;
// Every look-up that was answered, in the same words.
inline std::set<std::string> found;
inline std::vector<std::string> errors;
inline std::map<std::string, Method> methods;  // by "Class.method"

void reset();
GDExtensionInterfaceFunctionPtr get_proc_address(const char* name);

}  // namespace fake_engine
