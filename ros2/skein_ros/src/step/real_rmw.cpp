#include "real_rmw.hpp"

#include <dlfcn.h>

#include "say.hpp"

namespace skein_ros {

void* real_symbol(const char* name) {
  if (void* const next = dlsym(RTLD_NEXT, name)) return next;
  // In Python, none of these libraries is in the global scope: the extension module has loaded them locally.
  for (const char* library : {"librmw_implementation.so", "librmw_cyclonedds_cpp.so", "librmw_fastrtps_cpp.so",
                              "librcl.so", "librclcpp.so"}) {
    void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
    if (handle == nullptr) continue;
    if (void* const symbol = dlsym(handle, name)) return symbol;
  }
  fail(std::string("this node's middleware has no ") + name);
}

}  // namespace skein_ros
