// The tasks of sim_server that need no fleet: it checks reference vectors, writes scenes to files, and asks the oracle
// for the attainable score.   Units: m, s.   Threads: one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "process/program.hpp"

namespace CLI {
class App;
}

namespace skein::sim {

/// The tasks that the command line asks for.
struct ServerTasks {
  std::vector<std::filesystem::path> golden;  ///< files with reference vectors to check
  std::filesystem::path export_scene;         ///< folder; empty: none
  std::filesystem::path scene_picture;        ///< folder for a drawing of the scene; empty: none
  std::string draw_world;                     ///< the generated world to export or draw; empty: the scenario's scene
  bool overwrite_export = false;
  std::filesystem::path oracle;             ///< file for the oracle's answer; empty: the oracle is not asked
  std::vector<double> clearances_m;         ///< from the structure; empty: the default one
  bool vehicle = false;                     ///< the UAVs' bodies keep the clearances, not their cameras
  std::optional<double> oracle_patience_s;  ///< no answer that takes longer to compute; nullopt: any
  bool plan = false;  ///< search, too, for the score within the mission's time; else report it only from the cache

  void add_options(CLI::App& app);
  /// Each runs one task. @returns an exit code.
  int check_golden() const;
  int write_scene(const ProgramOptions& options) const;
  int ask_oracle(const Scenario& scenario) const;
};

}  // namespace skein::sim
