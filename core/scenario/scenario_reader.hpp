// Scenario and vehicle files: YAML to the structs of core/scenario.hpp, strictly, and back to YAML.
// Angles in files are in degrees, everything else in SI; the name of each key says so.
// Reads files only; safe from any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/config/config_files.hpp"
#include "core/scenario.hpp"

namespace skein {

struct LoadOptions {
  std::filesystem::path assets_dir = {};         ///< folder that holds models/; empty: SKEIN_ASSETS, else none
  std::filesystem::path config_dir = {};         ///< empty: default_config_dir()
  std::optional<double> duration_s = {};         ///< instead of the file's, (0, 36000]
  std::optional<std::uint64_t> scene_seed = {};  ///< instead of the file's; only for a procedural scene
  /// Fleet size: the first of the file's fleet, or beyond it the same UAVs again ("jurong2") in places of the scene.
  std::optional<std::size_t> uavs = {};
  std::optional<std::string> rules = {};       ///< a preset, instead of all that the file says of rules
  std::optional<std::string> conditions = {};  ///< as chosen_conditions() reads it, on top of the file's
  bool needs_scene_files = true;  ///< false for programs that do not look at the scene: they need no assets
};

/// @param name_or_path a name under config/scenarios/, or a path (it holds a '/' or ends in .yaml).
/// @throws InputError when the file or a vehicle file is wrong, when a rule across keys is broken (names, starts,
///   radio nodes), or when the scene's files are not there; the message says file, line, key and what would be right.
Scenario load_scenario(const std::string& name_or_path, const LoadOptions& options = {});

/// @param name_or_path as above, under config_dir/vehicles/.  @throws InputError.
VehicleConfig load_vehicle(const std::string& name_or_path, const std::filesystem::path& config_dir);

/// All presets of rules: "contest", which is the default, "paper" and "reference".
std::span<const RulesConfig> rules_presets();
/// A preset's switches by its name.  @throws InputError for a name that there is not.
RulesConfig rules_preset(const std::string& preset);

/// A switch of rules and what it is set to.
using RuleSwitch = std::pair<std::string, std::variant<bool, double>>;
/// Those that differ from their preset's, by their keys in a scenario file, in its order.  @throws as rules_preset().
std::vector<RuleSwitch> own_switches(const RulesConfig& rules);

/// The scenario with every key that it resolved to, vehicles in place; load_scenario() reads it back to the same.
std::string to_yaml(const Scenario& scenario);
/// The same for a vehicle file.
std::string to_yaml(const VehicleConfig& vehicle);

}  // namespace skein
