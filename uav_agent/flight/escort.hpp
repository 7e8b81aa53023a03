// Fetching those who cannot see: a photographer that stands on the ground far from all explorers does not know what is
// above it, and goes nowhere until a LiDAR has been there. The explorer whose start is nearest flies by, in case it has
// not seen it rise by then.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/pilot.hpp"

namespace skein::agent {

class Escort {
 public:
  static constexpr double kBesideM = 15.0;  ///< who starts as near as this to an explorer shares its sky

  /// @param agent  must outlive this.
  explicit Escort(const AgentConfig& agent) : agent_(agent) {}

  /// Once per exchange in the air: takes note of who has risen.
  void update(const PlannerInput& in);
  /// Sets out to somebody who has not, if it is time. @returns whether it does.
  bool begin(const PlannerInput& in, const FreeSpace::Config& space, Pilot& pilot, PlannerOutput& out);
  /// Once per exchange of the trip. @returns true when it is over.
  bool step(const PlannerInput& in);
  /// Whom it is there for: it waits for that one to rise.
  std::optional<std::size_t> stands_by() const { return there_since_ ? fetched_ : std::nullopt; }
  /// The way there came to nothing.
  void give_up(const PlannerInput& in);

 private:
  struct Charge {
    std::size_t uav = 0;
    int attempts = 0;
    std::vector<Vector3d> tried_W = {};
  };

  void take_charge();
  Charge& next_charge(const Vector3d& here_W);
  const Vector3d& start_W(const Charge& charge) const { return agent_.fleet[charge.uav].p_WB_start; }
  bool sets_out(Charge& charge, const PlannerInput& in, const FreeSpace::Config& space, Pilot& pilot,
                PlannerOutput& out);
  bool fly_nearer(const Charge& charge, const PlannerInput& in, FreeSpace::Config space, Pilot& pilot,
                  PlannerOutput& out) const;

  const AgentConfig& agent_;
  std::vector<Charge> charges_;         ///< on the ground, as far as is known
  std::optional<std::size_t> fetched_;  ///< whom it is on the way to
  bool stops_short_ = false;            ///< for now: the place beside that one is not known to be free
  bool goes_on_ = false;                ///< from where it is, to the same one
  std::optional<Tick> in_air_since_, there_since_;
  Tick next_try_ = 0;
  Tick set_out_ = 0, spent_ = 0;  ///< on all trips
};

}  // namespace skein::agent
