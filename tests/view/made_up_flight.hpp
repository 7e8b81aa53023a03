// A flight that nobody flew, told as sim_server and station tell one: four towers full of interest points, around which
// UAVs climb in circles and photograph what is before them, radio links that towers block, deliveries to the station.
// As much is told of each UAV and second as of the fleets that Skein flies (about six captures with five points each at
// first, and fewer when most has been seen well). The same numbers give the same lines.
// Frame W (ENU), SI units.   Pure.
#pragma once

#include <deque>
#include <vector>

#include "core/types.hpp"
#include "view/feed.hpp"
#include "view/story.hpp"

namespace skein::test {

struct MadeUpSize {
  std::size_t uavs = 20, points = 10000;  ///< points: of each tower a quarter
};

class MadeUpFlight {
 public:
  /// Tells the scene and the first moment. @param feed  must outlive this.
  MadeUpFlight(MadeUpSize size, view::Feed& feed);

  double time_s() const { return static_cast<double>(step_) * kStep_s; }
  /// Flies one exchange.
  void step();

 private:
  static constexpr double kStep_s = 0.05;

  struct Capture {
    std::uint64_t number = 0;
    std::vector<CapturePoint> points;
  };
  struct Uav {
    view::ShownUav shown;
    double angle = 0.0, from_tower = 0.0;  ///< of it around its tower [rad]; [m]
    std::size_t tower = 0;
    bool works = false;
    std::uint64_t captures = 0;
    std::deque<Capture> waiting;
    std::vector<float> best;  ///< by point
  };

  Vector3d place_of(std::size_t uav, double time_s, std::size_t& tower, double& angle) const;
  void move();
  void photograph(std::size_t uav);
  void tell_links();
  void deliver(std::size_t uav);
  void tell_state();
  void tell_activities();
  void tell_clouds();

  const MadeUpSize size_;
  view::Feed& feed_;
  std::vector<Vector3d> points_;
  std::vector<Uav> fleet_;
  std::vector<view::ShownLink> links_;
  std::vector<float> delivered_;                 ///< by point
  std::vector<view::ShownDelivery> deliveries_;  ///< of this exchange
  double score_ = 0.0;
  std::size_t scored_ = 0;
  std::uint64_t step_ = 0;
};

}  // namespace skein::test
