// What every flight has around its work: lifting off in turn, the climb to a layer of its own, the trips that bring
// captures home, and a pilot that looks out all the while. The planner only decides what to do in the air between.
//
//   ground -> climbing -> working <-> delivering
//
// Nobody climbs into a roof: explorers look up before, photographers wait for what explorers saw, who come for them
// (escort.hpp) if need be.
// Nobody stands still: a UAV that neither moves nor photographs anything new is turned, so that its LiDAR sees more,
// and then taken somewhere else, with less and less caution, from where its planner decides anew.
// Once per exchange the planner asks step() and acts on its answer.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include "uav_agent/flight/delivery.hpp"
#include "uav_agent/flight/escort.hpp"
#include "uav_agent/flight/pilot.hpp"
#include "uav_agent/flight/progress_watch.hpp"

namespace skein::agent {

class Sortie {
 public:
  static constexpr double kAirborneM = 2.0;  ///< who begins at such a height was restarted in flight

  struct Config {
    double climb_mps = 3.0;
    double transit_mps = 4.0;                                ///< from here to there, and home
    double retreat_mps = 4.0;                                ///< back out of corners
    double clearance_m = 1.2;                                ///< from the UAV's body to a box above its start
    double deliver_every_s = 240.0, return_margin_s = 12.0;  ///< see delivery.hpp
  };

  /// What the planner has to do in this exchange.
  enum class Turn {
    nothing,  ///< the sortie decides: on the ground, climbing, delivering, or giving way to somebody
    begin,    ///< at rest in the air, free to work: after the climb, a delivery, or a restart in flight
    work,     ///< carry on: on its way, or arrived (Pilot::arrived())
    detour,   ///< carry on, but the pilot has left the path to go around somebody: waypoints have other numbers now
    blocked,  ///< the path came to nothing (why: situation()): decide anew
    leave,    ///< the sortie now goes to deliver: the work in hand is given up; begin follows if there is time left
  };

  /// @param agent  must outlive this.
  Sortie(const Config& config, const AgentConfig& agent);
  Sortie(const Sortie&) = delete;  // parts refer to each other
  Sortie& operator=(const Sortie&) = delete;

  /// To be told once, when the boxes have come: nobody begins work before.
  /// @param top_m  of all structure.   @param blind_height_m  see lift_off.hpp.
  void know_site(double top_m, double blind_height_m);

  /// @param space  where this UAV may fly as of now.
  Turn step(const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out);

  /// To be called in each exchange in which its strategy lets this UAV wait for another one: the sortie leaves it where
  /// it is.
  void waits_for(std::size_t uav, const PlannerInput& in, PlannerOutput& out);

  /// Whether it turns on the spot to see more: whoever turns the body has to leave that alone.
  bool looks_around(Tick now) const { return now < turn_at_; }

  /// True from `begin` until `leave`.
  bool working() const { return state_ == State::working; }
  /// What came between, of the last `blocked`.
  Situation situation() const { return situation_; }
  /// For the work: paths, retreats, stops.
  Pilot& pilot() { return pilot_; }
  const Pilot& pilot() const { return pilot_; }

 private:
  enum class State { ground, climbing, working, stirring, escorting, delivering };

  Turn leave_ground(const PlannerInput& in, PlannerOutput& out);
  Turn climb(const PlannerInput& in, PlannerOutput& out);
  void climb_on(const PlannerInput& in);
  Vector3d climbs_from(const PlannerInput& in) const;
  double open_above_m(const PlannerInput& in, double roof_m, double room_m) const;
  void rise(double height_m, const PlannerInput& in, PlannerOutput& out);
  bool sky_is_open(const PlannerInput& in);
  bool nothing_above(double room_m, const PlannerInput& in) const;
  bool is_alone(const PlannerInput& in);
  void look_up(const PlannerInput& in, PlannerOutput& out);
  bool starts_beside_explorer() const;
  bool explorer_up(double height_m, std::optional<double> within_m, const PlannerInput& in) const;
  bool explorer_stays(std::optional<Tick>& since, double height_m, double within_m, const PlannerInput& in);
  bool explorer_came_up(const PlannerInput& in);
  Turn begin_work();
  FreeSpace::Config lookout(FreeSpace::Config space) const;
  void look_around(const PlannerInput& in, PlannerOutput& out);
  void turn(const PlannerInput& in, PlannerOutput& out);
  bool stir(const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out);
  bool climb_out(const PlannerInput& in, PlannerOutput& out);
  Turn escort(const PlannerInput& in, PlannerOutput& out);
  Turn react(const PlannerInput& in, PlannerOutput& out);

  const Config config_;
  const AgentConfig& agent_;
  Pilot pilot_;
  Delivery delivery_;
  Escort escort_;
  State state_ = State::ground;
  Situation situation_ = Situation::flying_on;
  bool site_known_ = false;
  double top_m_ = 0.0, blind_height_m_ = 0.0;
  double ground_m_ = 0.0;
  Vector3d climb_to_ = Vector3d::Zero();
  bool lifts_off_ = true;            ///< else, if it climbs, it had been at work
  bool was_climbing_ = false;        ///< when its program was restarted...
  bool climbs_on_ = false;           ///< ...and does so now: it had been told before that nothing is above
  bool knows_above_ = false;         ///< that nothing is in the way to climb_to_, or nobody will ever know
  std::optional<Tick> looks_since_;  ///< up, or waits for others who do
  std::optional<Tick> came_up_at_;   ///< an explorer, where it sees roofs
  std::optional<Tick> fetched_at_;   ///< one is beside this UAV
  ProgressWatch watch_;
  Tick waits_at_ = -ticks(1e6);  ///< when it last waited for a mate
  Tick rose_at_ = 0, turn_at_ = 0, stir_at_ = 0;
  double stir_clearance_m_ = 0.0;
  bool finds_no_way_ = false;
  int stirs_ = 0;        ///< times in all
  int stirred_ = 0;      ///< times, since it last got on by itself
  int climbs_ = 0;       ///< that were stopped
  Tick not_before_ = 0;  ///< of the next one
};

}  // namespace skein::agent
