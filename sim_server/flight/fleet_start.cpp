#include "sim_server/flight/fleet_start.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"
#include "core/vehicle/airframe.hpp"

namespace skein::sim {
namespace {

constexpr double kMaxOffset = 0.2;
constexpr double kMaxDelayS = 1.0;
constexpr int kAttempts = 100;  ///< after so many draws the UAV keeps the scenario's start

Isometry3d start_pose(const UavConfig& uav, const Vector2d& offset) {
  const Vector3d p_WB(uav.start.x() + offset.x(), uav.start.y() + offset.y(), rest_height(uav.vehicle));
  return Eigen::Translation3d(p_WB) * Quaterniond(Eigen::AngleAxisd(uav.start_yaw, Vector3d::UnitZ()));
}

Vector2d draw_in_disc(RandomStream& stream, double radius) {
  Vector2d offset;
  do {
    offset.x() = stream.uniform(-radius, radius);
    offset.y() = stream.uniform(-radius, radius);
  } while (offset.norm() > radius);
  return offset;
}

/// Whether a start is clear of the other UAVs: of the drawn starts of UAVs before it, and of the scenario's starts of
/// those after it.
bool clear_of_others(const Scenario& scenario, const std::vector<UavStart>& drawn, const Isometry3d& X_WB) {
  const UavIndex self(drawn.size());
  for (const UavIndex i : scenario.uavs()) {
    if (i == self) continue;
    const Vector2d other = i < self ? Vector2d(drawn[i].X_WB.translation().head<2>()) : scenario.fleet[i].start;
    const double needed = least_start_distance(scenario.fleet[i].vehicle, scenario.fleet[self].vehicle);
    if ((other - X_WB.translation().head<2>()).norm() < needed) return false;
  }
  return true;
}

Isometry3d draw_pose(const Scenario& scenario, const std::vector<UavStart>& drawn, std::uint64_t seed,
                     const TouchesStructure& touches) {
  const UavConfig& uav = scenario.fleet[drawn.size()];
  RandomStream stream(seed, "start_offset", drawn.size());
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Isometry3d X_WB = start_pose(uav, draw_in_disc(stream, kMaxOffset));
    if (clear_of_others(scenario, drawn, X_WB) && !touches(uav.vehicle, X_WB)) return X_WB;
  }
  return start_pose(uav, Vector2d::Zero());
}

[[noreturn]] void refuse_start(const Scenario& scenario, const UavConfig& uav, const std::string& why) {
  throw InputError(fmt::format("{}: the start of {} at ({:g}, {:g}) {}; choose one that is clear of it",
                               scenario.file.string(), uav.name, uav.start.x(), uav.start.y(), why));
}

}  // namespace

void check_station(const Scenario& scenario, const IsEnclosed& enclosed) {
  constexpr double kAboveGround = 0.01;  // a ray that starts in the ground plane does not hit the ground
  const Vector3d& p_W = scenario.station_position;
  if (!enclosed({p_W.x(), p_W.y(), std::max(p_W.z(), kAboveGround)})) return;
  throw InputError(fmt::format(
      "{}: station.position: ({:g}, {:g}, {:g}) lies in the structure or is enclosed by it: no line of sight "
      "leads out of it; choose a place outside",
      scenario.file.string(), p_W.x(), p_W.y(), p_W.z()));
}

std::vector<UavStart> draw_fleet_start(const Scenario& scenario, std::uint64_t seed, const TouchesStructure& touches,
                                       const IsEnclosed& enclosed) {
  std::vector<UavStart> starts;
  for (const UavConfig& uav : scenario.fleet) {
    UavStart start{.X_WB = start_pose(uav, Vector2d::Zero())};
    if (touches(uav.vehicle, start.X_WB)) refuse_start(scenario, uav, "lies in the structure");
    if (enclosed(start.X_WB.translation())) {
      refuse_start(scenario, uav, "is enclosed by the structure: no line of sight leads out of it");
    }
    if (seed != 0) {
      const std::size_t i = starts.size();
      start.X_WB = draw_pose(scenario, starts, seed, touches);
      start.motor_delay = ticks(RandomStream(seed, "start_delay", i).uniform(0.0, kMaxDelayS));
      start.late_commands = RandomStream(seed, "command_latency", i).uniform() < 0.5;
    }
    starts.push_back(start);
  }
  return starts;
}

}  // namespace skein::sim
