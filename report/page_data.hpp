// Data for the script of an interactive page, as JSON. Tracks are thinned to at most two positions per second and
// rounded to centimetres; the page's text and tables use the full data instead. Pure; any thread.
#pragma once

#include "report/page_parts.hpp"

namespace skein::report {

/// All data of a run's page. web/src/report.js reads its keys.
Json page_data(const RunPage& page);
/// The part without time series: points, boxes, station, collisions, causes, faults.
Json scene_data(const results::RunRecord& run);

}  // namespace skein::report
