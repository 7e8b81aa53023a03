// A fault file: what goes wrong in a run, when, and until when. The same file gives the same faults, bit for bit, in
// every run of the same scenario and seed: times are simulated and mean the first exchange at or after them, and
// random links draw from keyed streams. docs/faults.md lists all faults for users; config/faults/ has worked examples.
// Pure; files are read by load_fault_plan().
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/expressions/expression.hpp"
#include "core/expressions/signal_table.hpp"
#include "core/radio/link_effect.hpp"
#include "core/radio/link_matrix.hpp"
#include "core/scenario.hpp"

namespace skein {

/// Messages pass between nodes of one group only; who is in no group is in a group of its own.
struct Partition {
  std::vector<std::vector<std::string>> groups;
};
/// A UAV's radio is dead: no message, key frame or neighbour's odometry goes in or out.
struct Blackout {
  std::string uav;
};
/// The ground station's radio is dead.
struct StationOutage {};
/// A program is killed (SIGKILL) at the fault's beginning and started again at its end.
struct Kill {
  std::string member;  ///< UAV, "station", "comm_router" or "gcs"
};
/// A program is stopped (SIGSTOP) at the fault's beginning and goes on (SIGCONT) at its end: it misses all between.
struct Pause {
  std::string member;
};
/// No scans, no key frames.
struct LidarFailure {
  std::string uav;
};
/// No captures.
struct CameraFailure {
  std::string uav;
};
/// What the UAV's software, and its neighbours, are told of where it is stays what it was; stamps go on.
struct OdometryFreeze {
  std::string uav;
};
/// They are told that it is somewhere else. Its flight control knows better.
struct OdometryJump {
  std::string uav;
  Vector3d offset_m = Vector3d::Zero();  ///< in W

  template <class R>
  void describe(R& r) {
    r.required("uav", uav);
    r.required("offset_m", offset_m, within(-1000.0, 1000.0));
    r.check(!offset_m.isZero(0.0), "offset_m", "must not be zero");
  }
};
/// The gimbal stays where it is, whatever it is told.
struct StuckGimbal {
  std::string uav;
};
/// A rotor gives only a part of its thrust and torque.
struct MotorFailure {
  std::string uav;
  int rotor = 0;        ///< 0..5, at 30 + 60 rotor degrees from the body's x axis
  double thrust = 0.0;  ///< share that is left, [0, 1)

  template <class R>
  void describe(R& r) {
    r.required("uav", uav);
    r.required("rotor", rotor, within(0, 5));
    r.field("thrust", thrust, within(0.0, 0.999));
  }
};
/// The air about a UAV moves by this much more.
struct Gust {
  std::string uav;
  Vector3d velocity_mps = Vector3d::Zero();  ///< of the air, in W

  template <class R>
  void describe(R& r) {
    r.required("uav", uav);
    r.required("velocity_mps", velocity_mps, within(-50.0, 50.0));
    r.check(!velocity_mps.isZero(0.0), "velocity_mps", "must not be zero");
  }
};
/// A UAV's commands take effect later.
struct CommandDelay {
  std::string uav;
  int exchanges = 0;

  template <class R>
  void describe(R& r) {
    r.required("uav", uav);
    r.required("exchanges", exchanges, within(1, 1200));
  }
};

using FaultAction =
    std::variant<LinkEffect, Partition, Blackout, StationOutage, Kill, Pause, LidarFailure, CameraFailure, MotorFailure,
                 CommandDelay, OdometryFreeze, OdometryJump, StuckGimbal, Gust>;

/// What a fault waits for: the server looks at it at the end of each exchange.
struct FaultCondition {
  std::string text;
  Expression condition = {};
  std::vector<SignalUse> signals = {};  ///< that it is about
};

struct Fault {
  double at_s = 0.0;              ///< simulated time since the start of the run; while it waits, not before
  std::optional<double> until_s;  ///< none: to the end of the run
  FaultAction action;
  std::optional<FaultCondition> when = {};  ///< it begins with the first exchange after one in which this holds
  std::optional<double> for_s = {};         ///< beside `when`: ends so long after its beginning, if not by `until_s`
  bool waits = false;                       ///< for its condition; then it is not in force

  /// Its condition has held: it begins with the exchange at this tick, unless that is after its end.
  void set_off(Tick tick);
  /// Whether it is time to look at its condition, for an exchange at this tick.
  bool may_begin(Tick tick) const;
  /// Whether it is in force in the exchange at this tick: from the first one at or after `at_s` to the last one
  /// before `until_s`.
  bool active(Tick tick) const { return !waits && tick >= begin() && (!end() || tick < *end()); }
  Tick begin() const;  ///< in ticks, rounded up
  std::optional<Tick> end() const;
};

struct FaultPlan {
  std::filesystem::path file;  ///< empty: no faults
  std::string name, description;
  std::vector<Fault> faults;         ///< in the file's order
  std::filesystem::path named = {};  ///< the fault file that it names; empty: none

  bool empty() const { return faults.empty(); }
};

/// Where a fault stands in its file: "faults[2]".
std::string fault_path(std::size_t index);
/// The kind of a fault as files spell it ("partition") and whom it concerns ("jurong", "gcs jurong | raffles"); for
/// results and logs.
std::string fault_kind(const Fault& fault);
std::string fault_target(const Fault& fault);

/// Which links blackouts, outages and partitions cut in the exchange at this tick: 1 = cut. nullopt when there is
/// nothing to cut.
std::optional<LinkMatrix<std::uint8_t>> cut_links(const FaultPlan& plan, const Scenario& scenario, Tick tick);

/// Of a file that is a fault test too, `run` and `expect` are not looked at. `faults` may name another fault file, of
/// config/faults/ or beside this one.
/// @param file      empty: an empty plan.
/// @param scenario  whose nodes may be named, and whose mission's end no time may exceed.
/// @param seed      of the run: draws the times that the file leaves open (`at_s: [8, 12]`); every program that loads
///   the file must be given the same.
/// @throws InputError naming file, line and key: a node, UAV or program that does not exist, a time after the end, an
///   end before its beginning, a probability above 1, an event with no action or two, and events that contradict each
///   other (the same thing failing twice at once).
FaultPlan load_fault_plan(const std::filesystem::path& file, const Scenario& scenario, std::uint64_t seed = 0);

/// The faults of a file that by_hand_text() (fault_writer.hpp) wrote. Times may go on as long as a run may.
/// @param origin  names the text in messages. @throws InputError as load_fault_plan().
std::vector<Fault> read_faults_by_hand(const std::string& text, const std::string& origin, const Scenario& scenario);

}  // namespace skein
