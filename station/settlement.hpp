// Writes the result files of a station that was killed and did not come back. Its journal has all that it acknowledged.
#pragma once

#include <filesystem>

#include "core/run/run_id.hpp"
#include "core/scenario/scenario.hpp"
#include "process/status/status_pipe.hpp"

namespace skein::station {

/// Writes the station's files into `folder` from the journal there (station_report.hpp), and from the simulator's
/// report, which has the collisions of the time after the station was killed. captures.csv lists only captures that
/// were delivered. The score earned is unknown: it is left out, or 0 if the journal is empty.
/// @throws std::runtime_error when scene.json, which has the points, is missing; or a file cannot be read or written.
void settle(const std::filesystem::path& folder, const Scenario& scenario, RunId run, StatusPipe& status);

}  // namespace skein::station
