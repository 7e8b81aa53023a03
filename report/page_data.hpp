// What the interactive part of a page draws, as JSON. Tracks are thinned to two positions a second and rounded to
// centimetres; what the page states in words and tables does not come from here. Pure; any thread.
#pragma once

#include "report/page_parts.hpp"

namespace skein::report {

/// Keys: web/src/report.js reads them.
Json page_data(const RunPage& page);
/// Of these the part that has no time: points, boxes, station, collisions, causes, faults.
Json scene_data(const results::RunData& run);

}  // namespace skein::report
