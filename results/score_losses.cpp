#include "results/score_losses.hpp"

#include <algorithm>

namespace skein::results {
namespace {

/// The best of those captures that `counts`; of equal ones the first.
template <class Counts>
std::optional<CaptureRow> best_of(const std::vector<CaptureRow>& captures, const Counts& counts) {
  const CaptureRow* best = nullptr;
  for (const CaptureRow& capture : captures) {
    if (counts(capture) && (best == nullptr || capture.q > best->q)) best = &capture;
  }
  return best == nullptr ? std::nullopt : std::optional(*best);
}

/// Whether a better picture was had, and that it does not count costs at least as much as what it lacked itself. Of a
/// point that scored nothing it always does.
bool is_to_blame(const std::optional<CaptureRow>& lost, const PointRecord& point) {
  if (!lost) return false;
  const double q = static_cast<float>(lost->q), score = point.score;
  return q > score && (score == 0.0 || q - score >= point.estimate - q);
}

/// What is worst about a picture.
LossCause worst_part(const CaptureRow& capture) {
  const double tilt = tilt_quality(capture);
  if (capture.q_distance <= tilt && capture.q_distance <= capture.q_blur) return LossCause::distance;
  return tilt <= capture.q_blur ? LossCause::tilt : LossCause::blur;
}

}  // namespace

double tilt_quality(const CaptureRow& capture) {
  return capture.q_distance > 0.0 ? capture.q_res / capture.q_distance : 0.0;
}

PointLoss loss_of(const PointRecord& point) {
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
    result.cause = LossCause::voided;
    result.best = voided;
  } else if (result.best) {
    result.cause = worst_part(*result.best);
  } else if (!point.flyable) {
    result.cause = LossCause::out_of_reach;
  } else {
    result.cause = point.seen ? LossCause::below_threshold : LossCause::never_in_picture;
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

}  // namespace skein::results
