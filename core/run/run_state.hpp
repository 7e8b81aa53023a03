// Phases and end states of a run, with their names in files and messages.
#pragma once

#include <array>

#include "core/types.hpp"

namespace skein {

enum class Phase {
  waiting,  ///< for the first UAV to take off
  flying,
  ended
};
constexpr std::array<EnumName<Phase>, 3> enum_names(Phase) {
  return {{{"waiting", Phase::waiting}, {"flying", Phase::flying}, {"ended", Phase::ended}}};
}

enum class RunStatus {
  completed,
  no_takeoff,   ///< no UAV took off before the timeout
  interrupted,  ///< ended by the user
  aborted       ///< ended prematurely: its results are not reliable
};
constexpr std::array<EnumName<RunStatus>, 4> enum_names(RunStatus) {
  return {{{"completed", RunStatus::completed},
           {"no_takeoff", RunStatus::no_takeoff},
           {"interrupted", RunStatus::interrupted},
           {"aborted", RunStatus::aborted}}};
}

}  // namespace skein
