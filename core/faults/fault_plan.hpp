// A fault file: which faults a run has, and when each begins and ends. With the same scenario and seed, a file gives
// bit-identical faults in every run: times are simulated, a fault begins with the first exchange at or after its time,
// and random effects on links draw from keyed streams. docs/faults.md lists all faults; config/faults/ has examples.
// Pure; files are read by load_fault_plan().
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config_node.hpp"
#include "core/expressions/expression.hpp"
#include "core/expressions/signal_table.hpp"
#include "core/radio/link_effect.hpp"
#include "core/radio/link_matrix.hpp"
#include "core/scenario/scenario.hpp"

namespace skein {

/// Messages pass only between nodes of the same group. A node that is in no group can exchange messages with no other.
struct Partition {
  std::vector<std::vector<std::string>> groups;
};
/// A UAV's radio is dead: it neither sends nor receives anything, be it messages, key frames or odometry.
struct Blackout {
  std::string uav;
};
/// The ground station's radio is dead.
struct StationOutage {};
/// A program is killed (SIGKILL) at the fault's beginning and started again at its end.
struct Kill {
  std::string member;  ///< UAV, "station", "comm_router" or "gcs"
};
/// A program is stopped (SIGSTOP) at the fault's beginning and continued (SIGCONT) at its end. It misses all messages
/// in between.
struct Pause {
  std::string member;
};
/// A UAV's LiDAR yields no scans and no key frames.
struct LidarFailure {
  std::string uav;
};
/// A UAV's camera yields no captures.
struct CameraFailure {
  std::string uav;
};
/// The odometry that the UAV's software and its neighbours receive keeps its last value; its stamps advance.
struct OdometryFreeze {
  std::string uav;
};
/// The UAV's software and its neighbours receive odometry with an offset. The flight controller uses the true position.
struct OdometryJump {
  std::string uav;
  Vector3d offset_m = Vector3d::Zero();  ///< in W

  void describe(auto& r) {
    r.required("uav", uav);
    r.required("offset_m", offset_m, within(-1000.0, 1000.0));
    r.check(!offset_m.isZero(0.0), "offset_m", "must not be zero");
  }
};
/// The gimbal keeps its angles and ignores commands.
struct StuckGimbal {
  std::string uav;
};
/// A rotor yields only a part of its thrust and torque.
struct MotorFailure {
  std::string uav;
  int rotor = 0;        ///< 0..5; rotor i is at 30 + 60 i degrees from body x towards y
  double thrust = 0.0;  ///< remaining share, [0, 1)

  void describe(auto& r) {
    r.required("uav", uav);
    r.required("rotor", rotor, within(0, 5));
    r.field("thrust", thrust, within(0.0, 0.999));
  }
};
/// Adds a velocity to that of the air around a UAV.
struct Gust {
  std::string uav;
  Vector3d velocity_mps = Vector3d::Zero();  ///< added velocity of the air, in W

  void describe(auto& r) {
    r.required("uav", uav);
    r.required("velocity_mps", velocity_mps, within(-50.0, 50.0));
    r.check(!velocity_mps.isZero(0.0), "velocity_mps", "must not be zero");
  }
};
/// A UAV's position fix is lost: until the fault ends, its position error is a random walk.
struct FixLoss {
  std::string uav;
};
/// A UAV's battery loses the charge that it has above a share of its capacity. The charge does not come back.
struct BatteryLoss {
  std::string uav;
  double charge = 0.0;  ///< share of the capacity, [0, 1)

  void describe(auto& r) {
    r.required("uav", uav);
    r.required("charge", charge, within(0.0, 0.999));
  }
};
/// Values of the scenario's conditions that differ while the fault is active, for the whole fleet. If several such
/// faults change the same value, the last one in the file wins.
struct ConditionsChange {
  ConfigNode values;  ///< as in a scenario's section `conditions`
};
/// A UAV's commands take effect this many exchanges later.
struct CommandDelay {
  std::string uav;
  int exchanges = 0;

  void describe(auto& r) {
    r.required("uav", uav);
    r.required("exchanges", exchanges, within(1, 1200));
  }
};

using FaultAction =
    std::variant<LinkEffect, Partition, Blackout, StationOutage, Kill, Pause, LidarFailure, CameraFailure, MotorFailure,
                 CommandDelay, OdometryFreeze, OdometryJump, StuckGimbal, Gust, FixLoss, BatteryLoss, ConditionsChange>;

/// The condition that a fault waits for. sim_server evaluates it at the end of each exchange.
struct FaultCondition {
  std::string text;
  Expression condition = {};
  std::vector<SignalUse> signals = {};  ///< the signals that the condition uses
};

struct Fault {
  double at_s = 0.0;              ///< begin, simulated time since the start of the run; while `waits`: earliest begin
  std::optional<double> until_s;  ///< end; none: the end of the run
  FaultAction action;
  std::optional<FaultCondition> when = {};  ///< the fault begins one exchange after this condition first holds
  std::optional<double> for_s = {};         ///< only with `when`: duration, unless `until_s` ends the fault earlier
  bool waits = false;                       ///< true: the condition has not held yet, and the fault is not active

  /// The caller has found that the condition holds: the fault begins with the exchange at this tick, and never becomes
  /// active if `until_s` is earlier.
  void set_off(Tick tick);
  /// Whether the fault still waits, and its times allow it to begin with the exchange at this tick. Only then does the
  /// caller need to evaluate the condition.
  bool may_begin(Tick tick) const;
  /// Whether the fault is active in the exchange at this tick: from the first exchange at or after `at_s` to the last
  /// one before `until_s`.
  bool active(Tick tick) const { return !waits && tick >= begin() && (!end() || tick < *end()); }
  Tick begin() const;  ///< in ticks, rounded up
  std::optional<Tick> end() const;
};

struct FaultPlan {
  std::filesystem::path file;  ///< empty: no faults
  std::string name, description;
  std::vector<Fault> faults;         ///< in the file's order
  std::filesystem::path named = {};  ///< the fault file that `file` refers to with `faults: NAME`; empty: none

  bool empty() const { return faults.empty(); }
};

/// Key path of a fault in its file: "faults[2]".
std::string fault_path(std::size_t index);
/// The kind of a fault as files spell it ("partition"), and its target ("jurong", "gcs jurong | raffles"); for results
/// and logs.
std::string fault_kind(const Fault& fault);
std::string fault_target(const Fault& fault);

/// The links that blackouts, outages and partitions cut in the exchange at this tick: 1 = cut. nullopt when there is
/// nothing to cut.
std::optional<LinkMatrix<std::uint8_t>> cut_links(const FaultPlan& plan, const Scenario& scenario, Tick tick);

/// Reads a fault file. Keys of a fault test (`run`, `expect`, `properties`, `capsule`) are ignored. `faults` may be the
/// name of another fault file, in config/faults/ or beside this one.
/// @param file      empty: an empty plan.
/// @param scenario  has the nodes that faults may name, and the mission time that no time may exceed.
/// @param seed      of the run: draws the times that the file leaves open (`at_s: [8, 12]`); every program that loads
///   the file must be given the same.
/// @throws InputError naming file, line and key: a node, UAV or program that does not exist, a time after the end, an
///   end before its beginning, a probability above 1, an event with no action or two, and events that contradict each
///   other (the same thing failing twice at once).
FaultPlan load_fault_plan(const std::filesystem::path& file, const Scenario& scenario, std::uint64_t seed = 0);

/// Parses the text of a file that by_hand_text() (fault_writer.hpp) wrote. Its times may lie up to takeoff_timeout_s
/// beyond the mission time, because they count from the start of the run.
/// @param origin  names the text in messages. @throws InputError as load_fault_plan().
std::vector<Fault> read_faults_by_hand(const std::string& text, const std::string& origin, const Scenario& scenario);

}  // namespace skein
