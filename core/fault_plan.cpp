#include "core/fault_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "core/config_files.hpp"
#include "core/config_node.hpp"
#include "core/config_reader.hpp"
#include "core/random_stream.hpp"
#include "core/suggestion.hpp"
#include "core/text.hpp"

namespace skein {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

Tick tick_at_or_after(double time_s) { return static_cast<Tick>(std::ceil(time_s / kTickS - 1e-6)); }

// ---- the file ---------------------------------------------------------------------------------------------------

/// Times that a fault may begin or end at: one, or those between two, of which the run's seed draws one.
struct TimeRange {
  double earliest_s = 0.0, latest_s = 0.0;

  /// A whole number of milliseconds, unless there is nothing to draw.
  double drawn(std::uint64_t seed, std::size_t fault, std::uint64_t which) const {
    if (earliest_s == latest_s) return earliest_s;
    RandomStream stream(seed, "fault_time", fault, which);
    return std::round(1e3 * stream.uniform(earliest_s, latest_s)) / 1e3;
  }
};

/// `8`, or `[8, 12]`; `time` stays what it is when the key is absent.
template <class R>
void read_time(R& r, const std::string& key, const Bounds& bounds, std::optional<TimeRange>& time,
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

/// A fault as the file has it: times, and exactly one of the actions.
struct FaultEntry {
  std::optional<TimeRange> at_s, until_s;
  std::optional<LinkEffect> link;
  std::optional<std::vector<std::vector<std::string>>> partition;
  std::optional<std::string> blackout, kill, pause, lidar_failure, camera_failure;
  std::optional<bool> station_outage;
  std::optional<MotorFailure> motor_failure;
  std::optional<CommandDelay> command_delay;

  template <class R>
  void describe(R& r) {
    read_time(r, "at_s", within(0.0, 36000.0), at_s, true);
    read_time(r, "until_s", Bounds{0.0, 36000.0, true}, until_s);
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
  }

  /// As long as any seed can make it, and as short.
  Fault longest(const FaultAction& action) const {
    return {at_s->earliest_s, until_s ? std::optional(until_s->latest_s) : std::nullopt, action};
  }
  Fault shortest(const FaultAction& action) const {
    return {at_s->latest_s, until_s ? std::optional(until_s->earliest_s) : std::nullopt, action};
  }

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
    return all;
  }
};

struct FaultFile {
  std::string name, description;
  std::variant<std::string, std::vector<FaultEntry>> faults;  ///< a text: the file that lists them

  template <class R>
  void describe(R& r) {
    r.field("name", name);
    r.field("description", description);
    r.required("faults", faults);
  }
};

/// Without what only `skein test --faults` looks at (cli/fault_tests/fault_test.hpp).
ConfigDocument read_fault_file(const std::filesystem::path& file) {
  ConfigDocument document = read_config_document(file);
  for (const char* key : {"run", "expect"}) document.root.remove(key);
  return document;
}

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

// ---- checks -----------------------------------------------------------------------------------------------------

const char* key_of(const FaultAction& action) {
  return std::visit(
      Overloaded{
          [](const LinkEffect&) { return "link"; }, [](const Partition&) { return "partition"; },
          [](const Blackout&) { return "blackout"; }, [](const StationOutage&) { return "station_outage"; },
          [](const Kill&) { return "kill"; }, [](const Pause&) { return "pause"; },
          [](const LidarFailure&) { return "lidar_failure"; }, [](const CameraFailure&) { return "camera_failure"; },
          [](const MotorFailure&) { return "motor_failure"; }, [](const CommandDelay&) { return "command_delay"; }},
      action);
}

/// What a fault takes hold of: two that hold the same thing at once contradict each other. Links hold nothing, since
/// several effects may act on one link.
std::optional<std::string> held_by(const FaultAction& action) {
  using Text = std::optional<std::string>;
  return std::visit(
      Overloaded{[](const LinkEffect&) -> Text { return std::nullopt; },
                 [](const Partition&) -> Text { return "the partition"; },
                 [](const Blackout& f) -> Text { return "the radio of " + f.uav; },
                 [](const StationOutage&) -> Text { return "the radio of gcs"; },
                 [](const Kill& f) -> Text { return "the process of " + f.member; },
                 [](const Pause& f) -> Text { return "the process of " + f.member; },
                 [](const LidarFailure& f) -> Text { return "the LiDAR of " + f.uav; },
                 [](const CameraFailure& f) -> Text { return "the camera of " + f.uav; },
                 [](const MotorFailure& f) -> Text { return "rotor " + std::to_string(f.rotor) + " of " + f.uav; },
                 [](const CommandDelay& f) -> Text { return "the commands of " + f.uav; }},
      action);
}

class FaultChecker {
 public:
  FaultChecker(const Scenario& scenario, ConfigErrors& errors)
      : scenario_(scenario), errors_(errors), uavs_(scenario.uav_names()) {
    nodes_ = uavs_;
    nodes_.insert(nodes_.begin(), scenario.node_name(kStationNode));
    members_ = nodes_;
    members_.insert(members_.end(), {"station", "comm_router"});
  }

  /// @param longest  as long as any seed can make it. @param shortest  and as short
  void check(const Fault& longest, const Fault& shortest, const std::string& path) {
    check_times(longest, shortest, path);
    const std::string key = path + "." + key_of(longest.action);
    std::visit(Overloaded{[&](const LinkEffect& f) { check_link(f, key); },
                          [&](const Partition& f) { check_partition(f, key); },
                          [&](const Blackout& f) { check_name(f.uav, uavs_, key, "UAV"); }, [](const StationOutage&) {},
                          [&](const Kill& f) { check_name(f.member, members_, key, "program"); },
                          [&](const Pause& f) { check_name(f.member, members_, key, "program"); },
                          [&](const LidarFailure& f) { check_lidar(f, key); },
                          [&](const CameraFailure& f) { check_name(f.uav, uavs_, key, "UAV"); },
                          [&](const MotorFailure& f) { check_name(f.uav, uavs_, key + ".uav", "UAV"); },
                          [&](const CommandDelay& f) { check_name(f.uav, uavs_, key + ".uav", "UAV"); }},
               longest.action);
    check_contradiction(longest, path);
  }

 private:
  void check_times(const Fault& longest, const Fault& shortest, const std::string& path) {
    const std::string end = text(scenario_.duration_s);
    errors_.check(shortest.at_s < scenario_.duration_s, path + ".at_s",
                  "is after the end: the mission of '" + scenario_.name + "' lasts " + end + " s");
    if (!longest.until_s) return;
    errors_.check(shortest.until_s > shortest.at_s, path + ".until_s",
                  "must be later than at_s, " + text(shortest.at_s));
    errors_.check(*longest.until_s <= scenario_.duration_s, path + ".until_s",
                  "is after the end: the mission of '" + scenario_.name + "' lasts " + end +
                      " s; leave the key out for a fault that lasts to the end");
  }

  void check_name(const std::string& name, const std::vector<std::string>& known, const std::string& key,
                  const std::string& what) {
    const bool found = std::find(known.begin(), known.end(), name) != known.end();
    errors_.check(found, key, "there is no " + what + " '" + name + "'; " + suggestion(name, known));
  }

  void check_link(const LinkEffect& effect, const std::string& key) {
    for (const auto& [end, names] : {std::pair("from", &effect.from), std::pair("to", &effect.to)}) {
      const std::string path = key + "." + end;
      errors_.check(!names->empty(), path, "must name at least one node, or be the word all");
      for (const std::string& name : *names) {
        if (name != "all") check_name(name, nodes_, path, "node");
      }
    }
  }

  void check_partition(const Partition& partition, const std::string& key) {
    errors_.check(!partition.groups.empty(), key, "must be a list of groups, each a list of nodes");
    std::set<std::string> seen;
    for (const auto& group : partition.groups) {
      for (const std::string& name : group) {
        check_name(name, nodes_, key, "node");
        errors_.check(seen.insert(name).second, key, "'" + name + "' is in two groups");
      }
    }
  }

  void check_lidar(const LidarFailure& failure, const std::string& key) {
    check_name(failure.uav, uavs_, key, "UAV");
    const auto uav = std::find(uavs_.begin(), uavs_.end(), failure.uav);
    if (uav == uavs_.end()) return;
    const bool has_one = scenario_.fleet[static_cast<std::size_t>(uav - uavs_.begin())].vehicle.lidar.has_value();
    errors_.check(has_one, key, "'" + failure.uav + "' has no LiDAR");
  }

  void check_contradiction(const Fault& fault, const std::string& path) {
    const auto held = held_by(fault.action);
    if (!held) return;
    std::map<Tick, Holder>& holders = holders_[*held];
    const Tick end = fault.end().value_or(std::numeric_limits<Tick>::max());
    const auto next = holders.lower_bound(fault.begin());
    const Holder* other = next != holders.end() && next->first < end ? &next->second : nullptr;
    if (next != holders.begin() && std::prev(next)->second.end > fault.begin()) other = &std::prev(next)->second;
    if (other == nullptr) {
      holders.emplace(fault.begin(), Holder{end, path});
    } else {
      errors_.check(
          false, path,
          "contradicts " + other->path + ": both take hold of " + *held + " at the same time; part their times");
    }
  }

  static std::string text(double value) {
    std::string digits = std::to_string(value);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits;
  }

  const Scenario& scenario_;
  ConfigErrors& errors_;
  std::vector<std::string> uavs_, nodes_, members_;
  /// From its begin on.
  struct Holder {
    Tick end;
    std::string path;
  };
  /// By what is held, then by begin. They do not overlap, so that a new one need be compared with its neighbours only.
  std::map<std::string, std::map<Tick, Holder>> holders_;
};

}  // namespace

Tick Fault::begin() const { return tick_at_or_after(at_s); }

std::optional<Tick> Fault::end() const { return until_s ? std::optional(tick_at_or_after(*until_s)) : std::nullopt; }

std::string fault_kind(const Fault& fault) { return key_of(fault.action); }

std::string fault_target(const Fault& fault) {
  const auto groups = [](const Partition& partition) {
    std::vector<std::string> texts;
    for (const auto& group : partition.groups) texts.push_back(joined(group, " "));
    return joined(texts, " | ");
  };
  return std::visit(
      Overloaded{[](const LinkEffect& f) { return joined(f.from, " ") + " > " + joined(f.to, " "); }, groups,
                 [](const StationOutage&) { return std::string("gcs"); }, [](const Kill& f) { return f.member; },
                 [](const Pause& f) { return f.member; }, [](const auto& f) { return f.uav; }},
      fault.action);
}

std::optional<LinkMatrix<std::uint8_t>> cut_links(const FaultPlan& plan, const Scenario& scenario, Tick tick) {
  std::optional<LinkMatrix<std::uint8_t>> cut;
  const auto cut_where = [&](const auto& is_cut) {
    if (!cut) cut.emplace(scenario.fleet.size() + 1);
    for (const Node from : scenario.nodes()) {
      for (const Node to : scenario.nodes()) {
        if (from != to && is_cut(from, to)) cut->at(from, to) = 1;
      }
    }
  };
  const auto silence = [&](Node silent) { cut_where([&](Node a, Node b) { return a == silent || b == silent; }); };
  for (const Fault& fault : plan.faults) {
    if (!fault.active(tick)) continue;
    if (std::holds_alternative<StationOutage>(fault.action)) silence(kStationNode);
    if (const auto* blackout = std::get_if<Blackout>(&fault.action)) {
      silence(node_of_uav(scenario.uav_index(blackout->uav)));
    }
    if (const auto* partition = std::get_if<Partition>(&fault.action)) {
      const auto group = [&](Node node) {
        for (std::size_t i = 0; i < partition->groups.size(); ++i) {
          if (names_node(partition->groups[i], scenario.node_name(node))) return i;
        }
        return partition->groups.size() + node;
      };
      cut_where([&](Node a, Node b) { return group(a) != group(b); });
    }
  }
  return cut;
}

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
  ConfigErrors errors(document);
  const auto* faults = std::get_if<std::vector<FaultEntry>>(&content.faults);
  errors.check(faults != nullptr, "faults", "must be a list of faults here: another file names this one");
  errors.throw_if_any();
  FaultChecker checker(scenario, errors);
  for (std::size_t i = 0; i < faults->size(); ++i) {
    const FaultEntry& entry = (*faults)[i];
    const std::string path = "faults[" + std::to_string(i) + "]";
    const std::vector<FaultAction> actions = entry.actions();
    errors.check(actions.size() == 1, path,
                 "must have exactly one of link, partition, blackout, station_outage, kill, pause, lidar_failure, "
                 "camera_failure, motor_failure, command_delay; it has " +
                     std::to_string(actions.size()));
    errors.check(entry.station_outage.value_or(true), path + ".station_outage", "must be true, or be left out");
    if (actions.size() != 1) continue;
    Fault& fault = plan.faults.emplace_back(entry.at_s->drawn(seed, i, 0), std::nullopt, actions.front());
    if (entry.until_s) fault.until_s = entry.until_s->drawn(seed, i, 1);
    checker.check(entry.longest(fault.action), entry.shortest(fault.action), path);
  }
  errors.throw_if_any();
  return plan;
}

}  // namespace skein
