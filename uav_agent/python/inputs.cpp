#include "uav_agent/python/inputs.hpp"

#include <pybind11/eval.h>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string_view>

#include "core/math/euler.hpp"
#include "uav_agent/python/interpreter.hpp"
#include "uav_agent/python/maps.hpp"
#include "uav_agent/python/values.hpp"

namespace skein::agent::python {
namespace {

template <class T>
py::object or_none(const std::optional<T>& value) {
  return value ? py::object(py::cast(*value)) : py::object(py::none());
}

py::object array_or_none(const std::optional<Vector3d>& vector) { return vector ? to_array(*vector) : py::none(); }

py::object node_or_none(const std::optional<Node>& node) {
  return node ? py::object(py::int_(static_cast<std::size_t>(*node))) : py::object(py::none());
}

template <class Items, class Make>
py::tuple tuple_of(const Items& items, const Make& make) {
  py::tuple tuple(items.size());
  std::size_t i = 0;
  for (const auto& item : items) {
    tuple[i] = make(item, i);
    ++i;
  }
  return tuple;
}

py::object state_of(const RigidBodyState& state) {
  py::array_t<double> q_WB(4);  // geometry
  const Quaterniond& q = state.q_WB;
  double* const out = q_WB.mutable_data();
  out[0] = q.w(), out[1] = q.x(), out[2] = q.y(), out[3] = q.z();
  return words().state(to_array(state.p_WB), q_WB, to_array(state.v_WB), to_array(state.w_WB_B));
}

py::object setpoint_of(const Setpoint& setpoint) {
  return words().setpoint(to_array(setpoint.p_WB), setpoint.yaw, to_array(setpoint.v_WB), to_array(setpoint.a_WB));
}

py::object tracking_of(const TrackingState& tracking) {
  return words().tracking_state(setpoint_of(tracking.setpoint), tracking.leg, tracking.done, tracking.airborne);
}

py::object box_of(const OrientedBox& box, std::size_t) {
  return words().oriented_box(to_text(box.name), to_array(box.center), to_array(box.size), to_array(box.R_WO));
}

py::object flight_of(const FlightState& flight) {
  static constexpr const char* kKinds[] = {"reached", "no_way", "blocked"};
  const auto outcome = [](const Outcome& one, std::size_t) {
    return words().outcome(one.id, kKinds[static_cast<std::size_t>(one.kind)], one.leg, to_text(one.reason));
  };
  return words().flight_state(flight.working, flight.idle, or_none(flight.goal), flight.on_way, flight.leg,
                              tuple_of(flight.outcomes, outcome));
}

/// The object of which Python reads the fields of a PlannerInput.
struct Source {
  std::shared_ptr<Call> call;
};

py::array points_of(Call& call, const std::string& name, const std::vector<Eigen::Vector3f>& points_W) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  constexpr auto kFloat = static_cast<py::ssize_t>(sizeof(float));
  return call.view(name + ".points_W", py::dtype::of<float>(), {static_cast<py::ssize_t>(points_W.size()), 3},
                   {3 * kFloat, kFloat}, points_W.data());
}

std::string numbered(const char* name, std::size_t i) {
  return std::string("inputs.") + name + "[" + std::to_string(i) + "]";
}

py::dtype record(const char* text, py::ssize_t size) {
  const py::dict fields = py::eval(text).cast<py::dict>();
  fields["itemsize"] = size;
  return py::dtype::from_args(fields);
}

py::object detected_of(Call& call, const PlannerInput& in) {
  // The format below.
  static_assert(offsetof(DetectedPoint, p_W) == 0 && offsetof(DetectedPoint, score) == 16 &&
                offsetof(DetectedPoint, order) == 24 && offsetof(DetectedPoint, n_W) == 28);
  static const py::dtype& kType =
      *new py::dtype(record("{'names': ['p_W', 'score', 'order', 'n_W'], 'formats': [('<f4', 3), '<f8', '<u4', "
                            "('<f4', 3)], 'offsets': [0, 16, 24, 28]}",
                            sizeof(DetectedPoint)));
  return call.view("inputs.detected", kType, {static_cast<py::ssize_t>(in.detected.size())}, {sizeof(DetectedPoint)},
                   in.detected.data());
}

py::object beam_scan_of(Call& call, const BeamScan& scan, std::size_t i) {
  using Beam = BeamScan::Beam;
  // The format below.
  static_assert(offsetof(Beam, state) == 0 && offsetof(Beam, range_m) == 4);
  static const py::dtype& kType = *new py::dtype(
      record("{'names': ['state', 'range_m'], 'formats': ['u1', '<f4'], 'offsets': [0, 4]}", sizeof(Beam)));
  static constexpr const char* kDoubts[] = {"none", "no_servo", "no_pose", "misfit"};
  const auto columns = static_cast<py::ssize_t>(scan.columns), beams = static_cast<py::ssize_t>(scan.beams.size());
  const py::ssize_t rings = columns > 0 ? beams / columns : 0;
  const py::array view = call.view(numbered("beam_scans", i) + ".beams", kType, {rings, columns},
                                   {columns * static_cast<py::ssize_t>(sizeof(Beam)), sizeof(Beam)}, scan.beams.data());
  const auto firing = [](const BeamScan::Firing& one, std::size_t) {
    constexpr py::ssize_t kEdge = 4;  // geometry: of the matrix of a pose
    py::array_t<double> X_WL({kEdge, kEdge});
    for (py::ssize_t row = 0; row < kEdge; ++row) {
      for (py::ssize_t column = 0; column < kEdge; ++column)
        X_WL.mutable_at(row, column) = one.X_WL.matrix()(row, column);
    }
    return words().firing(one.first_column, one.tick, X_WL, one.error_m, one.error_rad);
  };
  return words().beam_scan(scan.tick, kDoubts[static_cast<std::size_t>(scan.doubt)], view, tuple_of(scan.fired, firing),
                           scan.points);
}

py::object link_or_none(const std::optional<LinkQuality>& link) {
  return link ? words().link_quality(link->received_dbm, link->rate_bit_s) : py::object(py::none());
}

py::object peers_of(const Call& call, const PlannerInput& in) {
  return tuple_of(in.peers.all(), [&](const Peer& peer, std::size_t) {
    return words().peer(static_cast<std::size_t>(peer.uav), call.order().agent.fleet.at(peer.uav).name,
                        to_array(peer.p_W), to_array(peer.v_W), to_array(peer.a_W), or_none(peer.seen), peer.visible,
                        peer.left_start, to_array(peer.deviation_m), link_or_none(peer.link));
  });
}

py::object radio_of(const PlannerInput& in) {
  return tuple_of(in.radio, [](const RadioMessage& message, std::size_t) {
    return words().radio_message(message.topic, to_text(message.text), node_or_none(message.source));
  });
}

using Make = std::function<py::object(const std::shared_ptr<Call>&, const PlannerInput&)>;
using CallPtr = std::shared_ptr<Call>;

/// How each field is made, by its name in skein.planner.PlannerInput.
const std::map<std::string_view, Make>& fields() {
  using In = PlannerInput;
  static const std::map<std::string_view, Make> kFields = {
      {"k", [](const CallPtr&, const In& in) { return py::int_(in.k); }},
      {"tick", [](const CallPtr&, const In& in) { return py::int_(in.tick); }},
      {"state", [](const CallPtr&, const In& in) { return state_of(in.state); }},
      {"gimbal",
       [](const CallPtr&, const In& in) {
         const GimbalState& gimbal = in.gimbal;
         return words().gimbal_state(gimbal.pitch, gimbal.yaw, gimbal.pitch_rate, gimbal.yaw_rate);
       }},
      {"tracking", [](const CallPtr&, const In& in) { return tracking_of(in.tracking); }},
      {"map", [](const CallPtr& call, const In&) { return occupancy_map_of(call); }},
      {"boxes", [](const CallPtr&, const In& in) { return tuple_of(in.boxes, box_of); }},
      {"peers", [](const CallPtr& call, const In& in) { return peers_of(*call, in); }},
      {"mission_remaining_s", [](const CallPtr&, const In& in) { return or_none(in.mission_remaining_s); }},
      {"station_linked", [](const CallPtr&, const In& in) { return py::bool_(in.station_linked); }},
      {"undelivered_captures", [](const CallPtr&, const In& in) { return py::int_(in.undelivered_captures); }},
      {"detected", [](const CallPtr& call, const In& in) { return detected_of(*call, in); }},
      {"radio", [](const CallPtr&, const In& in) { return radio_of(in); }},
      {"key_frames",
       [](const CallPtr& call, const In& in) {
         return tuple_of(in.key_frames, [&](const KeyFrame& frame, std::size_t i) {
           return words().key_frame(points_of(*call, numbered("key_frames", i), frame.points_W),
                                    array_or_none(frame.p_WS), node_or_none(frame.source));
         });
       }},
      {"scans",
       [](const CallPtr& call, const In& in) {
         return tuple_of(in.scans, [&](const Scan& scan, std::size_t i) {
           return words().scan(scan.tick, points_of(*call, numbered("scans", i), scan.points_W));
         });
       }},
      {"beam_scans",
       [](const CallPtr& call, const In& in) {
         return tuple_of(in.beam_scans,
                         [&](const BeamScan& scan, std::size_t i) { return beam_scan_of(*call, scan, i); });
       }},
      {"world_map", [](const CallPtr& call, const In&) { return world_map_of(call); }},
      {"scanned", [](const CallPtr&, const In& in) { return py::bool_(in.scanned); }},
      {"flight", [](const CallPtr&, const In& in) { return flight_of(in.flight); }},
      {"space", [](const CallPtr& call, const In&) { return free_space_of(call); }},
      {"position_sigma_m", [](const CallPtr&, const In& in) { return to_array(in.uncertainty.position_m); }},
      {"yaw_sigma", [](const CallPtr&, const In& in) { return py::float_(in.uncertainty.yaw); }},
      {"battery_charge",
       [](const CallPtr&, const In& in) {
         return in.battery ? py::object(py::float_(in.battery->charge)) : py::object(py::none());
       }},
      {"wind_W", [](const CallPtr&, const In& in) { return array_or_none(in.wind_W); }},
      {"station_link", [](const CallPtr&, const In& in) { return link_or_none(in.station_link); }},
  };
  return kFields;
}

py::object read(const Source& source, const std::string& name) {
  const PlannerInput& in = source.call->in("inputs." + name);
  const auto found = fields().find(name);
  if (found == fields().end()) throw py::attribute_error(name);
  return found->second(source.call, in);
}

}  // namespace

void register_inputs(py::module_& module) { py::class_<Source>(module, "Source").def("read", &read); }

py::object inputs_of(const std::shared_ptr<Call>& call) {
  static const py::tuple& kNothing = *new py::tuple();
  auto* const type = reinterpret_cast<PyTypeObject*>(words().planner_input.ptr());
  auto inputs = py::reinterpret_steal<py::object>(type->tp_new(type, kNothing.ptr(), nullptr));
  if (!inputs) throw py::error_already_set();
  inputs.attr("_source") = py::cast(Source{call});
  return inputs;
}

py::object to_python(const AgentConfig& agent) {
  const auto member = [](const FleetMember& one, std::size_t) {
    return words().fleet_member(to_text(one.name), name_of(one.role), to_array(one.p_WB_start), one.body_radius_m,
                                one.max_speed_mps);
  };
  const VehicleConfig& vehicle = agent.vehicle;
  const CameraConfig& camera = vehicle.camera;
  const GimbalConfig& gimbal = vehicle.gimbal;
  py::object lidar_range_m = py::none();
  if (vehicle.lidar) lidar_range_m = py::make_tuple(vehicle.lidar->range_min_m, vehicle.lidar->range_max_m);
  const py::object python_camera =
      words().camera(camera.hfov_deg * kRadPerDeg, camera.vfov_deg * kRadPerDeg, camera.exposure_s,
                     camera.trigger_interval_s, camera.focal_length_m, camera.pixel_size_m, to_array(camera.p_BC));
  const py::object python_vehicle = words().vehicle(
      to_text(vehicle.name), vehicle.max_speed_mps, vehicle.max_acceleration_mps2,
      vehicle.max_yaw_rate_deg_s * kRadPerDeg, lidar_range_m, python_camera, gimbal.pitch_limit_deg * kRadPerDeg,
      gimbal.yaw_limit_deg * kRadPerDeg, gimbal.rate_limit_deg_s * kRadPerDeg);
  return words().agent_config(static_cast<std::size_t>(agent.self), to_text(agent.me().name),
                              tuple_of(agent.fleet, member), python_vehicle, agent.desired_mm_per_pixel,
                              agent.duration_s, agent.exchange_period_s, to_array(agent.station_position));
}

}  // namespace skein::agent::python
