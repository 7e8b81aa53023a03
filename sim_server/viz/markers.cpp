#include "sim_server/viz/markers.hpp"

#include <array>
#include <cmath>

#include "core/math/euler.hpp"
#include "core/scoring/camera_quality.hpp"
#include "core/vehicle/airframe.hpp"
#include "idl/conversions.hpp"

namespace skein::sim::viz {
namespace {

struct Colour {
  float r, g, b, a = 1.0F;
};

constexpr Colour kGrey{0.6F, 0.6F, 0.65F}, kBlue{0.2F, 0.5F, 1.0F}, kOrange{1.0F, 0.55F, 0.1F},
    kGreen{0.2F, 0.8F, 0.3F}, kYellow{0.9F, 0.8F, 0.2F, 0.6F}, kWhite{1.0F, 1.0F, 1.0F};
constexpr double kThinLine_m = 0.05, kLine_m = 0.1, kTextHeight_m = 1.0, kTextAbove_m = 1.0, kStationEdge_m = 0.6;

msg::ColorRGBA to_message(const Colour& colour) {
  msg::ColorRGBA message;
  message.r(colour.r);
  message.g(colour.g);
  message.b(colour.b);
  message.a(colour.a);
  return message;
}

msg::Marker make_marker(Tick tick, const std::string& space, std::size_t id, Shape shape, const Colour& colour,
                        const Vector3d& scale) {
  msg::Marker marker;
  marker.header(to_header(tick));
  marker.ns(space);
  marker.id(static_cast<std::int32_t>(id));
  marker.type(static_cast<std::int32_t>(shape));
  marker.pose(to_pose(Vector3d::Zero(), Quaterniond::Identity()));
  marker.scale().x(scale.x());
  marker.scale().y(scale.y());
  marker.scale().z(scale.z());
  marker.color(to_message(colour));
  return marker;
}

/// Turns a marker without points into the removal of that marker, because RViz complains about lines without points.
msg::Marker shown(msg::Marker marker) {
  if (marker.points().empty()) marker.action(static_cast<std::int32_t>(Action::remove));
  return marker;
}

void add_line(msg::Marker& marker, const Vector3d& from, const Vector3d& to) {
  marker.points().push_back(to_point(from));
  marker.points().push_back(to_point(to));
}

const Colour& colour_of(const UavConfig& uav, const UavView& view) {
  if (!view.alive) return kGrey;
  return uav.vehicle.role == Role::explorer ? kBlue : kOrange;
}

/// Corners of the picture, in order around it.
std::array<Vector3d, 4> picture_corners(const CameraConfig& camera, const Isometry3d& X_WC, double distance_m) {
  const double y = std::tan(0.5 * camera.hfov_deg * kRadPerDeg), z = std::tan(0.5 * camera.vfov_deg * kRadPerDeg);
  const auto corner = [&](double left, double up) -> Vector3d {
    return X_WC * (distance_m * Vector3d(1.0, left * y, up * z).normalized());
  };
  return {corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1)};
}

void add_name(msg::MarkerArray& array, Tick tick, std::size_t id, const std::string& name, const Vector3d& p_W) {
  msg::Marker text = make_marker(tick, "name", id, Shape::text, kWhite, {0.0, 0.0, kTextHeight_m});
  text.pose(to_pose(p_W + kTextAbove_m * Vector3d::UnitZ(), Quaterniond::Identity()));
  text.text(name);
  array.markers().push_back(std::move(text));
}

}  // namespace

msg::Marker structure_marker(const TriangleMesh& mesh) {
  msg::Marker marker = make_marker(0, "structure", 0, Shape::triangle_list, kGrey, Vector3d::Ones());
  marker.points().reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      marker.points().push_back(to_point(mesh.vertices[vertex].cast<double>()));
    }
  }
  return shown(std::move(marker));
}

msg::Marker box_marker(std::span<const OrientedBox> boxes) {
  msg::Marker marker = make_marker(0, "boxes", 0, Shape::line_list, kYellow, {kLine_m, 0.0, 0.0});
  for (const OrientedBox& box : boxes) {
    const auto corner = [&](int bits) -> Vector3d {
      const Vector3d sign((bits & 1) ? 0.5 : -0.5, (bits & 2) ? 0.5 : -0.5, (bits & 4) ? 0.5 : -0.5);
      return box.center + box.R_WO * box.size.cwiseProduct(sign);
    };
    for (int from = 0; from < 8; ++from) {
      for (const int axis : {1, 2, 4}) {
        if ((from & axis) == 0) add_line(marker, corner(from), corner(from | axis));
      }
    }
  }
  return shown(std::move(marker));
}

msg::Marker link_marker(Tick tick, const Scenario& scenario, std::span<const UavView> uavs, const Links& links) {
  msg::Marker marker = make_marker(tick, "links", 0, Shape::line_list, kGreen, {kThinLine_m, 0.0, 0.0});
  const auto place = [&](Node node) {
    const auto uav = uav_of_node(node);
    return uav ? uavs[*uav].state.p_WB : scenario.station_position;
  };
  for (const Node a : scenario.nodes()) {
    for (const Node b : scenario.nodes()) {
      const bool there = links.at(a, b) != 0, back = links.at(b, a) != 0;
      if (b <= a || !(there || back)) continue;
      add_line(marker, place(a), place(b));
      const Colour& colour = !(there && back) ? kOrange : a == kStationNode ? kGreen : kBlue;
      marker.colors().insert(marker.colors().end(), 2, to_message(colour));
    }
  }
  return shown(std::move(marker));
}

msg::MarkerArray frustum_markers(Tick tick, const Scenario& scenario, std::span<const UavView> uavs) {
  msg::MarkerArray array;
  for (const UavIndex i : FirstUavs(uavs.size())) {
    const UavConfig& uav = scenario.fleet[i];
    const CameraConfig& camera = uav.vehicle.camera;
    msg::Marker marker =
        make_marker(tick, "frustum", i, Shape::line_list, colour_of(uav, uavs[i]), {kThinLine_m, 0.0, 0.0});
    if (uavs[i].alive) {
      const Isometry3d X_WC = camera_state(uavs[i].state, uavs[i].gimbal, camera).X_WC;
      const auto corners = picture_corners(camera, X_WC, search_radius(camera, scenario.desired_mm_per_pixel));
      for (std::size_t c = 0; c < corners.size(); ++c) {
        add_line(marker, X_WC.translation(), corners[c]);
        add_line(marker, corners[c], corners[(c + 1) % corners.size()]);
      }
    }
    array.markers().push_back(shown(std::move(marker)));
  }
  return array;
}

msg::MarkerArray fleet_markers(Tick tick, const Scenario& scenario, std::span<const UavView> uavs) {
  msg::MarkerArray array;
  msg::Marker station =
      make_marker(tick, "body", kStationNode, Shape::cube, kGreen, Vector3d::Constant(kStationEdge_m));
  station.pose(to_pose(scenario.station_position, Quaterniond::Identity()));
  array.markers().push_back(std::move(station));
  add_name(array, tick, kStationNode, scenario.node_name(kStationNode), scenario.station_position);
  for (const UavIndex i : FirstUavs(uavs.size())) {
    const UavConfig& uav = scenario.fleet[i];
    const double width = 2.0 * body_radius(uav.vehicle);
    msg::Marker body = make_marker(tick, "body", node_of_uav(i), Shape::cylinder, colour_of(uav, uavs[i]),
                                   {width, width, uav.vehicle.collision_box_m.z()});
    body.pose(to_pose(uavs[i].state.p_WB, uavs[i].state.q_WB));
    array.markers().push_back(std::move(body));
    add_name(array, tick, node_of_uav(i), uav.name, uavs[i].state.p_WB);
  }
  return array;
}

msg::MarkerArray path_markers(Tick tick, const Scenario& scenario, const Trails& trails) {
  msg::MarkerArray array;
  for (const UavIndex i : scenario.uavs()) {
    const Colour& colour = scenario.fleet[i].vehicle.role == Role::explorer ? kBlue : kOrange;
    msg::Marker marker = make_marker(tick, "path", i, Shape::line_strip, colour, {kThinLine_m, 0.0, 0.0});
    for (const Vector3d& p_WB : trails.of(i)) marker.points().push_back(to_point(p_WB));
    array.markers().push_back(shown(std::move(marker)));
  }
  return array;
}

}  // namespace skein::sim::viz
