// What a program says of what it does and why, for people (topic /{id}/activity): no member of the fleet acts on it,
// and it is in no digest.   Frame W.   SI.   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/types.hpp"

namespace skein {

struct Activity {
  std::string mode;  ///< "takes off", "flies to a goal", ...
  std::optional<Vector3d> goal_W = {};
  std::string waits_for = {};  ///< a member of the fleet; empty: none
  std::string no_way = {};     ///< why it finds no way; empty: it does, or looks for none
  double speed_mps = 0.0;
  std::uint32_t undelivered = 0;  ///< captures
  double cpu_s = 0.0;             ///< of its strategy since it started: no run repeats it
  bool operator==(const Activity&) const = default;
};

}  // namespace skein
