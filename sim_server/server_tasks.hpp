// What sim_server does without a fleet: reference vectors, scenes as files, what is attainable.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario.hpp"
#include "process/program.hpp"

namespace CLI {
class App;
}

namespace skein::sim {

/// As its options say.
struct ServerTasks {
  std::vector<std::filesystem::path> golden;
  std::filesystem::path export_scene;   ///< folder; empty: none
  std::filesystem::path scene_picture;  ///< folder for a drawing of it; empty: none
  std::string draw_world;               ///< the world that is written; empty: the scenario's scene
  bool overwrite_export = false;
  std::filesystem::path oracle;      ///< file for its answer; empty: it is not asked
  std::vector<double> clearances_m;  ///< empty: the usual one
  bool vehicle = false;              ///< it is the UAVs' bodies that keep them
  std::optional<double> oracle_patience_s;
  bool plan = false;  ///< search for what is scored in the mission's time, too; else only what is in the cache is told

  void add_options(CLI::App& app);
  /// Each @returns an exit code.
  int check_golden() const;
  int write_scene(const ProgramOptions& options) const;
  int ask_oracle(const Scenario& scenario) const;
};

}  // namespace skein::sim
