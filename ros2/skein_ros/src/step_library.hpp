// libskein_step.so, if it is loaded: its functions (skein_ros/step.h), found while the program runs.
#pragma once

#include <dlfcn.h>

#include <string>

namespace skein_ros {

/// nullptr: the library is not loaded.
template <class Function>
Function step_function(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_DEFAULT, name));
}

/// True if this process steps with a fleet.
bool is_member();

/// Says why, and ends the process with exit code 3.
[[noreturn]] void fail(const std::string& why);

}  // namespace skein_ros
