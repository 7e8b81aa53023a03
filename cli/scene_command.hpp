// `skein scene`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace skein::cli {

struct SceneOptions {
  std::string scenario;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::size_t> uavs;           ///< fleet size, as for `skein run`
  std::optional<std::filesystem::path> out;  ///< folder for the scene's files
  bool picture = false;                      ///< write a drawing to `out`, or to the current folder
  std::optional<std::filesystem::path> assets;
  bool force = false;
};

/// Adds the command `scene`, whose options CLI11 parses into the second argument.
void add_scene(CLI::App& app, SceneOptions& scene);

/// `skein scene`: runs sim_server, which builds the scene, writes it as files in CARIC's layout and prints their names.
/// @returns its exit code: kExitDone, or kExitBadInput after it has printed what is wrong.
int export_scene(const SceneOptions& options);

}  // namespace skein::cli
