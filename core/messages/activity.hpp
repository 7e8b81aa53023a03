// Reports of a UAV's program about its current action and the reason for it (topic /{id}/activity). Only people use
// these reports: no program of the fleet acts on them, and no digest includes them.   Frame W.   SI.   Pure; any
// thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/types.hpp"

namespace skein {

struct Activity {
  std::string mode;  ///< "takes off", "flies to a goal", ...
  std::optional<Vector3d> goal_W = {};
  std::string waits_for = {};  ///< name of the UAV that this UAV waits for; empty: none
  std::string no_way = {};     ///< why path search failed; empty: it found a path, or there was no search
  double speed_mps = 0.0;
  std::uint32_t undelivered = 0;  ///< number of captures that the station has not acknowledged
  double cpu_s = 0.0;             ///< CPU time of the planner since the program started; differs from run to run
  bool operator==(const Activity&) const = default;
};

}  // namespace skein
