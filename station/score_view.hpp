// Shows the station's tally to other code in the same process (one_process/session.hpp).   Threads: one.
#pragma once

#include "station/scoreboard.hpp"

namespace skein::station {

struct ScoreView {
  const Scoreboard* board = nullptr;  ///< null: there is no station, or it does not know the points yet
};

}  // namespace skein::station
