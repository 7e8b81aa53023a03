// What two maps know of a plane, drawn side by side, a row for each time.
// Units: metres.   Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "bench/sensing/slice.hpp"

namespace skein::bench {

struct PictureRow {
  std::string label;            ///< "after 4 s, 5.2 m above the ground"
  Squares today, world;         ///< of OccupancyMap and of WorldMap
  std::vector<Line> cut;        ///< of what stands there, in the plane
  std::vector<Vector2d> route;  ///< so far, in the plane; the UAV is at its end
};

struct Picture {
  std::string title;
  double width_m = 1.0, height_m = 1.0;  ///< of the plane
  std::vector<PictureRow> rows;
};

/// An SVG file on a white ground, 800 units wide.
std::string picture_svg(const Picture& picture);

}  // namespace skein::bench
