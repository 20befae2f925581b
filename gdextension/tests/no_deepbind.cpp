// Loaded into the engine before the address sanitizer's library, which refuses RTLD_DEEPBIND: the
// engine asks for it when it loads extensions.

#include <dlfcn.h>

extern "C" __attribute__((visibility("default"))) void* dlopen(const char* file,
                                                               int mode) noexcept {
  using Function = void* (*)(const char*, int);
  static const auto next = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "dlopen"));
  return next(file, mode & ~RTLD_DEEPBIND);
}
