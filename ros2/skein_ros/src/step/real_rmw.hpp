// The middleware below: the rmw functions that this library stands in front of, as the node's own rmw has them.
#pragma once

#include <rmw/error_handling.h>
#include <rmw/rmw.h>

namespace skein_ros {

/// The next definition of an rmw function after ours. Ends the process if there is none.
void* real_symbol(const char* name);

}  // namespace skein_ros

/// real(rmw_wait)(...): the function of that name of the node's rmw.
#define SKEIN_REAL(function)                                                                             \
  ([]() -> decltype(&(function)) {                                                                       \
    static const auto real = reinterpret_cast<decltype(&(function))>(skein_ros::real_symbol(#function)); \
    return real;                                                                                         \
  }())
