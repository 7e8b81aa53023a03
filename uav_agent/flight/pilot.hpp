// Flying from here to there without hitting anything: the part that planners of any kind share. The pilot
// keeps the path that is being flown, stops it before what the map shows, gives way to other UAVs, goes around
// them, and finds back out of corners. What to do when a path came to nothing is the planner's decision.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/separation.hpp"

namespace skein::agent {

/// What a planner learns when it asks its pilot to look out.
enum class Situation {
  flying_on,  ///< all is well, arrived, or there is no path
  waiting,    ///< gives way, or flies on after that: nothing to decide
  detour,     ///< has left the path for a way around somebody; the numbers of its waypoints no longer hold
  obstacle,   ///< has stopped for something on the map; the path is gone
  crowded,    ///< has stopped for somebody who stays in the way; the path is gone
  stuck,      ///< does not get on with its path, for whatever reason
};

/// What came of the wish to fly somewhere. Tests as true when there is a way, and it is being flown.
struct Way {
  bool found = true;
  Barrier at_goal = Barrier::none;  ///< why the goal itself may not be entered
  bool gave_up = false;             ///< there may be one, but the search took too much effort

  explicit operator bool() const { return found; }
  /// For a log: "no way was found to a place that is free".
  std::string why() const;
};

class Pilot {
 public:
  struct Config {
    double speed_mps = 4.5;  ///< from here to there
    double retreat_mps = 4.0;
  };

  /// @param agent  must outlive this.
  Pilot(const Config& config, const AgentConfig& agent) : config_(config), separation_(Separation::Config(), agent) {}

  /// To be asked first in every exchange once in the air; may set out.motion, and has then decided this
  /// exchange's motion.
  /// @param may_detour  false: does not leave its path for another UAV (a climb), but is crowded at once.
  Situation look_out(const PlannerInput& in, const FreeSpace::Config& space, bool may_detour, PlannerOutput& out);

  /// There is a way, then, whatever was told of others in this exchange.
  void follow(Path path, const PlannerInput& in, PlannerOutput& out);
  /// Along a path that it finds itself. If there is none, or none was found in time, it does nothing and says why.
  Way fly_to(const Vector3d& goal, const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out);
  /// As near to a goal as it gets.   @param worth_m  by less than this it does not set out.   @returns whether it does.
  bool fly_nearer(const Vector3d& goal, double worth_m, const PlannerInput& in, const FreeSpace::Config& space,
                  PlannerOutput& out);
  /// To be told by whoever searches for ways itself and finds none. @returns why.
  Way no_way(const Vector3d& goal, const FreeSpace& space, PlannerOutput& out, bool gave_up = false);
  /// The goal to which there was no way, if it has followed none since.
  const std::optional<Vector3d>& missed_W() const { return missed_W_; }
  /// Some metres back the way it came, out of a corner where no path begins. @returns false if it came from
  /// nowhere.
  /// @param leave_trail  false: another retreat from there goes farther back, instead of forth again.
  bool retreat(const PlannerInput& in, PlannerOutput& out, bool leave_trail = true);
  /// Its last motion was a retreat.
  bool retreated() const { return retreated_; }
  /// Brakes and forgets the path, also one that was set in this exchange: nobody looks out on a path that is forgotten.
  void stop(PlannerOutput& out);

  /// Who is in its way, of the last `waiting`.
  std::optional<std::size_t> hindered_by() const { return separation_.hindered_by(); }
  bool has_path() const { return !path_.waypoints.empty(); }
  bool arrived(const PlannerInput& in) const { return has_path() && !paused_ && in.tracking.done; }
  /// The way here shall not be flown back (it led up from the ground).
  void forget_trail() { trail_.clear(); }
  /// Where it may fly as of now, other UAVs in sight and boxes that are not near to `goal` or here left out.
  FreeSpace way_space(const PlannerInput& in, const FreeSpace::Config& space, const Vector3d& goal) const;
  /// Whom it lets leave the ground first.
  std::optional<std::size_t> lifts_off_after(const PlannerInput& in) {
    return separation_.lifts_off_after(in.tick, in.peers);
  }

 private:
  std::vector<Waypoint> rest_of_path(const PlannerInput& in) const;
  Situation give_way(const PlannerInput& in, const FreeSpace::Config& space, bool may_detour, PlannerOutput& out);
  bool go_around(const std::vector<Waypoint>& rest, const PlannerInput& in, const FreeSpace::Config& space,
                 PlannerOutput& out);
  bool obstacle_ahead(const PlannerInput& in, const std::vector<Waypoint>& rest);
  double came_nearer_m(const PlannerInput& in, double limit_m);
  bool stands_still(const PlannerInput& in);
  void add_to_trail(const Vector3d& p_W);
  void set_out(Path path, PlannerOutput& out);
  void look_before_leaving(const PlannerInput& in, PlannerOutput& out);
  static void slow_down_where_little_was_seen(const PlannerInput& in, Path& path);

  const Config config_;
  Separation separation_;
  Path path_;              ///< being flown, or to be taken up again after a pause
  bool paused_ = false;    ///< gives way
  bool sets_out_ = false;  ///< on a path at which it has not looked yet: no planner is trusted for a moment
  bool refused_ = false;   ///< the path that it was given: the next look says what for
  bool climbs_ = false;
  bool leaves_trail_ = true;
  bool retreated_ = false;
  std::optional<Vector3d> missed_W_;
  std::optional<double> clearance_m_;   ///< of the last look, if there is a map to look at
  std::optional<Vector3d> tight_at_W_;  ///< where it was farthest off, of a place with too little room
  std::deque<Vector3d> trail_;          ///< where it was, a metre apart
  std::optional<Tick> detour_at_;       ///< when it last met somebody who stood in the way
  Vector3d watched_p_W_ = Vector3d::Zero();
  Tick watched_since_ = 0;
};

}  // namespace skein::agent
