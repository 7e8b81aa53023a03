// Sends the station the additional data that single viewers of a watched run ask for: LiDAR points of some UAVs, and
// maps. The points come from the simulation. The maps come from the UAVs' own domains, which the server has joined and
// the station has not. The server sends the newest points and maps, at a bounded rate (view::look_budget()).
//
// No agent receives this, and the lock-step does not count it. Wall time decides what is shown and when, and nothing
// else: a scan that is computed for the page alone has no other effect (Simulation::want_scans()).
// Frame: W.   Threads: one; the readers of maps store what arrives from threads of the bus.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "bus/bus.hpp"
#include "process/json_text.hpp"
#include "sim_server/simulation.hpp"
#include "view/look_order.hpp"
#include "view/scan_points.hpp"

namespace skein::sim {

class LookNode {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param world, uavs  the server's participants in the world domain and, by UAV, in the UAVs' domains. They and the
  /// references must outlive this.
  LookNode(const Scenario& scenario, const Simulation& simulation, bus::Participant& world,
           std::span<const std::unique_ptr<bus::Participant>> uavs);

  /// For the page: the UAVs that have a "lidar", and those whose "maps" it may ask for.
  Json offer() const;
  /// Grants a page's requests for view::kLookLease from now on. Unknown UAVs are ignored.
  void obey(const view::LookOrder& order, Clock::time_point now);
  /// Whether the next scan of this UAV is to be shown.
  bool wants_scan(UavIndex uav, Clock::time_point now) const;
  /// Call it in each step: keeps the step's scans that a page asks for.
  void begin_step();
  /// Sends the points and maps that are due. May be called at any time.
  void tell(Clock::time_point now);

 private:
  struct Lidar {
    Clock::time_point until{};
    view::ScanPoints points{};
    Tick tick = 0;  ///< of the newest scan
  };
  /// Newest map of a UAV, handed over by a thread of the bus.
  struct Arrived {
    std::mutex mutex;
    std::optional<std::vector<std::uint8_t>> payload;  ///< none: nothing new since the last one was taken
  };
  struct Map {
    Clock::time_point until{}, since{}, due{};  ///< end and begin of the page's request; when the next map may be sent
    bool told = false;                          ///< since `since`, a map or the message that there is none was sent
    std::shared_ptr<Arrived> arrived;
    std::unique_ptr<bus::Reader> reader;
  };

  void look_at_map(UavIndex uav, Clock::time_point now);
  void tell_points(Clock::time_point now);
  void tell_map(UavIndex uav, Map& map, Clock::time_point now);
  std::string shown(UavIndex uav, std::span<const std::uint8_t> payload) const;
  std::size_t write(const std::string& text);

  const Scenario& scenario_;
  const Simulation& simulation_;
  const std::span<const std::unique_ptr<bus::Participant>> uavs_;
  const view::LookBudget budget_;
  std::unique_ptr<bus::Writer> clouds_;
  std::map<UavIndex, Lidar> lidars_;
  std::map<UavIndex, Map> maps_;
  Clock::time_point points_due_{};
};

}  // namespace skein::sim
