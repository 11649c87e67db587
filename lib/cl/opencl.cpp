#include "lib/cl/opencl.hpp"

#include <powercell/opencl.hpp>

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#include <pthread.h>
#endif

namespace powercell::cl {
namespace {

std::atomic<bool> forked = false;

#if defined(_WIN32)

struct Loader {
  HMODULE library = LoadLibraryExA("OpenCL.dll", nullptr, LOAD_LIBRARY_SEARCH_DEFAULT_DIRS);
  std::string fault = library ? "" : "OpenCL.dll was not found";

  void* find(const char* name) const {
    return library ? reinterpret_cast<void*>(GetProcAddress(library, name)) : nullptr;
  }
};

#else

/// Names for the dynamic linker, and places that it does not look into.
constexpr const char* loader_names[] = {
#if defined(__APPLE__)
    "/System/Library/Frameworks/OpenCL.framework/OpenCL",
#elif defined(__ANDROID__)
    "libOpenCL.so",
    "/system/vendor/lib64/libOpenCL.so",
    "/system/lib64/libOpenCL.so",
#else
    "libOpenCL.so.1",
    "libOpenCL.so",
    "/usr/lib/x86_64-linux-gnu/libOpenCL.so.1",
    "/usr/lib/aarch64-linux-gnu/libOpenCL.so.1",
    "/usr/lib64/libOpenCL.so.1",
    "/usr/lib/libOpenCL.so.1",
    "/usr/local/lib/libOpenCL.so.1",
    "/usr/local/cuda/lib64/libOpenCL.so.1",
    "/opt/rocm/lib/libOpenCL.so.1",
#endif
};

struct Loader {
  // Never closed, since drivers have threads that go on; and open to all, as it is where programs link it:
  // layers that are preloaded look for its functions there.
  void* library = nullptr;
  std::string fault;

  Loader() {
    pthread_atfork(nullptr, nullptr, [] { forked = true; });
    for (const char* name : loader_names) {
      library = dlopen(name, RTLD_NOW | RTLD_GLOBAL);
      if (library) break;
      const char* const said = dlerror();
      if (fault.empty() && said) fault = said;
    }
    if (find("clGetPlatformIDs")) fault.clear();
  }

  /// What the process has linked or preloaded comes first, as if the library were linked to it.
  void* find(const char* name) const {
    if (void* in_process = dlsym(RTLD_DEFAULT, name)) return in_process;
    return library ? dlsym(library, name) : nullptr;
  }
};

#endif

const Loader& loader() {
  static const Loader& opened = *new Loader;  // used by destructors of other static objects
  return opened;
}

}  // namespace

void* find_function(const char* name) {
  return loader().find(name);
}

std::string loader_fault() {
  return loader().fault;
}

bool is_forked() {
  return forked.load(std::memory_order_relaxed);
}

}  // namespace powercell::cl

namespace powercell {

void* opencl_function(const char* name) {
  return cl::find_function(name);
}

}  // namespace powercell
