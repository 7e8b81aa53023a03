// Marker messages with which RViz 2 shows a run: the structure and its boxes, UAVs with their cameras and paths, and
// radio links. All in the frame "world"; SI. Colours are in [0, 1]. Pure.
#pragma once

#include <span>

#include "core/radio/link_matrix.hpp"
#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"
#include "idl/type_names.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/viz/trails.hpp"

namespace skein::sim::viz {

/// Values of the field `type` of visualization_msgs/msg/Marker.
enum class Shape : std::int32_t {
  cube = 1,
  cylinder = 3,
  line_strip = 4,
  line_list = 5,
  text = 9,
  triangle_list = 11,
};
/// Values of its field `action`.
enum class Action : std::int32_t { add = 0, remove = 2 };

/// All triangles of the structure, without normals: RViz computes the lighting.
msg::Marker structure_marker(const TriangleMesh& mesh);
/// The twelve edges of each box.
msg::Marker box_marker(std::span<const OrientedBox> boxes);
/// A line for each pair of nodes with a link in at least one direction: orange if it is one direction only, else green
/// for links with the station and blue for links between UAVs.
msg::Marker link_marker(Tick tick, const Scenario& scenario, std::span<const UavView> uavs, const Links& links);
/// The edges of each camera's field of view: from the camera to the corners of its picture, and between them. Their
/// length is the search radius of the contest's rules, also if the scenario has no such limit. Dead UAVs have none.
msg::MarkerArray frustum_markers(Tick tick, const Scenario& scenario, std::span<const UavView> uavs);
/// A body and a name for the station and each UAV: explorers blue, photographers orange, dead UAVs grey.
msg::MarkerArray fleet_markers(Tick tick, const Scenario& scenario, std::span<const UavView> uavs);
/// The recent path of each UAV.
msg::MarkerArray path_markers(Tick tick, const Scenario& scenario, const Trails& trails);

}  // namespace skein::sim::viz
