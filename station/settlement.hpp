// The last will of a station that was killed for good: what its journal holds is what it acknowledged.
#pragma once

#include <filesystem>

#include "core/run/run_id.hpp"
#include "core/scenario.hpp"
#include "process/status/status_pipe.hpp"

namespace skein::station {

/// Writes the station's files into `folder` from the journal there (station_report.hpp). captures.csv lists what was
/// delivered, and nothing else; what was earned is unknown and left out.
/// @throws std::runtime_error when there is no scene.json, which has the points; or a file cannot be read or written.
void settle(const std::filesystem::path& folder, const Scenario& scenario, RunId run, StatusPipe& status);

}  // namespace skein::station
