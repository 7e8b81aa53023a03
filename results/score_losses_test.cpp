// Each loss has one cause, and the losses add up to the difference from the attainable score: on random runs, and cause
// by cause.
#include "results/score_losses.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"

namespace skein::results {
namespace {

CaptureRow capture(double q_distance, double q_tilt, double q_blur, bool delivered, bool voided = false) {
  CaptureRow row;
  row.uav = "alpha";
  row.q_distance = q_distance;
  row.q_res = q_distance * q_tilt;
  row.q_blur = q_blur;
  row.q = static_cast<float>(row.q_res * q_blur);
  if (delivered) row.delivered_at_s = 1.0;
  if (voided) row.reason = "uav collided";
  return row;
}

/// The station's score of captures: that of the best one that was delivered and not voided.
float scored(const std::vector<CaptureRow>& captures) {
  float best = 0.0F;
  for (const CaptureRow& row : captures) {
    if (row.delivered_at_s && !row.voided()) best = std::max(best, static_cast<float>(row.q));
  }
  return best;
}

/// A point of a random run, with any combination of values that a real run may have.
PointRecord drawn_point(RandomStream& random) {
  PointRecord point;
  if (random.uniform() < 0.8)
    point.estimate = static_cast<float>(random.uniform() < 0.5 ? 1.0 : random.uniform(0.2, 1.0));
  point.flyable = point.estimate > 0.0F && random.uniform() < 0.8;
  point.seen = random.uniform() < 0.5;
  if (random.uniform() < 0.5) point.if_exact = static_cast<float>(random.uniform(0.2, 1.0));
  if (random.uniform() < 0.5) point.if_calm = static_cast<float>(random.uniform(0.2, 1.0));
  for (int left = static_cast<int>(random.uniform(0.0, 4.0)); left > 0; --left) {
    CaptureRow row = capture(random.uniform(0.6, 1.0), random.uniform(0.6, 1.1), random.uniform(0.6, 1.0),
                             random.uniform() < 0.6, random.uniform() < 0.2);
    if (random.uniform() < 0.5) row.uav = "falls";
    point.captures.push_back(row);
    point.seen = true;
  }
  if (point.seen && random.uniform() < 0.8)
    point.poor = capture(random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), false);
  point.score = scored(point.captures);
  return point;
}

/// Whether a cause applies to a point: a second implementation, independent of the code under test.
bool is_true(const PointRecord& point, const BatteryEffects& batteries, LossCause cause) {
  const auto any = [&](const auto& has) { return std::any_of(point.captures.begin(), point.captures.end(), has); };
  // Whether a picture of this quality would have closed at least half of the gap between score and estimate.
  const auto would_matter = [&](float q) {
    return q > point.score && (point.score == 0.0F || 2.0 * q >= static_cast<double>(point.estimate) + point.score);
  };
  const auto mattered = [&](const CaptureRow& row) { return would_matter(static_cast<float>(row.q)); };
  const bool better_lost =
      any([&](const CaptureRow& row) { return !row.delivered_at_s && !row.voided() && mattered(row); });
  const bool better_voided = any([&](const CaptureRow& row) { return row.voided() && mattered(row); });
  const auto best_voided = std::max_element(
      point.captures.begin(), point.captures.end(),
      [](const auto& a, const auto& b) { return (a.voided() ? a.q : -1.0) < (b.voided() ? b.q : -1.0); });
  const bool fell = better_voided && best_voided->uav == "falls" && batteries.fell.contains("falls");
  const bool better_elsewhere = would_matter(point.if_exact) || would_matter(point.if_calm);
  const bool not_lost = !better_lost && !better_voided && !better_elsewhere;
  const bool quality = point.score > 0.0F && not_lost;
  const bool never = point.captures.empty() && point.flyable && not_lost;
  const bool lost = point.estimate > point.score;
  switch (cause) {
    case LossCause::none:
      return point.estimate == point.score;
    case LossCause::above_estimate:
      return point.estimate < point.score;
    case LossCause::not_delivered:
      return lost && better_lost;
    case LossCause::voided:
      return lost && better_voided && !better_lost && !fell;
    case LossCause::energy:
      return lost && !better_lost && (fell || (never && batteries.no_uav_could_fly));
    case LossCause::drift:
      return lost && !better_lost && !better_voided && would_matter(point.if_exact) && point.if_exact >= point.if_calm;
    case LossCause::wind:
      return lost && !better_lost && !better_voided && would_matter(point.if_calm) && point.if_calm > point.if_exact;
    case LossCause::distance:
    case LossCause::tilt:
    case LossCause::blur:
      return lost && quality;
    case LossCause::out_of_reach:
      return lost && point.captures.empty() && !point.flyable && not_lost;
    case LossCause::below_threshold:
      return lost && never && !batteries.no_uav_could_fly && point.seen;
    case LossCause::never_in_picture:
      return lost && never && !batteries.no_uav_could_fly && !point.seen;
  }
  return false;
}

TEST(ScoreLosses, TheLossesAddUpToEstimateMinusScore) {
  std::map<LossCause, std::size_t> met;
  for (std::uint64_t key = 0; key < 40; ++key) {
    RandomStream random(key, "score_losses_test", 0);
    BatteryEffects batteries{.no_uav_could_fly = random.uniform() < 0.3, .fell = {}};
    if (random.uniform() < 0.5) batteries.fell.insert("falls");
    std::vector<PointLoss> losses;
    double estimate = 0.0, score = 0.0;
    for (int i = 0; i < 400; ++i) {
      const PointRecord point = drawn_point(random);
      const PointLoss loss = loss_of(point, batteries);
      losses.push_back(loss);
      estimate += point.estimate;
      score += point.score;
      EXPECT_TRUE(is_true(point, batteries, loss.cause))
          << name_of(loss.cause) << ": " << point.estimate << ' ' << point.score;
      EXPECT_EQ(loss.loss, static_cast<double>(point.estimate) - point.score);
      ++met[loss.cause];
    }
    double sum = 0.0;
    std::size_t points = 0;
    for (const auto& [cause, part] : sum_up(losses)) {
      sum += part.score;
      points += part.points;
      EXPECT_EQ(part.score < 0.0, cause == LossCause::above_estimate && part.points > 0) << name_of(cause);
    }
    EXPECT_EQ(sum, estimate - score);
    EXPECT_EQ(points, static_cast<std::size_t>(std::count_if(losses.begin(), losses.end(),
                                                             [](const auto& loss) { return loss.loss != 0.0; })));
  }
  for (const auto& [name, cause] : enum_names(LossCause{})) EXPECT_GT(met[cause], 0u) << name;
}

/// The part for which the loss must count, computed independently of the code under test: the worst one, and of equal
/// parts the first.
std::string expected_part(const PointRecord& point, LossCause cause) {
  if (cause != LossCause::below_threshold) return "";
  if (!point.poor) return "unsplit";
  std::vector<std::pair<double, std::string>> parts = {{point.poor->q_distance, "distance"},
                                                       {point.poor->q_res / point.poor->q_distance, "tilt"},
                                                       {point.poor->q_blur, "blur"}};
  std::ranges::stable_sort(parts, {}, &std::pair<double, std::string>::first);
  return parts.front().second;
}

TEST(ScoreLosses, PicturesTooPoorToCountAreSplitByTheWorstPart) {
  RandomStream random(7, "score_losses_test", 0);
  std::vector<PointLoss> losses;
  std::map<std::string, LossSum> expected;
  for (int i = 0; i < 60000; ++i) {
    const PointRecord point = drawn_point(random);
    const PointLoss loss = loss_of(point);
    const std::string part = expected_part(point, loss.cause);
    EXPECT_EQ(loss.poor_part(), part);
    EXPECT_EQ(loss.poor.has_value(), !part.empty() && part != "unsplit");
    ++expected[part].points;
    expected[part].score += loss.loss;
    losses.push_back(loss);
  }
  const auto parts = sum_up_poor(losses);
  LossSum whole;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_GT(parts[i].points, 100U) << kPoorParts[i].key;
    EXPECT_EQ(parts[i].points, expected[kPoorParts[i].key].points) << kPoorParts[i].key;
    EXPECT_EQ(parts[i].score, expected[kPoorParts[i].key].score) << kPoorParts[i].key;
    whole.points += parts[i].points;
    whole.score += parts[i].score;
  }
  const LossSum all = sum_up(losses)[LossCause::below_threshold];
  EXPECT_EQ(whole.points, all.points);
  EXPECT_EQ(whole.score, all.score);
}

TEST(ScoreLosses, TheWorstPartOfTheBestPictureIsToBlame) {
  const auto cause = [](const CaptureRow& best) {
    PointRecord point{1.0F, true, true, 0.0F, {capture(0.5, 0.5, 0.5, true), best, capture(0.4, 1.0, 1.0, true)}};
    point.score = scored(point.captures);
    const PointLoss loss = loss_of(point);
    EXPECT_EQ(loss.best->q, best.q);
    return loss.cause;
  };
  EXPECT_EQ(cause(capture(0.7, 0.9, 0.8, true)), LossCause::distance);
  // Of equally bad parts, the first in this order counts: distance, tilt, blur.
  EXPECT_EQ(cause(capture(0.75, 0.75, 0.75, true)), LossCause::distance);
  EXPECT_EQ(cause(capture(1.0, 0.75, 0.75, true)), LossCause::tilt);
  EXPECT_EQ(cause(capture(0.75, 1.0, 0.75, true)), LossCause::distance);
  EXPECT_EQ(cause(capture(0.9, 0.7, 0.8, true)), LossCause::tilt);
  EXPECT_EQ(cause(capture(0.9, 0.8, 0.7, true)), LossCause::blur);
  // A tilt above 1 may make up for the distance. The distance is still the cause.
  EXPECT_EQ(cause(capture(0.8, 1.2, 0.9, true)), LossCause::distance);
}

TEST(ScoreLosses, ABetterPictureThatWasLostIsNamed) {
  PointRecord point{1.0F, true, true, 0.0F, {capture(0.6, 1.0, 1.0, true), capture(0.8, 1.0, 1.0, false)}};
  point.score = scored(point.captures);
  EXPECT_EQ(loss_of(point).cause, LossCause::not_delivered);
  EXPECT_EQ(loss_of(point).best->q_distance, 0.8);
  // The UAV collided, so its pictures are void, whether they were delivered or not.
  for (const bool delivered : {false, true}) {
    point.captures[1] = capture(0.8, 1.0, 1.0, delivered, true);
    EXPECT_EQ(loss_of(point).cause, LossCause::voided);
    EXPECT_EQ(loss_of(point).best->q_distance, 0.8);
  }
}

}  // namespace
}  // namespace skein::results
