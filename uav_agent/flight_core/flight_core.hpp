// Flies a UAV for its strategy: takeoff, goals, trips that bring captures home, and recovery where nothing works.
//
//   ground -> takeoff -> working <-> homing
//                          \-> showing, recovering -> working
//
// A strategy hands over ranked goals (api/goals.hpp) and hears what became of them; it needs to call nothing else.
// Where a UAV may fly is not decided here but by the safety filter (safety_filter.hpp).
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "uav_agent/flight_core/caution.hpp"
#include "uav_agent/flight_core/doing.hpp"
#include "uav_agent/flight_core/homing.hpp"
#include "uav_agent/flight_core/navigator.hpp"
#include "uav_agent/flight_core/recovery.hpp"
#include "uav_agent/flight_core/showing.hpp"

namespace skein::agent {

class FlightCore {
 public:
  /// @param config, agent  must outlive this.
  FlightCore(const FlightConfig& config, const AgentConfig& agent);
  FlightCore(const FlightCore&) = delete;  // parts refer to each other
  FlightCore& operator=(const FlightCore&) = delete;

  /// Once per exchange, before anything else.
  void update(const PlannerInput& in) {
    caution_.update(in);
    filter_.expect(caution_.errors());
    navigator_.update(in);
    recovery_.update(in);
  }
  /// For PlannerInput: what became of the goals since this was asked last. Outcomes are kept until the UAV works: its
  /// strategy hears each of them at a time when it decides.
  FlightState state();
  /// One exchange, after the strategy has decided.   @param goals  see PlannerOutput::goals.
  Steering step(const PlannerInput& in, std::optional<std::vector<Goal>> goals);
  /// Lets the tracker go on by one exchange, as fast as is safe.
  std::optional<TrajectoryCommand> move(Tracker& tracker, const SafetyFilter::Facts& facts) {
    const double most_mps = filter_.assumes_boxes() ? config_.alone_mps : navigator_.pace_mps();
    return filter_.step(tracker, facts, std::min(most_mps, caution_.most_mps()), navigator_.retraces());
  }

  /// Whom it waits for, in this exchange.
  const std::optional<std::size_t>& waits_for() const { return waits_for_; }
  /// Why there was no way to a goal, in this exchange; empty: there was none to look for, or one.
  const std::string& no_way() const { return no_way_; }
  /// What it is about, in this exchange, for people.   @param in  as step() had it.
  Doing doing(const PlannerInput& in) const;
  /// Where it is about to fly: what others should tell it of first.
  std::optional<Vector3d> going_to_W() const;
  /// Where its strategy may choose to work, as of now.
  FreeSpace space(const PlannerInput& in) const { return navigator_.open_space(in); }
  const SafetyFilter& filter() const { return filter_; }

 private:
  enum class Mode { ground, takeoff, working, homing, showing, recovering, landing };

  void leave_ground(const PlannerInput& in, Steering& steering);
  void take_off(const PlannerInput& in, Steering& steering);
  std::vector<Outcome> outcomes();
  void work(const PlannerInput& in, Steering& steering);
  bool begin_showing(const PlannerInput& in);
  void show(const PlannerInput& in, Steering& steering);
  void go_home(const PlannerInput& in, Steering& steering);
  void begin_landing(const PlannerInput& in, Steering& steering);
  void land(const PlannerInput& in, Steering& steering);
  bool flies_along() const;
  Doing::What doing_home(const PlannerInput& in) const;
  int neighbours_after() const;
  std::optional<std::size_t> lifts_off_after(const PlannerInput& in);
  void enter(Mode mode, const PlannerInput& in);

  const FlightConfig& config_;
  const AgentConfig& agent_;
  Caution caution_;
  SafetyFilter filter_;
  ToldSpace told_;
  Navigator navigator_;
  Homing homing_;
  Recovery recovery_;
  Showing showing_;
  Mode mode_ = Mode::ground;
  Tick since_ = 0;                   ///< in this mode
  std::optional<Tick> ready_since_;  ///< on the ground
  std::optional<Vector3d> top_W_;    ///< of the climb
  double climbed_m_ = 0.0;           ///< so high, at...
  Tick climbed_at_ = 0;
  Tick show_at_ = 0;                    ///< not before
  std::optional<Tick> at_place_since_;  ///< of homing, without a link
  std::size_t next_place_ = 0;
  bool lost_way_home_ = false;     ///< it recovers since there was no way to any place of homing
  bool descends_ = false;          ///< above where it lands
  std::vector<Outcome> outcomes_;  ///< for the strategy
  std::vector<Goal> wanted_;       ///< by the strategy, to be taken up when it works again
  std::optional<std::size_t> waits_for_;
  std::string no_way_;
};

}  // namespace skein::agent
