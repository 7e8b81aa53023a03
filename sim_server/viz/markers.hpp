// What RViz 2 shows of a run, as marker messages: the structure and its boxes, UAVs with their cameras and paths, and
// who hears whom. All in the frame "world"; SI. Colours are in [0, 1]. Pure.
#pragma once

#include <span>

#include "core/radio/link_matrix.hpp"
#include "core/scenario.hpp"
#include "core/scene.hpp"
#include "idl/type_names.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/viz/trails.hpp"

namespace skein::sim::viz {

/// Numbers of visualization_msgs/msg/Marker.
enum class Shape : std::int32_t {
  cube = 1,
  cylinder = 3,
  line_strip = 4,
  line_list = 5,
  text = 9,
  triangle_list = 11,
};
enum class Action : std::int32_t { add = 0, remove = 2 };

/// All triangles; RViz lights them itself.
msg::Marker structure_marker(const TriangleMesh& mesh);
/// The twelve edges of each box.
msg::Marker box_marker(std::span<const OrientedBox> boxes);
/// A line for each pair of nodes that are linked, in whichever direction: green with the station, blue between UAVs,
/// orange where only one of the two is heard.
msg::Marker link_marker(Tick tick, const Scenario& scenario, std::span<const UavView> uavs, const Links& links);
/// From each camera to the corners of its picture, and around them: as far as the camera looks, which is the search
/// radius (of the contest's rules, also where a scenario has no such limit). UAVs that are out have none.
msg::MarkerArray frustum_markers(Tick tick, const Scenario& scenario, std::span<const UavView> uavs);
/// A body and a name for each UAV and the station: explorers blue, photographers orange, grey who is out.
msg::MarkerArray fleet_markers(Tick tick, const Scenario& scenario, std::span<const UavView> uavs);
/// Where each UAV has been.
msg::MarkerArray path_markers(Tick tick, const Scenario& scenario, const Trails& trails);

}  // namespace skein::sim::viz
