// The tally of a station, for whoever shares its process (one_process/session.hpp).   Threads: one.
#pragma once

#include "station/scoreboard.hpp"

namespace skein::station {

struct ScoreView {
  const Scoreboard* board = nullptr;  ///< null: it knows of no points yet, or there is no station
};

}  // namespace skein::station
