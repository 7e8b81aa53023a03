// Draws the knowledge of two maps in a plane side by side, one row per time.
// Units: metres.   Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "bench/sensing/slice.hpp"

namespace skein::bench {

struct PictureRow {
  std::string label;            ///< "after 4 s, 5.2 m above the ground"
  Squares today, world;         ///< knowledge of OccupancyMap, and of WorldMap
  std::vector<Line> cut;        ///< intersection of the structure with the plane, in plane coordinates
  std::vector<Vector2d> route;  ///< route so far, in plane coordinates; ends at the UAV
};

struct Picture {
  std::string title;
  double width_m = 1.0, height_m = 1.0;  ///< size of the plane
  std::vector<PictureRow> rows;
};

/// The content of an SVG file with a white background, 800 units wide.
std::string picture_svg(const Picture& picture);

}  // namespace skein::bench
