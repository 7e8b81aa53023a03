// What a file for `docker stack` has in other words than one for docker-compose: where a service runs and what it may
// take, and files that go with it to its node.   Pure; an object belongs to one thread.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cli/compose/compose_yaml.hpp"

namespace skein::cli {

inline constexpr int kMostProcesses = 256;  ///< in a container, threads included

/// As whom all programs run: two variables, because files are given to a user and a group each.
std::string stack_user();

struct Deployment {
  std::string node;      ///< its host name; empty: where there is room
  bool manager = false;  ///< on a manager of the swarm, where no node is named
  std::string memory;
  std::string cpus;  ///< at most; empty: all
  int restarts = 0;
};

/// The key `deploy` of a service.
void add_deployment(ComposeYaml& yaml, const Deployment& deployment);

/// Files of the manager that services get: open ones (configs) and keys (secrets).
class SentFiles {
 public:
  using Files = std::map<std::filesystem::path, std::filesystem::path>;  ///< on the manager, by path in the container

  void add_configs(ComposeYaml& yaml, const Files& files) { add(yaml, "configs", configs_, files, 0444); }
  /// Only the containers' user can read them.
  void add_secrets(ComposeYaml& yaml, const Files& files) { add(yaml, "secrets", secrets_, files, 0400); }
  /// Where all of them come from: keys of the whole file.
  void add_sources(ComposeYaml& yaml) const;

 private:
  using Names = std::map<std::filesystem::path, std::string>;

  static void add(ComposeYaml& yaml, const std::string& kind, Names& names, const Files& files, int mode);

  Names configs_, secrets_;
};

}  // namespace skein::cli
