#include "core/scenario/scenario_reader.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "core/config/config_writer.hpp"
#include "core/radio/link_check.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/scenario/conditions_check.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_keys.hpp"
#include "core/scenario/scene_families.hpp"
#include "core/text/suggestion.hpp"
#include "core/topics.hpp"
#include "core/vehicle/airframe.hpp"

namespace skein {

namespace fs = std::filesystem;

namespace {

constexpr double kLeastStationDistanceM = 0.5;
constexpr std::size_t kLongestName = 64;  ///< of a UAV or a scenario: they become names of files and topics

/// A word that may be part of a ROS name.
bool is_ros_word(const std::string& text) {
  const auto allowed = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), allowed);
}

/// The message of the InputError that `reject` throws; empty if it throws none.
std::string complaint(const auto& reject) {
  try {
    reject();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::string index_path(const std::string& list, std::size_t i, const std::string& key = {}) {
  return list + "[" + std::to_string(i) + "]" + (key.empty() ? "" : "." + key);
}

void check_times(const Scenario& scenario, ConfigErrors& errors) {
  const double rest = scenario.exchange_period_s - seconds(scenario.exchange_ticks());
  errors.check(std::abs(rest) < 1e-9, "exchange_period_s", "must be a multiple of the physics tick, 0.0025");
  errors.check(scenario.duration_s >= scenario.exchange_period_s, "duration_s",
               "must be at least one exchange_period_s");
  errors.check(scenario.station_position.z() >= 0.0, "station.position", "z must be 0 or more: the ground is at 0");
}

void check_names(const ScenarioFile& file, ConfigErrors& errors) {
  // Names of nodes, topics and programs. The lock-step knows its members by their names, so these must be unique.
  static const std::set<std::string> reserved = {"all",         "clock",     "comm_router", "gcs",
                                                 "one_process", "sim",       "sim_server",  "skein",
                                                 "station",     "uav_agent", "uavs"};
  const std::string& scenario = file.scenario.name;
  const bool names_a_folder = scenario.size() <= kLongestName && scenario != "." && scenario != ".." &&
                              scenario.find_first_of("/\\") == std::string::npos &&
                              std::ranges::none_of(scenario, [](unsigned char c) { return std::iscntrl(c) != 0; });
  errors.check(
      names_a_folder, "name",
      "must be at most " + std::to_string(kLongestName) +
          " letters, without '/', '\\' and control characters, and not '.' or '..': the results of a run lie in "
          "a folder of this name");
  errors.check(!file.fleet.empty() && file.fleet.size() <= kMostUavs, "fleet",
               "must have 1 to " + std::to_string(kMostUavs) + " UAVs");
  std::map<std::string, std::size_t> seen;
  for (std::size_t i = 0; i < file.fleet.size(); ++i) {
    const std::string& name = file.fleet[i].name;
    const std::string key = index_path("fleet", i, "name");
    errors.check(is_ros_word(name), key,
                 "'" + name + "' is not a ROS name: a letter, then letters, digits and underscores");
    errors.check(!reserved.contains(name), key, "'" + name + "' is reserved; choose another name");
    errors.check(
        name.size() <= kLongestName, key,
        "must be at most " + std::to_string(kLongestName) + " letters long, not " + std::to_string(name.size()));
    const auto [first, is_new] = seen.emplace(name, i);
    errors.check(is_new, key, "'" + name + "' is the name of fleet[" + std::to_string(first->second) + "] already");
  }
}

/// Degrees that convert back to exactly these radians; with at most nine decimals if these are exact.
double tidy_degrees(double radians) {
  const double degrees = radians / kRadPerDeg;
  const double rounded = std::round(degrees * 1e9) / 1e9;
  return rounded * kRadPerDeg == radians ? rounded : degrees;
}

/// Gives each entry without a start the place that the procedural scene has for it: the place with the entry's index.
/// @returns whether all entries have a start.
bool find_starts(const Scenario& scenario, std::vector<FleetEntry>& fleet, ConfigErrors& errors) {
  const SceneFamily* family = find_scene_family(scenario.scene.family);
  const std::vector<StartPlace> places =
      family ? scene_starts(*family, scenario.scene.scene_seed) : std::vector<StartPlace>{};
  // If the family is unknown, check_scene() reports this, and it is not known whether there are places.
  const bool places_known = family != nullptr || from_files(scenario.scene);
  bool all_placed = true;
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    const bool placed = fleet[i].start || i < places.size();
    all_placed = all_placed && placed;
    const std::string why = family ? "the scene has places for " + std::to_string(places.size()) + " UAVs only"
                                   : "a scene from files has no places of its own";
    errors.check(placed || !places_known, index_path("fleet", i),
                 "'" + fleet[i].name + "' needs a 'start: [x, y]': " + why);
    if (!fleet[i].start_yaw_deg && !fleet[i].start && placed) {
      fleet[i].start_yaw_deg = tidy_degrees(places[i].yaw);
    }
    if (!fleet[i].start) fleet[i].start = placed ? places[i].p_W : Vector2d::Zero();
  }
  return all_placed;
}

void check_starts(const Scenario& scenario, ConfigErrors& errors) {
  const auto& fleet = scenario.fleet;
  const auto check = [&](std::size_t i, const Vector2d& other, const std::string& name, double needed_m) {
    const double distance_m = (fleet[i].start - other).norm();
    errors.check(distance_m >= needed_m, index_path("fleet", i, "start"),
                 fmt::format("'{}' starts {:.3f} m from '{}' and must start {:.3f} m or more from it: move one of them",
                             fleet[i].name, distance_m, name, needed_m));
  };
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    check(i, scenario.station_position.head<2>(), "gcs", kLeastStationDistanceM);
    for (std::size_t j = 0; j < i; ++j) {
      check(i, fleet[j].start, fleet[j].name, least_start_distance(fleet[i].vehicle, fleet[j].vehicle));
    }
  }
}

void check_radio(const ScenarioFile& file, ConfigErrors& errors) {
  std::vector<std::string> nodes = {"gcs"};
  for (const FleetEntry& uav : file.fleet) nodes.push_back(uav.name);
  const std::set<std::string> known(nodes.begin(), nodes.end());
  const auto check_nodes = [&](const std::string& key, const std::vector<std::string>& named) {
    errors.check(!named.empty(), key, "must name at least one node, or be the word all");
    if (std::ranges::find(named, "all") != named.end()) return;  // check_routes() refuses it beside other names
    std::set<std::string> seen;
    for (const std::string& node : named) {
      if (!known.contains(node)) {
        errors.check(false, key, "there is no node '" + node + "'; " + suggestion(node, nodes));
      }
      errors.check(seen.insert(node).second, key, "'" + node + "' is named twice");
    }
  };
  for (std::size_t i = 0; i < file.scenario.radio.size(); ++i) {
    const RadioTopicConfig& topic = file.scenario.radio[i];
    const std::string path = index_path("radio.topics", i);
    const std::string name_complaint = complaint([&] { wire_topic(topic.name); });
    const std::string type_complaint = complaint([&] { wire_type(topic.type); });
    errors.check(name_complaint.empty(), path + ".name", name_complaint);
    errors.check(type_complaint.empty(), path + ".type", type_complaint);
    check_nodes(path + ".sources", topic.sources);
    check_nodes(path + ".targets", topic.targets);
  }
  for (std::size_t i = 0; i < file.scenario.links.size(); ++i) {
    const LinkEffect& link = file.scenario.links[i];
    const std::string path = index_path("radio.links", i);
    check_link_effect(link, nodes, path, errors);
    // Exported scenarios have the default size of the queue in each link.
    errors.check(link.bandwidth_bit_s || link.queue_bytes == LinkEffect{}.queue_bytes, path + ".queue_bytes",
                 kNeedsBandwidth);
  }
}

/// Checks the rules between topics. radio_routes() reports the first broken rule as "FILE: KEY: what is wrong".
void check_routes(const Scenario& scenario, ConfigErrors& errors) {
  const std::string text = complaint([&] { radio_routes(scenario); });
  if (text.empty()) return;
  const std::string file = scenario.file.string() + ": ";
  const std::size_t key = file.size(), end = text.find(": ", key);
  if (!text.starts_with(file) || end == std::string::npos) throw InputError(text);
  errors.check(false, text.substr(key, end - key), text.substr(end + 2));
}

void check_scene(const SceneConfig& scene, ConfigErrors& errors) {
  const bool files = !scene.meshes.empty() || !scene.points.empty() || !scene.boxes.empty();
  const bool drawn = is_drawn_world(scene.family);
  if (scene.family.empty() || drawn) {
    errors.check(
        files || !drawn, "scene.family",
        "'" + scene.family + "' is generated together with its fleet: fly it as `skein run " + scene.family + "`");
    errors.check(files || drawn, "scene",
                 "needs 'family' (a procedural scene), or 'meshes', 'points' and 'boxes' (files)");
    errors.check(!files || !scene.meshes.empty(), "scene", "needs 'meshes': a list of mesh files");
    errors.check(!files || !scene.points.empty(), "scene", "needs 'points': a PCD file of interest points");
    errors.check(!files || !scene.boxes.empty(), "scene", "needs 'boxes': a box_description.yaml");
    errors.check(scene.scene_seed == 0 || drawn, "scene.scene_seed", "a scene from files has no seed");
    return;
  }
  errors.check(!files, "scene", "has either a 'family' or files, not both");
  std::vector<std::string> known;
  for (const SceneFamily& family : scene_families()) known.emplace_back(family.name);
  errors.check(std::find(known.begin(), known.end(), scene.family) != known.end(), "scene.family",
               "there is no family '" + scene.family + "' of scenes; " + suggestion(scene.family, known));
}

/// Where the scene's files are: absolute, beside the scenario ("./x", "../x"), or in the assets folder.
class SceneFileFinder {
 public:
  SceneFileFinder(const Scenario& scenario, const LoadOptions& options, ConfigErrors& errors)
      : scenario_(scenario), must_exist_(options.needs_scene_files), errors_(errors) {
    const char* from_environment = std::getenv("SKEIN_ASSETS");
    assets_ = options.assets_dir;
    if (assets_.empty() && from_environment) assets_ = from_environment;
  }

  void resolve(fs::path& file, const std::string& key) const {
    const std::string text = file.string();
    std::string hint;
    if (text.starts_with("./") || text.starts_with("../")) {
      file = (scenario_.file.parent_path() / file).lexically_normal();
    } else if (file.is_relative()) {
      if (assets_.empty()) {
        if (must_exist_) throw InputError(advice(key, text));
        return;
      }
      hint =
          "; --assets or SKEIN_ASSETS must name the folder that it is in, and what lies beside the scenario is "
          "written ./" +
          text;
      file = assets_ / file;
    }
    std::error_code ignored;
    errors_.check(!must_exist_ || fs::is_regular_file(file, ignored), key, "there is no file " + file.string() + hint);
  }

 private:
  std::string advice(const std::string& key, const std::string& file) const {
    return scenario_.file.string() + ": " + key + ": scenario '" + scenario_.name + "' needs the data file " + file +
           ": name the folder that it is in with --assets DIR or SKEIN_ASSETS=DIR (of CARIC's data, which are not part "
           "of Skein, the one that holds models/), or write ./" +
           file + " for a file beside the scenario. The scenario 'towers' needs no data files.";
  }

  const Scenario& scenario_;
  const bool must_exist_;
  ConfigErrors& errors_;
  fs::path assets_;
};

void find_scene_files(Scenario& scenario, const LoadOptions& options, ConfigErrors& errors) {
  if (!from_files(scenario.scene)) return;
  const SceneFileFinder finder(scenario, options, errors);
  for (std::size_t i = 0; i < scenario.scene.meshes.size(); ++i) {
    finder.resolve(scenario.scene.meshes[i], index_path("scene.meshes", i));
  }
  finder.resolve(scenario.scene.points, "scene.points");
  finder.resolve(scenario.scene.boxes, "scene.boxes");
}

void build_fleet(const ScenarioFile& file, const fs::path& config_dir, Scenario& scenario, ConfigErrors& errors) {
  std::map<std::string, VehicleConfig> loaded;
  for (std::size_t i = 0; i < file.fleet.size(); ++i) {
    const FleetEntry& entry = file.fleet[i];
    UavConfig uav{entry.name, {}, *entry.start, entry.start_yaw_deg.value_or(0.0) * kRadPerDeg};
    if (entry.vehicle.index() == 1) {
      uav.vehicle = std::get<VehicleConfig>(entry.vehicle);
    } else {
      const std::string& name = std::get<std::string>(entry.vehicle);
      fs::path vehicle_file;
      try {
        vehicle_file = find_config_file("vehicle", name, config_dir / "vehicles", scenario.file.parent_path());
      } catch (const InputError& error) {
        errors.check(false, index_path("fleet", i, "vehicle"), error.what());
        continue;
      }
      const auto [it, is_new] = loaded.try_emplace(vehicle_file.string());
      if (is_new) {
        it->second = read_config_file<VehicleConfig>(vehicle_file);
        scenario.vehicle_files.push_back(vehicle_file);
      }
      uav.vehicle = it->second;
    }
    scenario.fleet.push_back(std::move(uav));
  }
}

void resize_fleet(std::size_t uavs, std::vector<FleetEntry>& fleet) {
  if (uavs < 1 || uavs > kMostUavs) throw InputError(fmt::format("--uavs: must be within [1, {}]", kMostUavs));
  const std::size_t given = fleet.size();
  for (std::size_t i = given; given > 0 && i < uavs; ++i) {
    const FleetEntry& model = fleet[i % given];
    fleet.push_back({model.name + std::to_string(1 + i / given), model.vehicle, std::nullopt, std::nullopt});
  }
  fleet.erase(fleet.begin() + static_cast<std::ptrdiff_t>(std::min(uavs, fleet.size())), fleet.end());
}

/// Calls `apply`, and adds the name of the option to the message of an InputError.
template <class Apply>
void of_option(const std::string& option, const Apply& apply) try {
  apply();
} catch (const InputError& error) {
  throw InputError(option + ": " + error.what());
}

void apply_overrides(const LoadOptions& options, Scenario& scenario) {
  if (options.duration_s) {
    const bool fits = *options.duration_s >= scenario.exchange_period_s && *options.duration_s <= 36000.0;
    if (!fits) throw InputError("--duration: must be a time of at least one exchange and at most 36000 s");
    scenario.duration_s = *options.duration_s;
  }
  if (options.scene_seed) {
    const bool as_drawn = from_files(scenario.scene) && !scenario.scene.family.empty() &&
                          scenario.scene.scene_seed == *options.scene_seed;
    if (from_files(scenario.scene) && !as_drawn) {
      throw InputError("--scene-seed: scenario '" + scenario.name +
                       "' takes its scene from files and has no seed; "
                       "leave the option out, or run 'towers'");
    }
    scenario.scene.scene_seed = *options.scene_seed;
  }
  if (options.rules) of_option("--rules", [&] { scenario.rules = rules_preset(*options.rules); });
  if (options.conditions) {
    of_option("--conditions",
              [&] { scenario.conditions = chosen_conditions(*options.conditions, scenario.conditions); });
  }
}

}  // namespace

Scenario load_scenario(const std::string& name_or_path, const LoadOptions& options) {
  const fs::path config_dir = options.config_dir.empty() ? default_config_dir() : options.config_dir;
  if (is_drawn_world(name_or_path)) {
    throw InputError("the worlds of '" + name_or_path + "' have no file here; write one with `skein scene " +
                     name_or_path + " --scene-seed 0 --out DIR`, and name its scenario file");
  }
  const fs::path path = find_config_file("scenario", name_or_path, config_dir / "scenarios", {}, drawn_world_names());
  const ConfigDocument document = read_config_document(path);
  ScenarioFile file = read_config<ScenarioFile>(document);
  Scenario scenario = file.scenario;
  scenario.file = path;
  if (scenario.name.empty()) scenario.name = path.stem().string();

  ConfigErrors errors(document);
  if (options.uavs) resize_fleet(*options.uavs, file.fleet);
  check_times(scenario, errors);
  check_conditions(document, scenario.conditions, scenario.exchange_period_s, errors);
  check_names(file, errors);
  check_scene(scenario.scene, errors);
  apply_overrides(options, scenario);
  const bool all_placed = find_starts(scenario, file.fleet, errors);
  check_radio(file, errors);
  build_fleet(file, config_dir, scenario, errors);
  // The starts can be checked only if all UAVs have a vehicle and a place.
  const bool whole = scenario.fleet.size() == file.fleet.size() && all_placed;
  if (whole && scenario.fleet.size() <= kMostUavs) check_starts(scenario, errors);
  errors.throw_if_any();
  find_scene_files(scenario, options, errors);
  errors.throw_if_any();
  check_routes(scenario, errors);
  errors.throw_if_any();
  return scenario;
}

VehicleConfig load_vehicle(const std::string& name_or_path, const fs::path& config_dir) {
  return read_config_file<VehicleConfig>(find_config_file("vehicle", name_or_path, config_dir / "vehicles"));
}

std::string to_yaml(const Scenario& scenario) {
  ScenarioFile file;
  file.scenario = scenario;
  for (const UavConfig& uav : scenario.fleet) {
    file.fleet.push_back({uav.name, uav.vehicle, uav.start, tidy_degrees(uav.start_yaw)});
  }
  return config_to_yaml(file);
}

std::string to_yaml(const VehicleConfig& vehicle) { return config_to_yaml(vehicle); }

}  // namespace skein
