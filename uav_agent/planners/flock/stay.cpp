#include "uav_agent/planners/flock/stay.hpp"

#include "uav_agent/planning/aiming.hpp"

namespace skein::agent {
namespace {

constexpr double kReachedM = 0.6;   ///< a view is taken from within this distance (chosen) ...
constexpr double kAimed = 0.12;     ///< ... with the camera this near to its direction [rad]; chosen
constexpr double kPictureS = 0.15;  ///< the camera takes a picture in this time; chosen: above trigger_interval_s
constexpr double kPatienceS = 2.5;  ///< longest stay at a view, for the camera to turn; chosen

}  // namespace

bool FlockStay::done(const FlockView& view, const PlannerInput& in, const VehicleConfig& vehicle) {
  if ((in.state.p_WB - view.p_WB).norm() > kReachedM) {
    end();
    return false;
  }
  if (!there_since_) there_since_ = in.tick;
  const bool aimed = aim_error(view.aim_W, in.state, in.gimbal, vehicle) < kAimed;
  if (!aimed) aimed_since_.reset();
  if (aimed && !aimed_since_) aimed_since_ = in.tick;
  return (aimed && seconds(in.tick - *aimed_since_) >= kPictureS) || seconds(in.tick - *there_since_) > kPatienceS;
}

void FlockStay::end() {
  there_since_.reset();
  aimed_since_.reset();
}

}  // namespace skein::agent
