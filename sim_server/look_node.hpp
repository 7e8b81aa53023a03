// What somebody looks at on the page of a watched run, beside what everybody is told: LiDAR points of some UAVs, and
// maps. Points come from the simulation, maps from the UAVs' own domains, which the server has joined: the station
// joins none of these. Both go to the station as the newest that there is, at a bounded rate (view::look_budget()).
//
// Nobody in the fleet hears of it, and it is in no count. Wall time decides what is shown and when, and nothing else: a
// scan that is computed for the page alone changes nothing (Simulation::want_scans()).
// Threads: one, but for what the bus calls.
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

  /// @param world, uavs  of the server, by UAV; they and the references must outlive this.
  LookNode(const Scenario& scenario, const Simulation& simulation, bus::Participant& world,
           std::span<const std::unique_ptr<bus::Participant>> uavs);

  /// For the page: whose "lidar" and whose "maps" there are to look at.
  Json offer() const;
  /// UAVs that nobody has heard of are passed over.
  void obey(const view::LookOrder& order, Clock::time_point now);
  /// Whether the next scan of this UAV is to be shown.
  bool wants_scan(UavIndex uav, Clock::time_point now) const;
  /// In each step: takes its scans.
  void begin_step();
  /// As often as one likes: tells what is due.
  void tell(Clock::time_point now);

 private:
  struct Lidar {
    Clock::time_point until{};
    view::ScanPoints points{};
    Tick tick = 0;  ///< of the newest
  };
  /// Newest map of a UAV, handed over by a thread of the bus.
  struct Arrived {
    std::mutex mutex;
    std::optional<std::vector<std::uint8_t>> payload;  ///< none: nothing new
  };
  struct Map {
    Clock::time_point until{}, since{}, due{};
    bool told = false;
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
