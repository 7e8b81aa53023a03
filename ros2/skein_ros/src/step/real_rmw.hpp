// The original functions that this library replaces: those of the node's own rmw, rcl and rclcpp.
#pragma once

#include <rmw/error_handling.h>
#include <rmw/rmw.h>

namespace skein_ros {

/// The next definition of a function after ours. Ends the process if there is none.
void* real_symbol(const char* name);

}  // namespace skein_ros

/// SKEIN_REAL(rmw_wait)(...) calls the original function.
#define SKEIN_REAL(function)                                                                             \
  ([]() -> decltype(&(function)) {                                                                       \
    static const auto real = reinterpret_cast<decltype(&(function))>(skein_ros::real_symbol(#function)); \
    return real;                                                                                         \
  }())
