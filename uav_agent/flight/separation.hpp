// Keeping apart from the other UAVs, in line of sight or seen a moment ago: who starts first, who gives way.
// Frame W.   Units: SI.   Pure but for the waiting times.   Threads: one.
#pragma once

#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"

namespace skein::agent {

/// Where a UAV that follows the polyline will be: positions `dt_s` apart, the first is `from_W`.
std::vector<Vector3d> positions_ahead(const Vector3d& from_W, const std::vector<Waypoint>& waypoints, double dt_s,
                                      int count);

/// The other UAVs where they are now as far as one knows: who went out of sight a moment ago still stands where it
/// stood, or has flown on. Without those never seen, or too long ago.
std::vector<Peer> reckoned(const Peers& peers, Tick now);

enum class Traffic {
  clear,      ///< fly on
  wait,       ///< stop: somebody comes who has the right of way, or it is too tight
  go_around,  ///< somebody stands in the way and has done so for a while
};

class Separation {
 public:
  struct Config {
    double margin_m = 2.2;  ///< between two bodies' surfaces: nearer than this is a conflict
    double tight_m = 1.4;   ///< nearer than this, the right of way does not count
    double horizon_s = 3.0;
    double patience_s = 1.5;  ///< of waiting, before going around
  };

  Separation(const Config& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  /// Right of way is by fleet order; whoever stands still has it over whoever moves. Two that stand in each other's
  /// way, as starts are, wait no longer than once: then `tight_m` is enough to leave somebody who stands.
  /// @param ahead  own positions to come, `dt_s` apart.
  Traffic judge(Tick now, const std::vector<Vector3d>& ahead, double dt_s, const Peers& peers);
  /// Who was in the way when it was last judged.
  std::optional<std::size_t> hindered_by() const { return hindered_by_; }

  /// The UAVs near by, as places to plan around: whoever is too near to one already may leave, but not come nearer.
  std::vector<Sphere> keep_out(Tick now, const Vector3d& p_W_now, const Peers& peers) const;

  /// Whom this UAV lets lift off first: explorers that stand near it, who look what is above, then those of lower
  /// number, each a few metres up before the next. Nobody: it may lift off.
  std::optional<std::size_t> lifts_off_after(Tick now, const Peers& peers);

 private:
  double contact_m(std::size_t uav) const;
  double margin_m(Tick now) const;
  bool starts_before(std::size_t uav) const;

  const Config config_;
  const AgentConfig& agent_;
  std::optional<Tick> waiting_since_, ready_since_;
  std::optional<std::size_t> hindered_by_;
  Tick past_until_ = 0;
};

}  // namespace skein::agent
