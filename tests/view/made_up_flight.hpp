// A made-up flight, fed to the page as sim_server and station feed a real one: four towers full of interest points,
// UAVs that climb around them in circles and photograph the points before them, radio links that towers block,
// deliveries to the station. The amount of data per UAV and second is that of real fleets (at first about six captures
// with five points each; fewer once most points have been seen well). The same sizes give the same lines.
// Frame W (ENU), SI units.   Pure.
#pragma once

#include <deque>
#include <vector>

#include "core/types.hpp"
#include "view/feed.hpp"
#include "view/story.hpp"

namespace skein::test {

struct MadeUpSize {
  std::size_t uavs = 20, points = 10000;  ///< each tower has a quarter of the points
};

class MadeUpFlight {
 public:
  /// Feeds the scene and the first moment. @param feed  must outlive this.
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
    double angle = 0.0;  ///< about its tower's axis [rad]
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
