// Explains the difference between the attainable score and a fleet's score, point by point, with one cause each. Pure.
// Scores are single-precision numbers in [0, 1], so that their sums and differences in double precision are exact:
// estimate - score == sum of all losses, to the last bit.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "results/causes.hpp"
#include "results/run_rows.hpp"

namespace skein::results {

/// What is known of one interest point after a run.
struct PointRecord {
  float estimate = 0.0F;             ///< q of the best picture that the oracle found; 0: not attainable
  bool flyable = false;              ///< attainable from a place where a UAV fits
  bool seen = false;                 ///< was ever in a camera's picture and in sight
  float score = 0.0F;                ///< delivered
  std::vector<CaptureRow> captures;  ///< of this point, in any order
  /// q of the best picture that would have been taken if UAVs had been where they believed to be, and without wind.
  float if_exact = 0.0F, if_calm = 0.0F;
  /// For a point without a picture that counts: the qualities of its best picture. nullopt: not known, or the quality
  /// was never defined.
  std::optional<CaptureRow> poor = {};
};

/// What batteries did in the run.
struct BatteryEffects {
  bool no_uav_could_fly = false;  ///< at the end of the mission, all UAVs that had not collided were grounded
  std::set<std::string> fell;     ///< UAVs that collided because their battery was empty
};

struct PointLoss {
  LossCause cause = LossCause::none;
  double loss = 0.0;  ///< estimate - score
  std::optional<CaptureRow>
      best;  ///< the capture that the cause is about: the best one that counts, or the one that was lost
  std::optional<CaptureRow> poor = {};  ///< of the point, if the cause is `below_threshold`

  /// The key in kPoorParts, if the cause is `below_threshold`, else empty: the part of `poor` that costs most.
  std::string poor_part() const;
};

/// The loss of one point, with one cause for all of it. If a better picture was lost (not delivered, else voided, else
/// not taken because of drift or wind), that is the cause, unless the point scored and this picture would have made up
/// for less than half of the loss.
PointLoss loss_of(const PointRecord& point, const BatteryEffects& batteries = {});

/// Number of points with one cause, and the sum of their losses.
struct LossSum {
  std::size_t points = 0;
  double score = 0.0;
};
/// The sums for each cause except `none`.
std::map<LossCause, LossSum> sum_up(const std::vector<PointLoss>& losses);
/// The sums of the points with the cause `below_threshold`, in the order of kPoorParts. They add up to its sum.
std::array<LossSum, kPoorParts.size()> sum_up_poor(const std::vector<PointLoss>& losses);

/// The factor by which the tilt of the surface changes a picture's resolution quality: q_res / q_distance, 0 if
/// q_distance is 0. It can exceed 1 (core/scoring/camera_quality.hpp).
double tilt_quality(const CaptureRow& capture);

}  // namespace skein::results
