#include "results/score_losses.hpp"

#include <algorithm>

namespace skein::results {
namespace {

/// The best of the captures for which `counts` returns true; of equally good ones the first.
std::optional<CaptureRow> best_of(const std::vector<CaptureRow>& captures, const auto& counts) {
  const CaptureRow* best = nullptr;
  for (const CaptureRow& capture : captures) {
    if (counts(capture) && (best == nullptr || capture.q > best->q)) best = &capture;
  }
  return best == nullptr ? std::nullopt : std::optional(*best);
}

/// Whether a lost picture is the cause of the point's loss: it was better than the score, and would have made up for at
/// least half of the loss. The second condition applies only if the point scored.
bool is_to_blame(float lost_q, const PointRecord& point) {
  const double q = lost_q, score = point.score;
  return q > score && (score == 0.0 || q - score >= point.estimate - q);
}
bool is_to_blame(const std::optional<CaptureRow>& lost, const PointRecord& point) {
  return lost && is_to_blame(static_cast<float>(lost->q), point);
}

/// The cause for a point without a picture that counts.
LossCause why_not_taken(const PointRecord& point, const BatteryEffects& batteries) {
  if (!point.flyable) return LossCause::out_of_reach;
  if (batteries.no_uav_could_fly) return LossCause::energy;
  return point.seen ? LossCause::below_threshold : LossCause::never_in_picture;
}

/// The factor with the lowest value in a picture's quality.
LossCause worst_part(const CaptureRow& capture) {
  const double tilt = tilt_quality(capture);
  if (capture.q_distance <= tilt && capture.q_distance <= capture.q_blur) return LossCause::distance;
  return tilt <= capture.q_blur ? LossCause::tilt : LossCause::blur;
}

}  // namespace

double tilt_quality(const CaptureRow& capture) {
  return capture.q_distance > 0.0 ? capture.q_res / capture.q_distance : 0.0;
}

std::string PointLoss::poor_part() const {
  if (cause != LossCause::below_threshold) return "";
  return poor ? name_of(worst_part(*poor)) : kPoorParts.back().key;
}

PointLoss loss_of(const PointRecord& point, const BatteryEffects& batteries) {
  PointLoss result;
  result.loss = static_cast<double>(point.estimate) - static_cast<double>(point.score);
  const auto voided = best_of(point.captures, [](const CaptureRow& row) { return row.voided(); });
  const auto earned = best_of(point.captures, [](const CaptureRow& row) { return !row.voided(); });
  result.best = best_of(point.captures, [](const CaptureRow& row) { return !row.voided() && row.delivered_at_s; });
  if (result.loss == 0.0) return result;
  if (result.loss < 0.0) {
    result.cause = LossCause::above_estimate;
  } else if (is_to_blame(earned, point)) {
    result.cause = LossCause::not_delivered;
    result.best = earned;
  } else if (is_to_blame(voided, point)) {
    result.cause = batteries.fell.contains(voided->uav) ? LossCause::energy : LossCause::voided;
    result.best = voided;
  } else if (is_to_blame(std::max(point.if_exact, point.if_calm), point)) {
    result.cause = point.if_exact >= point.if_calm ? LossCause::drift : LossCause::wind;
  } else {
    result.cause = result.best ? worst_part(*result.best) : why_not_taken(point, batteries);
    if (result.cause == LossCause::below_threshold) result.poor = point.poor;
  }
  return result;
}

std::map<LossCause, LossSum> sum_up(const std::vector<PointLoss>& losses) {
  std::map<LossCause, LossSum> sums;
  for (const auto& [name, cause] : enum_names(LossCause{})) {
    if (cause != LossCause::none) sums[cause] = {};
  }
  for (const PointLoss& loss : losses) {
    if (loss.cause == LossCause::none) continue;
    ++sums[loss.cause].points;
    sums[loss.cause].score += loss.loss;
  }
  return sums;
}

std::array<LossSum, kPoorParts.size()> sum_up_poor(const std::vector<PointLoss>& losses) {
  std::array<LossSum, kPoorParts.size()> sums;
  for (const PointLoss& loss : losses) {
    for (std::size_t i = 0; i < kPoorParts.size(); ++i) {
      if (loss.poor_part() != kPoorParts[i].key) continue;
      ++sums[i].points;
      sums[i].score += loss.loss;
    }
  }
  return sums;
}

}  // namespace skein::results
