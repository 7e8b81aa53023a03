// Finds the functions of libskein_step.so (skein_ros/step.h) at run time, if that library is loaded.
#pragma once

#include <dlfcn.h>

#include <string>

namespace skein_ros {

/// The function `name` of the library; nullptr if the library is not loaded.
template <class Function>
Function step_function(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_DEFAULT, name));
}

/// True if this process is a member of the lock-step.
bool is_member();

/// Writes `why` to stderr, and ends the process with exit code 3.
[[noreturn]] void fail(const std::string& why);

}  // namespace skein_ros
