// Scenario and vehicle files: YAML to the structs of core/scenario/scenario.hpp, strictly, and back to YAML.
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
#include "core/scenario/scenario.hpp"

namespace skein {

inline constexpr std::size_t kMostUavs = 1024;        ///< of a fleet, in one process
inline constexpr std::size_t kMostUavsOverDds = 128;  ///< chosen: below what domains and open files allow

struct LoadOptions {
  std::filesystem::path assets_dir = {};         ///< folder that contains models/; empty: SKEIN_ASSETS, else none
  std::filesystem::path config_dir = {};         ///< empty: default_config_dir()
  std::optional<double> duration_s = {};         ///< instead of the file's, (0, 36000]
  std::optional<std::uint64_t> scene_seed = {};  ///< instead of the file's; only for a procedural scene
  /// Fleet size. A smaller fleet has the file's first UAVs. In a larger one, copies of them ("jurong2") follow, which
  /// start at further places of the scene.
  std::optional<std::size_t> uavs = {};
  std::optional<std::string> rules = {};       ///< a preset, instead of the file's section `rules`
  std::optional<std::string> conditions = {};  ///< text for chosen_conditions(), applied to the file's conditions
  bool needs_scene_files = true;               ///< false for programs that do not use the scene: they need no assets
  bool operator==(const LoadOptions&) const = default;
};

/// @param name_or_path  a name under config/scenarios/, or a path (it contains a '/' or ends in .yaml).
/// @throws InputError if the file or a vehicle file is wrong, if a rule across keys is broken (names, starts, radio
///   nodes), or if the scene's files do not exist; the message says file, line, key and what would be right.
Scenario load_scenario(const std::string& name_or_path, const LoadOptions& options = {});

/// @param name_or_path as above, under config_dir/vehicles/.  @throws InputError.
VehicleConfig load_vehicle(const std::string& name_or_path, const std::filesystem::path& config_dir);

/// All presets of rules: "contest", which is the default, "paper" and "reference".
std::span<const RulesConfig> rules_presets();
/// The switches of a preset.  @throws InputError if there is no preset of this name.
RulesConfig rules_preset(const std::string& preset);

/// Key and value of a rule switch.
using RuleSwitch = std::pair<std::string, std::variant<bool, double>>;
/// The switches that differ from the preset, in the order of the keys in a scenario file.  @throws as rules_preset().
std::vector<RuleSwitch> own_switches(const RulesConfig& rules);

/// The scenario as YAML, with all keys and with the vehicles inline; load_scenario() reads back the same scenario.
std::string to_yaml(const Scenario& scenario);
/// The same for a vehicle file.
std::string to_yaml(const VehicleConfig& vehicle);

}  // namespace skein
