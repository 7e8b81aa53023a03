#include "doctor/software_judges.hpp"

#include <spdlog/fmt/fmt.h>

#include "core/text/suggestion.hpp"

namespace skein::doctor {

Finding judge_shared_memory(const SharedMemoryFacts& memory) {
  const std::string what = "shared memory";
  const std::string use = "the fleet's DDS uses UDP instead; ROS 2 nodes on Fast DDS use it among themselves";
  if (!memory.there) return fine(what, "there is no /dev/shm; " + use);
  const std::string state =
      fmt::format("/dev/shm has {:.0f} MB free{}, {} files of Fast DDS in it", 1e-6 * static_cast<double>(memory.free),
                  memory.writable ? "" : ", but is not writable", memory.segments);
  if (memory.unused == 0) return fine(what, state + "; " + use);
  return warning(what,
                 fmt::format("{}, of which no process visible from here has {} ({:.1f} MB) open", state, memory.unused,
                             1e-6 * static_cast<double>(memory.unused_bytes)),
                 "when no ROS 2 node runs, in no container that shares it: rm /dev/shm/*fastrtps_* "
                 "/dev/shm/fast_datasharing_*");
}

Findings judge_variables(const VariableFacts& variables) {
  Findings findings;
  if (variables.ignored.empty()) {
    findings.push_back(fine("variables", "none is set that DDS vendors or ROS 2 read for their settings"));
  } else {
    const std::string names = joined(variables.ignored);
    findings.push_back(warning(
        "variables", names + " are set; the fleet's programs do not get them, ROS 2 nodes beside them do",
        "unset " + joined(variables.ignored, " ") + "; set domain and network of the fleet by --domain and --network"));
  }
  if (variables.vendor.empty()) {
    findings.push_back(fine("DDS libraries", "the system's"));
  } else {
    std::vector<std::string> files;
    for (const auto& file : variables.vendor) files.push_back(file.string());
    findings.push_back(warning("DDS libraries", "LD_LIBRARY_PATH puts others in their place: " + joined(files),
                               "unset LD_LIBRARY_PATH, or start Skein in a shell that has not sourced ROS 2"));
  }
  return findings;
}

Finding judge_docker(const DockerFacts& docker) {
  const std::string what = "Docker";
  if (!docker.client) return fine(what, "not installed; only containers need it");
  const std::string host = docker.host.empty() ? "" : " at DOCKER_HOST=" + docker.host;
  if (!docker.engine) {
    return warning(what, "the client gets no answer from an engine" + host + ": " + docker.trouble,
                   docker.host.empty() ? "only containers need it: start the engine (dockerd), or join the group docker"
                                       : "only containers need it: start that engine, or unset DOCKER_HOST");
  }
  const std::string engine = "engine " + *docker.engine + host;
  if (!docker.compose) {
    return warning(what, engine + ", but no compose",
                   "only containers need it: install docker-compose-plugin, or docker-compose");
  }
  return fine(what, engine + ", " + *docker.compose);
}

}  // namespace skein::doctor
