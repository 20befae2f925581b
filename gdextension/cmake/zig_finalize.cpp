// What GCC links into every shared library for Linux (crtbeginS.o) and Zig does not: when the
// library is unloaded, the destructors of its static objects run. Without it they would run at the
// process' end, when their code is gone. Itanium C++ ABI, 3.3.6.3, "Runtime API".

extern "C" {
extern void* __dso_handle;
void __cxa_finalize(void* library);
}

__attribute__((destructor)) static void finalize() { __cxa_finalize(&__dso_handle); }
