#include "cli/hunt/fault_maker.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "cli/hunt/draws.hpp"
#include "cli/hunt/weather_faults.hpp"
#include "core/faults/fault_check.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/text/text.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kMostFaults = 6;
constexpr double kShortest_s = 0.1, kLongest_s = 40.0;
/// Motor failures are short and weak: no planner can save a vehicle that lacks the thrust to stay in the air.
constexpr double kLongestMotorFailure_s = 2.0, kLeastThrust = 0.6;
/// Longest fault of odometry: no planner can save a vehicle that has relied on a wrong position for too long.
constexpr double kLongestOdometryFault_s = 12.0;
constexpr double kShareOfWaiting = 0.2;  ///< share of faults that begin when a condition becomes true
/// Share of link faults that apply to all senders. The same share applies to all receivers.
constexpr double kShareOfAllNodes = 0.4;
constexpr double kShareOfAllTopics = 0.5;         ///< share of link faults that apply to all topics
constexpr double kShareOfGroundPrograms = 0.4;    ///< share of kills and pauses; every UAV depends on these programs
constexpr double kShareOfKillsWithoutEnd = 0.15;  ///< share of kills of a UAV's program that have no end
/// Share of faults that are repeated: some defects show only if a fault hits a rare instant, and repeated faults hit
/// such an instant sooner.
constexpr double kShareOfRepeated = 0.2, kLeastInterval_s = 2.0, kLongestInterval_s = 12.0;

/// The maker draws kinds in proportion to their weights. Programs and radio can fail in more ways than the rest, so
/// their weights are larger.
struct Kind {
  const char* name;
  int weight;
};
constexpr Kind kKinds[] = {{"link", 4},          {"partition", 2},     {"blackout", 2},        {"station_outage", 2},
                           {"kill", 5},          {"pause", 3},         {"lidar_failure", 2},   {"camera_failure", 1},
                           {"motor_failure", 1}, {"command_delay", 1}, {"odometry_freeze", 1}, {"odometry_jump", 1},
                           {"stuck_gimbal", 1},  {"gust", 2},          {"fix_loss", 2},        {"battery_loss", 1},
                           {"conditions", 2}};

/// Faults that change the conditions of the run (weather_faults.hpp).
constexpr std::string_view kWeather[] = {"gust", "fix_loss", "battery_loss", "conditions"};

bool chance(RandomStream& draw, double share) { return draw.uniform() < share; }
const std::string& one_of(const std::vector<std::string>& names, RandomStream& draw) {
  return names[below(draw, names.size())];
}
double rounded(double value, double step) { return std::round(value / step) * step; }
/// Draws a duration [s]: mostly short, sometimes long.
double drawn_length(RandomStream& draw, double longest_s) {
  const double u = draw.uniform();
  return tenths(kShortest_s + (longest_s - kShortest_s) * u * u);
}

double longest_allowed_s(const Fault& fault) {
  if (std::holds_alternative<MotorFailure>(fault.action)) return kLongestMotorFailure_s;
  const bool is_of_odometry =
      std::holds_alternative<OdometryFreeze>(fault.action) || std::holds_alternative<OdometryJump>(fault.action);
  return is_of_odometry ? kLongestOdometryFault_s : kLongest_s;
}

bool has_no_end(const Fault& fault) { return !fault.waits && !fault.until_s; }

double length_of(const Fault& fault) {
  return fault.waits ? fault.for_s.value_or(1.0) : fault.until_s.value_or(fault.at_s + 1.0) - fault.at_s;
}
void set_length(Fault& fault, double length_s) {
  if (has_no_end(fault)) return;
  if (fault.waits) {
    fault.for_s = length_s;
  } else {
    fault.until_s = tenths(fault.at_s + length_s);
  }
}

}  // namespace

const std::vector<std::string>& fault_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const Kind& kind : kKinds) names.emplace_back(kind.name);
    return names;
  }();
  return kinds;
}

FaultMaker::FaultMaker(const Scenario& scenario, FaultSpace space)
    : space_(std::move(space)),
      scenarios_conditions_(scenario.conditions),
      conditions_(scenario.conditions),
      shortest_s_(std::max(kShortest_s, std::ceil(10.0 * scenario.exchange_period_s - 1e-6) / 10.0)),
      uavs_(scenario.uav_names()),
      nodes_(uavs_),
      ground_programs_{programs::kStation, programs::kCommRouter} {
  for (const UavConfig& one : scenario.fleet) {
    if (one.vehicle.lidar) with_lidar_.push_back(one.name);
  }
  nodes_.push_back(scenario.node_name(kStationNode));
  if (space_.ground_program) ground_programs_.push_back(scenario.node_name(kStationNode));
  std::set<std::string> topics;
  for (const RadioRoute& route : radio_routes(scenario)) {
    topics.insert(route.ros_topic.substr(0, route.ros_topic.find('/', 1)));  // "/captures" includes "/captures/changi"
  }
  topics_.assign(topics.begin(), topics.end());
}

FaultMaker FaultMaker::under(const std::string& conditions) const {
  FaultMaker maker = *this;
  if (!conditions.empty()) maker.conditions_ = chosen_conditions(conditions, scenarios_conditions_);
  return maker;
}

const std::string& FaultMaker::uav(RandomStream& draw) const { return one_of(uavs_, draw); }
const std::string& FaultMaker::node(RandomStream& draw) const { return one_of(nodes_, draw); }
const std::string& FaultMaker::program(RandomStream& draw) const {
  return chance(draw, kShareOfGroundPrograms) ? one_of(ground_programs_, draw) : uav(draw);
}
bool FaultMaker::kills_uav_program(const Fault& fault) const {
  const auto* kill = std::get_if<Kill>(&fault.action);
  return kill != nullptr && std::ranges::find(uavs_, kill->member) != uavs_.end();
}

LinkEffect FaultMaker::link(RandomStream& draw) const {
  LinkEffect effect;
  if (!chance(draw, kShareOfAllNodes)) effect.from = {node(draw)};
  if (!chance(draw, kShareOfAllNodes)) effect.to = {node(draw)};
  if (effect.from == effect.to) effect.to = {"all"};
  if (!topics_.empty() && !chance(draw, kShareOfAllTopics)) effect.topics = {one_of(topics_, draw)};
  switch (below(draw, 8)) {
    case 0:
      effect.loss = chance(draw, 0.5) ? 1.0 : hundredths(draw.uniform(0.1, 0.9));
      break;
    case 1:
      effect.burst_loss = BurstLoss{tenths(draw.uniform(0.5, 8.0)), tenths(draw.uniform(0.5, 5.0)), 1.0};
      break;
    case 2:
      effect.latency_s = hundredths(draw.uniform(0.05, 3.0));
      effect.jitter_s = hundredths(draw.uniform(0.0, 1.0));
      break;
    case 3:
      effect.bandwidth_bit_s = 1000.0 * std::round(draw.uniform(1.0, 64.0));
      effect.queue_bytes = 1024 * static_cast<std::int64_t>(draw.uniform(1.0, 33.0));
      break;
    case 4:
      effect.duplication = hundredths(draw.uniform(0.1, 1.0));
      break;
    case 5:
      effect.reordering = Reordering{hundredths(draw.uniform(0.1, 0.9)), tenths(draw.uniform(0.1, 3.0))};
      break;
    case 6:
      effect.corruption = hundredths(draw.uniform(0.05, 0.8));
      break;
    default:
      effect.topics = {"all"};
      effect.range_m = std::round(draw.uniform(10.0, 80.0));
  }
  return effect;
}

FaultAction FaultMaker::action(const std::string& kind, RandomStream& draw) const {
  if (kind == "link") return link(draw);
  if (kind == "partition") {
    Partition partition{{{}, {}}};
    for (const std::string& name : nodes_) partition.groups[below(draw, 2)].push_back(name);
    std::erase_if(partition.groups, [](const auto& group) { return group.empty(); });
    // A group of all nodes changes nothing. A node that is in no group is cut off from all others.
    if (partition.groups.size() == 1) partition.groups[0].erase(partition.groups[0].begin());
    return partition;
  }
  if (kind == "blackout") return Blackout{uav(draw)};
  if (kind == "station_outage") return StationOutage{};
  if (kind == "kill") return Kill{program(draw)};
  if (kind == "pause") return Pause{program(draw)};
  if (kind == "lidar_failure" && !with_lidar_.empty()) return LidarFailure{one_of(with_lidar_, draw)};
  if (kind == "motor_failure") {
    return MotorFailure{uav(draw), static_cast<int>(below(draw, 6)), hundredths(draw.uniform(kLeastThrust, 0.95))};
  }
  if (kind == "command_delay") return CommandDelay{uav(draw), 1 + static_cast<int>(below(draw, 20))};
  if (kind == "odometry_freeze") return OdometryFreeze{uav(draw)};
  if (kind == "odometry_jump") {
    const auto offset = [&draw] { return tenths(draw.uniform(-3.0, 3.0)); };
    Vector3d offset_m(offset(), offset(), offset());
    if (offset_m.isZero(0.0)) offset_m.x() = 1.0;
    return OdometryJump{uav(draw), offset_m};
  }
  if (kind == "stuck_gimbal") return StuckGimbal{uav(draw)};
  if (std::ranges::find(kWeather, kind) != std::end(kWeather)) return weather_fault(kind, uav(draw), conditions_, draw);
  return CameraFailure{uav(draw)};
}

std::optional<FaultCondition> FaultMaker::condition(RandomStream& draw) const {
  const std::string name = uav(draw);
  const std::string station = nodes_.back();
  const auto whole = [&draw](double low, double high) { return number_text(std::round(draw.uniform(low, high))); };
  switch (below(draw, 7)) {
    case 0:
      return FaultCondition{"held(" + name + ") >= " + whole(1.0, 20.0)};
    case 1:
      return FaultCondition{"not link(" + name + ", " + station + ")"};
    case 2:
      return FaultCondition{"link(" + name + ", " + station + ")"};
    case 3:
      return FaultCondition{"separation(" + name + ") < " + whole(2.0, 10.0) + " m"};
    case 4:
      return FaultCondition{"clearance(" + name + ") < " + whole(2.0, 6.0) + " m"};
    case 5:
      return FaultCondition{"not member(" + program(draw) + ")"};
    default:
      return FaultCondition{"captures(" + name + ") >= " + whole(1.0, 100.0)};
  }
}

/// Draws when a fault begins, or the condition that it waits for, and how long it lasts.
void FaultMaker::place(Fault& fault, RandomStream& draw) const {
  fault.at_s = tenths(draw.uniform(1.0, space_.heal_by_s - 1.0));
  const double length_s = drawn_length(draw, longest_allowed_s(fault));
  fault.waits = chance(draw, kShareOfWaiting);
  fault.when.reset();
  fault.for_s.reset();
  fault.until_s = space_.heal_by_s;
  if (!fault.waits && kills_uav_program(fault) && chance(draw, kShareOfKillsWithoutEnd)) {
    fault.until_s.reset();
    return;
  }
  if (fault.waits) {
    fault.when = condition(draw);
    fault.at_s = rounded(0.5 * fault.at_s, 1.0);
  }
  set_length(fault, length_s);
  end_in_time(fault);
}

/// Limits the times of a fault so that it ends by heal_by_s, but lasts for shortest_s_ at least.
void FaultMaker::end_in_time(Fault& fault) const {
  fault.at_s = std::clamp(fault.at_s, 0.0, space_.heal_by_s - shortest_s_);
  if (has_no_end(fault) && kills_uav_program(fault)) return;
  if (fault.waits) {
    fault.until_s = space_.heal_by_s;
    fault.for_s = std::max(shortest_s_, *fault.for_s);
    return;
  }
  const double earliest_s = tenths(fault.at_s + shortest_s_);
  fault.until_s = std::max(earliest_s, std::min(fault.until_s.value_or(earliest_s), space_.heal_by_s));
}

std::optional<Fault> FaultMaker::any_fault(RandomStream& draw) const {
  std::vector<std::string> weighted_kinds;  // each possible kind, as many times as its weight
  for (const Kind& kind : kKinds) {
    const bool wanted = std::ranges::find(space_.kinds, kind.name) != space_.kinds.end();
    if (!wanted || !is_possible(kind.name, conditions_)) continue;
    for (int i = 0; i < kind.weight; ++i) weighted_kinds.emplace_back(kind.name);
  }
  if (weighted_kinds.empty()) return std::nullopt;
  Fault fault{0.0, std::nullopt, action(one_of(weighted_kinds, draw), draw)};
  place(fault, draw);
  return fault;
}

std::vector<Fault> FaultMaker::schedule(RandomStream& draw) const {
  std::vector<Fault> faults;
  for (std::size_t left = 1 + below(draw, 4); left > 0; --left) {
    const std::optional<Fault> fault = any_fault(draw);
    if (!fault) return {};
    faults.push_back(*fault);
    if (chance(draw, kShareOfRepeated)) repeat(faults, draw);
  }
  if (faults.size() > kMostFaults) faults.resize(kMostFaults);
  return without_contradictions(std::move(faults));
}

/// Repeats the last fault up to three times at equal intervals, and shortens all of them to at most half an
/// interval.
void FaultMaker::repeat(std::vector<Fault>& faults, RandomStream& draw) const {
  Fault fault = faults.back();
  const double interval_s = tenths(draw.uniform(kLeastInterval_s, kLongestInterval_s));
  const std::size_t times = 1 + below(draw, 3);
  if (fault.waits || !fault.until_s) return;
  set_length(fault, std::min(length_of(fault), tenths(0.5 * interval_s)));
  faults.back() = fault;
  for (std::size_t i = 0; i < times; ++i) {
    fault.at_s = tenths(fault.at_s + interval_s);
    fault.until_s = tenths(*fault.until_s + interval_s);
    if (*fault.until_s <= space_.heal_by_s) faults.push_back(fault);
  }
}

std::vector<Fault> FaultMaker::varied(std::vector<Fault> faults, const std::vector<Fault>& other,
                                      RandomStream& draw) const {
  // A schedule that was drawn for other conditions may contain faults that are impossible under conditions_.
  const auto erase_impossible = [&] {
    std::erase_if(faults, [&](const Fault& fault) { return !is_possible(fault, conditions_); });
  };
  erase_impossible();
  for (std::size_t left = 1 + below(draw, 2); left > 0; --left) {
    vary_one(faults, other, draw);
    erase_impossible();
  }
  if (faults.empty()) return schedule(draw);
  return without_contradictions(std::move(faults));
}

void FaultMaker::vary_one(std::vector<Fault>& faults, const std::vector<Fault>& other, RandomStream& draw) const {
  const std::size_t change = below(draw, 8);
  if (faults.empty() || (change == 0 && faults.size() < kMostFaults)) {
    if (const std::optional<Fault> fault = any_fault(draw)) faults.push_back(*fault);
    return;
  }
  const std::size_t at = below(draw, faults.size());
  Fault& fault = faults[at];
  switch (change) {
    case 1:
      if (faults.size() > 1) faults.erase(faults.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case 2: {  // earlier or later
      const double length_s = length_of(fault), shift_s = draw.uniform(-8.0, 8.0);
      fault.at_s = tenths(std::max(0.0, fault.at_s + shift_s));
      set_length(fault, length_s);
      break;
    }
    case 3:  // shorter or longer
      set_length(fault,
                 tenths(std::min(longest_allowed_s(fault), length_of(fault) * draw.uniform(0.3, 2.5) + kShortest_s)));
      break;
    case 4:  // another target or strength
      fault.action = action(fault_kind(fault), draw);
      break;
    case 5: {  // at the same time as another fault, or right after it
      const Fault& neighbour = faults[below(draw, faults.size())];
      const double length_s = length_of(fault), end_s = neighbour.until_s.value_or(neighbour.at_s);
      fault.at_s = chance(draw, 0.5) ? neighbour.at_s : std::min(end_s, space_.heal_by_s - 1.0);
      set_length(fault, length_s);
      break;
    }
    case 6:  // add a fault of the other schedule
      if (!other.empty() && faults.size() < kMostFaults) faults.push_back(other[below(draw, other.size())]);
      return;
    default:
      place(fault, draw);
  }
  end_in_time(fault);
}

std::vector<Fault> without_contradictions(std::vector<Fault> faults) {
  std::vector<Fault> kept;
  const auto end = [](const Fault& fault) { return fault.until_s.value_or(1e9); };
  for (Fault& fault : faults) {
    const auto held = held_by(fault.action);
    const bool contradicts =
        held && std::ranges::any_of(kept, [&](const Fault& other) {
          return held_by(other.action) == held && fault.at_s < end(other) && other.at_s < end(fault);
        });
    if (!contradicts) kept.push_back(std::move(fault));
  }
  return kept;
}

std::vector<std::string> words_of(const Fault& fault) {
  std::vector<std::string> words = {fault_kind(fault)};
  if (!std::holds_alternative<LinkEffect>(fault.action)) return words;
  const ConfigNode node = to_node(fault);
  const ConfigNode* effect = node.find(words.front());
  if (effect != nullptr) words.insert(words.end(), effect->keys.begin(), effect->keys.end());
  return words;
}

}  // namespace skein::cli
