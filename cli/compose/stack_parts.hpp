// The parts in which a file for `docker stack` differs from one for docker-compose: node and resource limits of a
// service, and the files that are sent to its node.   Pure; an object belongs to one thread.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cli/compose/compose_yaml.hpp"

namespace skein::cli {

inline constexpr int kMostProcesses = 256;  ///< limit in a container, threads included

/// The user and group of all programs, as two variables: files that are sent name the two separately.
std::string stack_user();

struct Deployment {
  std::string node;      ///< host name of the node; empty: any with room
  bool manager = false;  ///< if no node is named: on a manager of the swarm
  std::string memory;
  std::string cpus;  ///< limit; empty: none
  int restarts = 0;
};

/// The key `deploy` of a service.
void add_deployment(ComposeYaml& yaml, const Deployment& deployment);

/// Files on the manager that are sent to services: readable for all (configs), or keys (secrets).
class SentFiles {
 public:
  using Files = std::map<std::filesystem::path, std::filesystem::path>;  ///< on the manager, by path in the container

  void add_configs(ComposeYaml& yaml, const Files& files) { add(yaml, "configs", configs_, files, 0444); }
  /// Only the containers' user can read them.
  void add_secrets(ComposeYaml& yaml, const Files& files) { add(yaml, "secrets", secrets_, files, 0400); }
  /// The top-level keys `configs` and `secrets`, with the paths of all added files on the manager.
  void add_sources(ComposeYaml& yaml) const;

 private:
  using Names = std::map<std::filesystem::path, std::string>;

  static void add(ComposeYaml& yaml, const std::string& kind, Names& names, const Files& files, int mode);

  Names configs_, secrets_;
};

}  // namespace skein::cli
