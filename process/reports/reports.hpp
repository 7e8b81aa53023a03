// Final reports of all programs, for the launcher's result.json and for people (program_report.hpp). describe() of each
// struct lists the members' keys in the order of the files. A report may be damaged, or come from a user's program:
// missing members are empty.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/run/run_state.hpp"
#include "process/reports/flight_check_report.hpp"
#include "process/reports/poor_point_report.hpp"
#include "process/reports/relayed_topic.hpp"
#include "process/reports/work_part_report.hpp"

namespace skein {

// ---- sim_server -------------------------------------------------------------------------------------------------

struct CollisionReport {
  Number time_s = {};
  Text uav = {};
  Text with = {};   ///< "ground", "structure" or a UAV
  Text cause = {};  ///< "battery": the UAV fell because its battery was empty; otherwise missing
  std::optional<std::array<double, 3>> position = {};
};
void describe(auto& f, CollisionReport& collision) {
  f.field("cause", collision.cause);
  f.field("position", collision.position);
  f.field("time_s", collision.time_s);
  f.field("uav", collision.uav);
  f.field("with", collision.with);
}

/// A fault of the run's fault file, or one that a viewer added during the run.
struct FaultReport {
  Text kind = {}, target = {};
  Number at_s = {}, until_s = {};          ///< `until_s` empty: to the end; `at_s` empty: its condition never held
  Count began_step = {}, ended_step = {};  ///< empty: it did not begin, or end, during the run
  Text when = {};                          ///< the condition for which it waited
  std::optional<bool> by_hand = {};        ///< true: added by a viewer; empty: from the fault file
};
void describe(auto& f, FaultReport& fault) {
  f.nullable("at_s", fault.at_s);
  f.nullable("began_step", fault.began_step);
  f.field("by_hand", fault.by_hand);
  f.nullable("ended_step", fault.ended_step);
  f.field("kind", fault.kind);
  f.field("target", fault.target);
  f.nullable("until_s", fault.until_s);
  f.field("when", fault.when);
}

struct LostMember {
  Text member = {};
  Count step = {};
  Number time_s = {};
  Text reason = {};
  Number back_at_s = {};  ///< time at which it joined again; none: it did not
};
void describe(auto& f, LostMember& lost) {
  f.nullable("back_at_s", lost.back_at_s);
  f.field("member", lost.member);
  f.field("reason", lost.reason);
  f.field("step", lost.step);
  f.field("time_s", lost.time_s);
}

/// CPU time of the server's thread by kind of work, and the counts of this work.
struct TimingReport {
  Number physics_s = {}, lidar_s = {}, camera_s = {}, links_s = {}, recording_s = {};
  Number cpu_s = {};  ///< total
  Count scans = {}, exposures = {}, steps = {};
  Number lidar_ms_per_scan = {};
};
void describe(auto& f, TimingReport& timing) {
  f.field("camera_s", timing.camera_s);
  f.field("cpu_s", timing.cpu_s);
  f.field("exposures", timing.exposures);
  f.field("lidar_ms_per_scan", timing.lidar_ms_per_scan);
  f.field("lidar_s", timing.lidar_s);
  f.field("links_s", timing.links_s);
  f.field("physics_s", timing.physics_s);
  f.field("recording_s", timing.recording_s);
  f.field("scans", timing.scans);
  f.field("steps", timing.steps);
}

/// The referee's record of a UAV's work, second by second (core/run/work_time.hpp).
struct WorkReport {
  std::string open = {};          ///< one letter per second, as in WorkTrack
  std::vector<Amount> done = {};  ///< in least amounts
};
void describe(auto& f, WorkReport& work) {
  f.field("done", work.done);
  f.field("open", work.open);
}

/// A battery at the end of the run.
struct BatteryReport {
  Number charge = {};  ///< remaining share
  Number energy_wh = {}, capacity_wh = {}, mean_power_w = {};
  Number empty_s = {};  ///< time at which it became empty
  /// The UAV was on the ground at the end, and had landed with at most a tenth of the charge above its reserve.
  std::optional<bool> grounded = {};
  Count swaps = {};  ///< none: batteries are not swapped
};
void describe(auto& f, BatteryReport& battery) {
  f.field("capacity_wh", battery.capacity_wh);
  f.field("charge", battery.charge);
  f.field("empty_s", battery.empty_s);
  f.field("energy_wh", battery.energy_wh);
  f.field("grounded", battery.grounded);
  f.field("mean_power_w", battery.mean_power_w);
  f.field("swaps", battery.swaps);
}

struct UavReport {
  Text name = {};
  std::optional<Role> role = {};
  std::optional<bool> alive = {};
  Number distance_m = {}, max_speed_mps = {};
  Count captures = {};
  Number idle_s = {};
  Count commands_rejected = {};
  Number first_rejected_s = {};
  Count commands_unheard = {};
  std::optional<WorkReport> work = {};
  std::optional<BatteryReport> battery = {};
};
void describe(auto& f, UavReport& uav) {
  f.field("alive", uav.alive);
  f.field("battery", uav.battery);
  f.field("captures", uav.captures);
  f.field("commands_rejected", uav.commands_rejected);
  f.field("commands_unheard", uav.commands_unheard);
  f.field("distance_m", uav.distance_m);
  f.field("first_rejected_s", uav.first_rejected_s);
  f.field("idle_s", uav.idle_s);
  f.field("max_speed_mps", uav.max_speed_mps);
  f.field("name", uav.name);
  f.field("role", uav.role);
  f.field("work", uav.work);
}

/// A UAV that a person flew by hand.
struct HandReport {
  Text uav = {};
  Text file = {};       ///< file in the run's folder with the hand commands
  Count commands = {};  ///< number of commands in the file
};
void describe(auto& f, HandReport& hand) {
  f.field("commands", hand.commands);
  f.field("file", hand.file);
  f.field("uav", hand.uav);
}

/// The settings of a run, for runs without a launcher, which would know them.
struct FlightReport {
  Text scenario = {};  ///< as given to the server
  Count seed = {}, scene_seed = {}, uavs = {}, run = {};
  Number duration_s = {};
  Text clock = {}, dds = {};
};
void describe(auto& f, FlightReport& flight) {
  f.field("clock", flight.clock);
  f.field("dds", flight.dds);
  f.field("duration_s", flight.duration_s);
  f.field("run", flight.run);
  f.field("scenario", flight.scenario);
  f.field("scene_seed", flight.scene_seed);
  f.field("seed", flight.seed);
  f.field("uavs", flight.uavs);
}

struct SimServerReport {
  std::optional<RunStatus> status = {};
  std::optional<bool> deterministic = {};
  Text digest = {};
  Number sim_time_s = {}, mission_time_s = {}, wall_time_s = {};
  Text rules = {};       ///< the preset
  Text conditions = {};  ///< in the syntax of --conditions; none: ideal conditions
  Count points_total = {};
  Text points_seen = {};  ///< one digit per interest point; 1: it was in some picture
  /// By interest point: the best score that pictures would have had if UAVs had been where they believed to be, and
  /// without wind; empty: without such a condition, or without pictures.
  std::optional<std::vector<Amount>> points_if_exact = {}, points_if_calm = {};
  std::optional<std::vector<PoorPointReport>> points_poor = {};  ///< ascending by index
  std::vector<CollisionReport> collisions = {};
  std::vector<UavReport> uavs = {};
  std::vector<LostMember> lost_members = {};
  std::vector<FaultReport> faults = {};
  std::optional<std::vector<HandReport>> hand = {};  ///< only if a person flew a UAV
  TimingReport timing = {};
  FlightReport flight = {};
  std::optional<FlightCheckReport> flight_check = {};
  Texts warnings = {};
  Count malformed = {};  ///< samples invalid for their topic's type; all reports have this and the next two members
  Count unsent = {};     ///< samples that could not be sent
  Texts unwritten = {};  ///< files that could not be written, one sentence each
  std::optional<Texts> differences = {};  ///< differences from the run that this run repeats, one sentence each
};
void describe(auto& f, SimServerReport& report) {
  f.field("collisions", report.collisions);
  f.field("conditions", report.conditions);
  f.field("deterministic", report.deterministic);
  f.nullable("digest", report.digest);
  f.field("faults", report.faults);
  f.field("flight", report.flight);
  f.field("flight_check", report.flight_check);
  f.field("hand", report.hand);
  f.field("lost_members", report.lost_members);
  f.field("malformed", report.malformed);
  f.field("mission_time_s", report.mission_time_s);
  f.field("points_if_calm", report.points_if_calm);
  f.field("points_if_exact", report.points_if_exact);
  f.field("points_poor", report.points_poor);
  f.field("points_seen", report.points_seen);
  f.field("points_total", report.points_total);
  f.field("rules", report.rules);
  f.field("sim_time_s", report.sim_time_s);
  f.field("status", report.status);
  f.field("timing", report.timing);
  f.field("uavs", report.uavs);
  f.field("unsent", report.unsent);
  f.field("unwritten", report.unwritten);
  f.field("differences", report.differences);
  f.field("wall_time_s", report.wall_time_s);
  f.field("warnings", report.warnings);
}

// ---- station ----------------------------------------------------------------------------------------------------

/// A point that scored, with the UAV and the capture that count for it.
struct ScoredPointReport {
  Count index = {};
  Number score = {};
  Text uav = {};
  Count capture = {};
};
void describe(auto& f, ScoredPointReport& point) {
  f.field("index", point.index);
  f.field("score", point.score);
  f.field("uav", point.uav);
  f.field("capture", point.capture);
}

struct StationReport {
  Count points_detected = {};
  Number score = {};
  Number score_earned = {};  ///< score of all captures, delivered or not; empty: unknown
  Named<double> score_by_uav = {};
  std::optional<std::vector<ScoredPointReport>> points = {};
  Named<std::uint64_t> refused = {};  ///< number of refused capture reports, by reason
  Count reports_received = {}, duplicates = {}, malformed = {}, unsent = {};
  Text dds = {};
  Texts unwritten = {};
};
void describe(auto& f, StationReport& report) {
  f.field("points_detected", report.points_detected);
  f.field("score", report.score);
  f.field("score_earned", report.score_earned);
  f.field("score_by_uav", report.score_by_uav);
  f.field("points", report.points);
  f.field("refused", report.refused);
  f.field("reports_received", report.reports_received);
  f.field("duplicates", report.duplicates);
  f.field("dds", report.dds);
  f.field("malformed", report.malformed);
  f.field("unsent", report.unsent);
  f.field("unwritten", report.unwritten);
}

// ---- comm_router ------------------------------------------------------------------------------------------------

/// Numbers of radio messages by what happened to them.
struct RadioCounts {
  Count sent = {}, delivered = {}, dropped_no_los = {}, dropped_fault = {}, dropped_overflow = {}, duplicated = {};
  Count corrupted = {};
  Count sent_bytes = {}, delivered_bytes = {};
};
void describe_fates(auto& f, RadioCounts& counts) {
  f.field("corrupted", counts.corrupted);
  f.field("delivered", counts.delivered);
  f.field("delivered_bytes", counts.delivered_bytes);
  f.field("dropped_fault", counts.dropped_fault);
  f.field("dropped_no_los", counts.dropped_no_los);
  f.field("dropped_overflow", counts.dropped_overflow);
  f.field("duplicated", counts.duplicated);
}
void describe_sent(auto& f, RadioCounts& counts) {
  f.field("sent", counts.sent);
  f.field("sent_bytes", counts.sent_bytes);
}

struct LinkReport {
  Text from = {}, to = {};
  RadioCounts counts = {};
};
void describe(auto& f, LinkReport& link) {
  describe_fates(f, link.counts);
  f.field("from", link.from);
  describe_sent(f, link.counts);
  f.field("to", link.to);
}

struct RouterReport {
  RadioCounts total = {};
  Count malformed = {};
  Count unheard = {};  ///< messages of programs outside the lock-step
  Count unsent = {};
  std::vector<LinkReport> per_link = {};
  Text dds = {};
  Texts warnings = {}, unwritten = {};
  std::optional<Texts> differences = {};  ///< as in SimServerReport
};
void describe(auto& f, RouterReport& report) {
  f.field("dds", report.dds);
  f.field("differences", report.differences);
  describe_fates(f, report.total);
  f.field("malformed", report.malformed);
  f.field("per_link", report.per_link);
  describe_sent(f, report.total);
  f.field("unheard", report.unheard);
  f.field("unsent", report.unsent);
  f.field("unwritten", report.unwritten);
  f.field("warnings", report.warnings);
}

// ---- agents -----------------------------------------------------------------------------------------------------

/// A span of simulated time in which the agent's planner reported that it waited for another UAV.
struct WaitReport {
  Number from_s = {}, until_s = {};
  Text uav = {};
};
void describe(auto& f, WaitReport& wait) {
  f.field("from_s", wait.from_s);
  f.field("uav", wait.uav);
  f.field("until_s", wait.until_s);
}

/// Numbers of exchanges in which the safety filter watched the UAV's motion, since the agent was started.
struct SafetyFilterReport {
  Count steps = {};     ///< all of them
  Count slowed = {};    ///< it made the UAV brake
  Count breaches = {};  ///< the space about the UAV was not proved free beforehand
};
void describe(auto& f, SafetyFilterReport& filter) {
  f.field("breaches", filter.breaches);
  f.field("slowed", filter.slowed);
  f.field("steps", filter.steps);
}

struct AgentReport {
  Number planner_cpu_s = {}, planner_cpu_p99_ms = {}, planner_cpu_max_ms = {};
  Count planner_exchanges_over_50ms = {};
  Number waited_s = {};
  std::optional<std::vector<WaitReport>> waits = {};  ///< by time
  std::optional<Texts> no_way = {};
  std::optional<std::vector<RelayedTopic>> from_nodes = {};  ///< only of a stand-in: topics with any ROS 2 messages
  std::optional<SafetyFilterReport> safety_filter = {};      ///< missing: no flight core flies the UAV
  /// Parts of the time planner_cpu_s; missing: the agent did not time them (--time-parts).
  std::optional<std::vector<WorkPartReport>> planner_parts = {};
  Count malformed = {}, unsent = {};
  Text planner = {};  ///< as given to the agent
  Text dds = {};
  std::optional<Texts> unwritten = {};
};
void describe(auto& f, AgentReport& report) {
  f.field("dds", report.dds);
  f.field("from_nodes", report.from_nodes);
  f.field("malformed", report.malformed);
  f.field("no_way", report.no_way);
  f.field("planner", report.planner);
  f.field("planner_cpu_max_ms", report.planner_cpu_max_ms);
  f.field("planner_cpu_p99_ms", report.planner_cpu_p99_ms);
  f.field("planner_cpu_s", report.planner_cpu_s);
  f.field("planner_exchanges_over_50ms", report.planner_exchanges_over_50ms);
  f.field("planner_parts", report.planner_parts);
  f.field("safety_filter", report.safety_filter);
  f.field("unsent", report.unsent);
  f.field("unwritten", report.unwritten);
  f.field("waited_s", report.waited_s);
  f.field("waits", report.waits);
}

/// Output of an agent program with --list-planners.
struct StrategyList {
  Texts planners = {}, ground_programs = {};
};
void describe(auto& f, StrategyList& list) {
  f.field("planners", list.planners);
  f.field("ground_programs", list.ground_programs);
}

}  // namespace skein
