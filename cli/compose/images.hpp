// From which image a program's container is made.   Pure; any thread.
#pragma once

#include <string>

#include "run/fleet_plan.hpp"

namespace skein::cli {

/// An image of docker/Dockerfile, and the variable with which a user names another one instead.
struct ProgramImage {
  const char *usual, *variable;
};
/// Does not consider users' images (`--image`).
ProgramImage image_of(const FleetPlan& plan, const std::string& program);

}  // namespace skein::cli
