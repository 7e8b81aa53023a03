#include <array>
#include <cmath>

#include "core/config/config_files.hpp"
#include "core/config/config_node.hpp"
#include "core/config/config_reader.hpp"
#include "core/expressions/expression_parser.hpp"
#include "core/faults/fault_check.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/math/random_stream.hpp"
#include "core/radio/link_check.hpp"
#include "core/scenario/conditions_keys.hpp"
#include "core/text/text.hpp"

namespace skein {
namespace {

// ---- the file ---------------------------------------------------------------------------------------------------

/// The time at which a fault begins or ends: a fixed time, or a range from which the run's seed draws a time.
struct TimeRange {
  double earliest_s = 0.0, latest_s = 0.0;

  /// The drawn time, a whole number of milliseconds. A fixed time is returned as it is.
  double drawn(std::uint64_t seed, std::size_t fault, std::uint64_t which) const {
    if (earliest_s == latest_s) return earliest_s;
    RandomStream stream(seed, "fault_time", fault, which);
    return std::round(1e3 * stream.uniform(earliest_s, latest_s)) / 1e3;
  }
};

/// Reads `8` or `[8, 12]`. If the key is absent, `time` does not change.
void read_time(auto& r, const std::string& key, const Bounds& bounds, std::optional<TimeRange>& time,
               bool required = false) {
  std::variant<std::string, std::array<double, 2>> given;
  required ? r.required(key, given, bounds) : r.field(key, given, bounds);
  if (!r.has(key)) return;
  if (const auto* range = std::get_if<1>(&given)) {
    time = TimeRange{range->front(), range->back()};
    r.check(time->earliest_s <= time->latest_s, key, "must be a time, or [earliest, latest]");
    return;
  }
  const std::optional<double> value = parse_number(std::get<std::string>(given));
  r.check(value && bounds.contain(*value), key, "must be a number " + bounds.text() + ", or [earliest, latest]");
  time = TimeRange{value.value_or(0.0), value.value_or(0.0)};
}

/// A fault as the file has it: times or a condition, and exactly one of the actions.
struct FaultEntry {
  std::optional<TimeRange> at_s, until_s, for_s;
  std::optional<std::string> when;
  std::optional<LinkEffect> link;
  std::optional<std::vector<std::vector<std::string>>> partition;
  std::optional<std::string> blackout, kill, pause, lidar_failure, camera_failure;
  std::optional<bool> station_outage;
  std::optional<MotorFailure> motor_failure;
  std::optional<CommandDelay> command_delay;
  std::optional<std::string> odometry_freeze, stuck_gimbal;
  std::optional<OdometryJump> odometry_jump;
  std::optional<Gust> gust;
  std::optional<std::string> fix_loss;
  std::optional<BatteryLoss> battery_loss;
  std::optional<ConditionsConfig> conditions;  ///< read_faults() takes the values that the file has

  void describe(auto& r) {
    r.field("when", when);
    read_time(r, "at_s", within(0.0, 36000.0), at_s, !when);
    read_time(r, "until_s", Bounds{0.0, 36000.0, true}, until_s);
    read_time(r, "for_s", Bounds{0.0, 36000.0, true}, for_s);
    r.check(!for_s || for_s->earliest_s >= kTickS, "for_s",
            "must be at least " + number_text(kTickS) + " s, one tick of simulated time");
    r.check(when || !for_s || !until_s, "for_s", "cannot stand beside until_s: both say when it ends");
    r.field("link", link);
    r.field("partition", partition);
    r.field("blackout", blackout);
    r.field("station_outage", station_outage);
    r.field("kill", kill);
    r.field("pause", pause);
    r.field("lidar_failure", lidar_failure);
    r.field("camera_failure", camera_failure);
    r.field("motor_failure", motor_failure);
    r.field("command_delay", command_delay);
    r.field("odometry_freeze", odometry_freeze);
    r.field("odometry_jump", odometry_jump);
    r.field("stuck_gimbal", stuck_gimbal);
    r.field("gust", gust);
    r.field("fix_loss", fix_loss);
    r.field("battery_loss", battery_loss);
    r.field("conditions", conditions);
  }

  /// The fault with the longest duration that a seed or its condition can give it, and with the shortest.
  Fault longest(const FaultAction& action) const {
    Fault fault{earliest().earliest_s, std::nullopt, action};
    if (until_s) fault.until_s = until_s->latest_s;
    if (for_s && !when) fault.until_s = at_s->latest_s + for_s->latest_s;
    return fault;
  }
  Fault shortest(const FaultAction& action) const {
    Fault fault{earliest().latest_s, std::nullopt, action};
    if (until_s) fault.until_s = until_s->earliest_s;
    if (for_s && !when) fault.until_s = at_s->latest_s + for_s->earliest_s;
    return fault;
  }
  /// @param index  of the fault in its file
  Fault drawn(const FaultAction& action, std::uint64_t seed, std::size_t index) const {
    Fault fault{earliest().drawn(seed, index, 0), std::nullopt, action};
    if (until_s) fault.until_s = until_s->drawn(seed, index, 1);
    const auto length_s = for_s ? std::optional(for_s->drawn(seed, index, 2)) : std::nullopt;
    if (when) {
      fault.waits = true;
      fault.for_s = length_s;
    } else if (length_s) {
      fault.until_s = fault.at_s + *length_s;
    }
    return fault;
  }
  TimeRange earliest() const { return at_s.value_or(TimeRange{}); }

  /// In the order of the keys above.
  std::vector<FaultAction> actions() const {
    std::vector<FaultAction> all;
    if (link) all.emplace_back(*link);
    if (partition) all.emplace_back(Partition{*partition});
    if (blackout) all.emplace_back(Blackout{*blackout});
    if (station_outage) all.emplace_back(StationOutage{});
    if (kill) all.emplace_back(Kill{*kill});
    if (pause) all.emplace_back(Pause{*pause});
    if (lidar_failure) all.emplace_back(LidarFailure{*lidar_failure});
    if (camera_failure) all.emplace_back(CameraFailure{*camera_failure});
    if (motor_failure) all.emplace_back(*motor_failure);
    if (command_delay) all.emplace_back(*command_delay);
    if (odometry_freeze) all.emplace_back(OdometryFreeze{*odometry_freeze});
    if (odometry_jump) all.emplace_back(*odometry_jump);
    if (stuck_gimbal) all.emplace_back(StuckGimbal{*stuck_gimbal});
    if (gust) all.emplace_back(*gust);
    if (fix_loss) all.emplace_back(FixLoss{*fix_loss});
    if (battery_loss) all.emplace_back(*battery_loss);
    if (conditions) all.emplace_back(ConditionsChange{});
    return all;
  }
};

struct FaultFile {
  std::string name, description;
  bool by_hand = false;  ///< times may exceed the mission time by takeoff_timeout_s
  std::variant<std::string, std::vector<FaultEntry>> faults;  ///< a text: the file that lists them

  void describe(auto& r) {
    r.field("name", name);
    r.field("description", description);
    r.field("by_hand", by_hand);
    r.required("faults", faults);
  }
};

/// The document without the keys that only `skein test --faults` uses (cli/fault_tests/fault_test.hpp).
ConfigDocument without_test(ConfigDocument document) {
  for (const char* key : {"run", "expect", "properties", "capsule"}) document.root.remove(key);
  return document;
}
ConfigDocument read_fault_file(const std::filesystem::path& file) { return without_test(read_config_document(file)); }

/// The fault file that another one names.
std::filesystem::path file_named(const std::string& name, const ConfigDocument& by,
                                 const std::filesystem::path& beside) {
  ConfigErrors errors(by);
  try {
    return find_config_file("fault file", name, default_config_dir() / "faults", beside);
  } catch (const InputError& error) {
    errors.check(false, "faults", error.what());
  }
  errors.throw_if_any();
  return {};
}

FaultCondition read_condition(const std::string& text, const SignalNames& names, const std::string& key,
                              ConfigErrors& errors) {
  FaultCondition when{.text = text};
  const ExpressionScope scope{.names = names, .live_only = true};
  try {
    when.condition = parse_condition(text, scope, when.signals);
  } catch (const ExpressionError& error) {
    errors.add_at(key, error.at, error.what());
  }
  return when;
}

/// Only a link with a limited rate has a queue. `queue_bytes` of a LinkEffect is never empty, so this function looks
/// for the key in the file.
void check_queue(const ConfigNode& fault, const std::string& path, ConfigErrors& errors) {
  const ConfigNode* link = fault.find("link");
  if (link == nullptr || link->find("queue_bytes") == nullptr) return;
  errors.check(link->find("bandwidth_bit_s") != nullptr, path + ".link.queue_bytes", kNeedsBandwidth);
}

std::vector<Fault> read_faults(const FaultFile& content, const ConfigDocument& document, const Scenario& scenario,
                               std::uint64_t seed) {
  ConfigErrors errors(document);
  const auto* entries = std::get_if<std::vector<FaultEntry>>(&content.faults);
  errors.check(entries != nullptr, "faults", "must be a list of faults here: another file names this one");
  errors.throw_if_any();
  // Times count from the start of the run. The mission's clock starts later, with the first takeoff.
  const double wait_s = content.by_hand ? scenario.takeoff_timeout_s : 0.0;
  FaultChecker checker(scenario, errors, scenario.duration_s + wait_s);
  const SignalNames names(scenario);
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const FaultEntry& entry = (*entries)[i];
    const std::string path = fault_path(i);
    const std::vector<FaultAction> actions = entry.actions();
    errors.check(
        actions.size() == 1, path,
        "must have exactly one of link, partition, blackout, station_outage, kill, pause, lidar_failure, "
        "camera_failure, motor_failure, command_delay, odometry_freeze, odometry_jump, stuck_gimbal, gust, fix_loss, "
        "battery_loss, conditions; it has " +
            std::to_string(actions.size()));
    errors.check(entry.station_outage.value_or(true), path + ".station_outage", "must be true, or be left out");
    if (actions.size() != 1) continue;
    Fault& fault = faults.emplace_back(entry.drawn(actions.front(), seed, i));
    if (auto* change = std::get_if<ConditionsChange>(&fault.action)) {
      change->values = *document.root.find("faults")->items[i].find("conditions");
    }
    check_queue(document.root.find("faults")->items[i], path, errors);
    if (entry.when) fault.when = read_condition(*entry.when, names, path + ".when", errors);
    checker.check(entry.longest(fault.action), entry.shortest(fault.action), path);
  }
  errors.throw_if_any();
  return faults;
}

}  // namespace

FaultPlan load_fault_plan(const std::filesystem::path& file, const Scenario& scenario, std::uint64_t seed) {
  FaultPlan plan;
  if (file.empty()) return plan;
  ConfigDocument document = read_fault_file(file);
  FaultFile content = read_config<FaultFile>(document);
  plan.file = file;
  plan.name = content.name.empty() ? file.stem().string() : content.name;
  plan.description = content.description;
  if (const auto* named = std::get_if<std::string>(&content.faults)) {
    plan.named = file_named(*named, document, file.parent_path());
    document = read_fault_file(plan.named);
    content = read_config<FaultFile>(document);
  }
  plan.faults = read_faults(content, document, scenario, seed);
  return plan;
}

std::vector<Fault> read_faults_by_hand(const std::string& text, const std::string& origin, const Scenario& scenario) {
  const ConfigDocument document = parse_config_document(text, origin);
  return read_faults(read_config<FaultFile>(document), document, scenario, 0);
}

}  // namespace skein
