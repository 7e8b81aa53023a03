// What separates a fleet's score from what could be had, point by point: each loss has one cause. Pure.
// Scores are numbers of single precision in [0, 1], so that sums and differences of them in double precision are exact:
// estimate - score == sum of all losses, to the last bit.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "results/causes.hpp"
#include "results/run_record.hpp"

namespace skein::results {

/// What is known of one interest point after a run.
struct PointRecord {
  float estimate = 0.0F;             ///< q of the best picture that the oracle found; 0: not attainable
  bool flyable = false;              ///< attainable for a UAV that fits there and gets there
  bool seen = false;                 ///< was in some picture and in sight
  float score = 0.0F;                ///< delivered
  std::vector<CaptureRow> captures;  ///< of this point, in any order
};

struct PointLoss {
  LossCause cause = LossCause::none;
  double loss = 0.0;  ///< estimate - score
  std::optional<CaptureRow>
      best;  ///< the picture that the cause is about: the one that counts, or the one that was lost
};

/// What one point lost, and to what. It is one cause for all of the loss: a better picture that was lost comes first,
/// unless the point scored all the same and that picture would have brought less than half of what was possible.
PointLoss loss_of(const PointRecord& point);

/// Points with a cause, and the sum of their losses.
struct LossSum {
  std::size_t points = 0;
  double score = 0.0;
};
/// One for each cause but `none`.
std::map<LossCause, LossSum> sum_up(const std::vector<PointLoss>& losses);

/// The part of a picture's resolution that the tilt of the surface takes; above 1 where the formula prefers the axis.
double tilt_quality(const CaptureRow& capture);

}  // namespace skein::results
