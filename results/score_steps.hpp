// The score over the time of a finished run, computed from its captures. Pure.
#pragma once

#include <vector>

#include "results/run_rows.hpp"

namespace skein::results {

enum class Counts { when_taken, when_delivered };

/// The score at 0 s and at each later time when it rises: the sum over all points of the best quality so far, and the
/// number of these points. Leaves out captures of UAVs that collided, and those of a quality below `least_q`.
std::vector<ScoreRow> score_steps(const std::vector<CaptureRow>& captures, double least_q, Counts counts);

}  // namespace skein::results
