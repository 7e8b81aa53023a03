// Of what image a program's container is made.   Pure; any thread.
#pragma once

#include <string>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// An image of docker/Dockerfile, and the variable by which a user names another one in its place.
struct ProgramImage {
  const char *usual, *variable;
};
/// Images of users (`--image`) apart.
ProgramImage image_of(const FleetPlan& plan, const std::string& program);

}  // namespace skein::cli
