// Where a run stands, and how it ended, in the words of files and messages.
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
  no_takeoff,   ///< in time
  interrupted,  ///< by the user
  aborted       ///< nothing that it left can be relied on
};
constexpr std::array<EnumName<RunStatus>, 4> enum_names(RunStatus) {
  return {{{"completed", RunStatus::completed},
           {"no_takeoff", RunStatus::no_takeoff},
           {"interrupted", RunStatus::interrupted},
           {"aborted", RunStatus::aborted}}};
}

}  // namespace skein
