// For tests: the docker-compose programs on this machine: version 1, a program of its own, and version 2, a plug-in of
// Docker's client.
#pragma once

#include <string>
#include <vector>

#include "host/preflight.hpp"
#include "process/host/environment.hpp"

namespace skein::cli {

/// For each docker-compose that works on this machine: the first words of its command line.
inline std::vector<std::vector<std::string>> compose_programs() {
  std::vector<std::vector<std::string>> programs;
  for (const std::string program : {"docker-compose", "docker compose"}) {
    const std::string asked = program + " version >/dev/null 2>&1";
    if (run_to_end({"docker", {"/bin/sh", "-c", asked}, environment_with({}), {}}).code != 0) continue;
    programs.push_back({"/bin/sh", "-c", "exec " + program + " \"$@\"", "sh"});
  }
  return programs;
}

}  // namespace skein::cli
