#include "uav_agent/client/scenario_dicts.hpp"

#include <algorithm>

#include "core/math/euler.hpp"
#include "core/radio/radio_routes.hpp"
#include "uav_agent/api/agent_config.hpp"

namespace py = pybind11;

namespace skein::agent {
namespace {

py::dict to_python(const VehicleConfig& vehicle) {
  using namespace py::literals;
  const CameraConfig& camera = vehicle.camera;
  const GimbalConfig& gimbal = vehicle.gimbal;
  py::object lidar = py::none();
  if (vehicle.lidar) lidar = py::make_tuple(vehicle.lidar->range_min_m, vehicle.lidar->range_max_m);
  const py::dict of_camera("hfov"_a = camera.hfov_deg * kRadPerDeg, "vfov"_a = camera.vfov_deg * kRadPerDeg,
                           "exposure_s"_a = camera.exposure_s, "trigger_interval_s"_a = camera.trigger_interval_s,
                           "focal_length_m"_a = camera.focal_length_m, "pixel_size_m"_a = camera.pixel_size_m,
                           "p_BC"_a = py::make_tuple(camera.p_BC.x(), camera.p_BC.y(), camera.p_BC.z()));
  return py::dict("name"_a = vehicle.name, "max_speed_mps"_a = vehicle.max_speed_mps,
                  "max_acceleration_mps2"_a = vehicle.max_acceleration_mps2,
                  "max_yaw_rate"_a = vehicle.max_yaw_rate_deg_s * kRadPerDeg, "lidar_range_m"_a = lidar,
                  "camera"_a = of_camera, "gimbal_pitch_limit"_a = gimbal.pitch_limit_deg * kRadPerDeg,
                  "gimbal_yaw_limit"_a = gimbal.yaw_limit_deg * kRadPerDeg,
                  "gimbal_rate_limit"_a = gimbal.rate_limit_deg_s * kRadPerDeg);
}

}  // namespace

py::dict to_python(const Scenario& scenario, Node node) {
  using namespace py::literals;
  const bool is_uav = node != kStationNode;
  const AgentConfig config = agent_config(scenario, uav_of_node(node).value_or(UavIndex{0}));
  py::list fleet;
  for (const FleetMember& one : config.fleet) {
    const Vector3d& p = one.p_WB_start;
    fleet.append(py::dict("name"_a = one.name, "role"_a = name_of(one.role),
                          "p_WB_start"_a = py::make_tuple(p.x(), p.y(), p.z()), "body_radius_m"_a = one.body_radius_m,
                          "max_speed_mps"_a = one.max_speed_mps));
  }
  const Vector3d& station = config.station_position;
  py::object index = py::none(), vehicle = py::none();
  if (is_uav) {
    index = py::int_(static_cast<std::size_t>(config.self));
    vehicle = to_python(config.vehicle);
  }
  return py::dict("index"_a = index, "name"_a = scenario.node_name(node), "fleet"_a = fleet, "vehicle"_a = vehicle,
                  "desired_mm_per_pixel"_a = config.desired_mm_per_pixel, "duration_s"_a = config.duration_s,
                  "exchange_period_s"_a = config.exchange_period_s,
                  "station_position"_a = py::make_tuple(station.x(), station.y(), station.z()));
}

py::list radio_of(const Scenario& scenario, Node node) {
  py::list list;
  for (const RadioRoute& route : radio_routes(scenario)) {
    if (route.ros_type == kCapturesType || route.ros_type == kCapturesAckType) continue;
    const bool sends = route.source == node;
    const bool hears = std::ranges::any_of(route.targets, [&](const RadioTarget& one) { return one.node == node; });
    if (sends || hears) list.append(py::make_tuple(route.ros_topic, route.ros_type, sends));
  }
  return list;
}

}  // namespace skein::agent
