#include "report/figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "report/flight_picture.hpp"
#include "results/score_steps.hpp"

namespace skein::report {
namespace {

constexpr double kStep = 0.05;

/// Random runs. The tests compare each figure with one that they compute in a simpler way.
class Figures : public testing::TestWithParam<unsigned> {
 protected:
  Figures() : random_(GetParam()) {
    for (std::size_t i = 0; i < 1 + below(6); ++i) run_.uavs.push_back("u" + std::to_string(i));
    run_.explorer.resize(run_.uavs.size());
    run_.end_s = kStep * kSteps;
    for (std::size_t i = 0; i < 3; ++i) {
      run_.boxes.push_back({"b" + std::to_string(i), draw_place(), Vector3d(10.0, 12.0, 14.0),
                            Eigen::AngleAxisd(number(3.0), Vector3d::UnitZ()).toRotationMatrix()});
    }
    for (std::size_t i = 0; i < 200; ++i) {
      results::RunPoint point;
      point.p_W = draw_place();
      point.estimate = below(3) > 0 ? number(1.0) : 0.0;
      point.score = below(2) > 0 ? number(1.0) : 0.0;
      point.loss = point.estimate - point.score;
      if (point.loss != 0.0) point.cause = below(results::kCauses.size());
      run_.points.push_back(point);
    }
    for (std::size_t i = 0; i < 400; ++i) {
      const std::size_t uav = below(run_.uavs.size());
      results::CaptureRow capture{.uav = run_.uavs[uav], .capture = below(40), .point = below(50), .q = number(1.0)};
      capture.time_s = static_cast<double>(capture.capture) + 0.1 * static_cast<double>(uav);
      if (capture.capture % 3 > 0) capture.delivered_at_s = capture.time_s + static_cast<double>(capture.capture % 7);
      if (uav == 0) capture.reason = run_tables::kUavCollided;
      run_.captures.push_back(capture);
    }
    for (std::size_t k = 0; k < kSteps; ++k) {
      for (std::size_t i = below(3); i > 0; --i) {
        add_event(k, below(2) > 0 ? "link_up" : "link_down", node(), node());
      }
    }
  }

  static constexpr std::size_t kSteps = 300;
  std::size_t below(std::size_t limit) { return random_() % limit; }
  double number(double most) { return most * static_cast<double>(below(1001)) / 1000.0; }
  Vector3d draw_place() { return {number(30.0), number(30.0), number(30.0)}; }
  void add_event(std::size_t k, const std::string& event, const std::string& subject, const std::string& object) {
    run_.events.push_back({k, event, subject, object, kStep * static_cast<double>(k)});
  }
  std::string node() {
    const std::size_t i = below(run_.uavs.size() + 1);
    return i < run_.uavs.size() ? run_.uavs[i] : "gcs";
  }
  /// The links in step k, computed by brute force: sender and receiver.
  std::set<std::pair<std::string, std::string>> links_in(std::size_t k) const {
    std::set<std::pair<std::string, std::string>> up;
    for (const results::EventRow& event : run_.events) {
      if (event.time_s > kStep * (static_cast<double>(k) + 0.5)) break;
      if (event.event == "link_up") {
        up.insert({event.subject, event.object});
      } else {
        up.erase({event.subject, event.object});
      }
    }
    return up;
  }
  static bool within(const Spans& spans, double time_s) {
    return std::any_of(spans.begin(), spans.end(),
                       [&](const Span& s) { return s.from_s <= time_s && time_s < s.until_s; });
  }

  std::mt19937 random_;
  results::RunRecord run_;
};

TEST_P(Figures, ABoxHoldsThePointsBetweenItsFaces) {
  for (const results::RunBox& box : run_.boxes) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d share(number(2.4) - 1.2, number(2.4) - 1.2,
                           number(2.4) - 1.2);  // as shares of the way to the faces
      const Vector3d p_W = box.center + box.R_WB * (0.5 * box.size.cwiseProduct(share));
      if (std::abs(share.cwiseAbs().maxCoeff() - 1.0) < 1e-6) continue;  // on a face
      EXPECT_EQ(box.holds(p_W), share.cwiseAbs().maxCoeff() < 1.0);
    }
  }
}

TEST_P(Figures, TheFiguresOfAllBoxesAreThoseOfAllPoints) {
  const std::vector<BoxFigures> boxes = box_figures(run_);
  const BoxFigures& all = boxes.back();
  EXPECT_EQ(all.points, run_.points.size());
  double score = 0.0, loss = 0.0;
  for (const results::RunPoint& point : run_.points) {
    score += point.score;
    loss += point.loss;
  }
  EXPECT_NEAR(all.score, score, 1e-9);
  EXPECT_NEAR(all.estimate - all.score, loss, 1e-9);
  BoxFigures sum;
  for (std::size_t i = 0; i + 1 < boxes.size(); ++i) {
    sum.points += boxes[i].points;
    sum.scored += boxes[i].scored;
    sum.attainable += boxes[i].attainable;
    sum.score += boxes[i].score;
    double losses = 0.0;
    for (const double lost : boxes[i].losses) losses += lost;
    EXPECT_NEAR(losses, boxes[i].estimate - boxes[i].score, 1e-9) << boxes[i].name;
  }
  EXPECT_EQ(sum.points, all.points);
  EXPECT_EQ(sum.scored, all.scored);
  EXPECT_EQ(sum.attainable, all.attainable);
  EXPECT_NEAR(sum.score, all.score, 1e-9);
}

TEST_P(Figures, PointsNeverInThePictureAreCountedByWhetherAUavCameNear) {
  EXPECT_FALSE(never_in_picture(run_)) << "the run has no camera yet";
  const auto cause = results::cause_of("never_in_picture");
  for (std::size_t uav = 0; uav < run_.uavs.size(); ++uav) {
    run_.cameras.push_back(below(4) > 0 ? std::optional(results::RunCamera{60.0, 40.0, number(6.0)}) : std::nullopt);
    for (std::size_t k = 0; k < 150; ++k) {
      const Vector3d p_W = draw_place();
      run_.poses.push_back({0.1 * static_cast<double>(k), run_.uavs[uav], p_W, Vector3d::UnitX(), k < 100});
    }
  }
  NeverInPicture expected;
  for (const results::RunPoint& point : run_.points) {
    if (point.cause != cause) continue;
    bool near = false;
    for (const results::PoseRow& pose : run_.poses) {
      const auto& camera = run_.cameras[*run_.uav_of(pose.uav)];
      near = near || (pose.alive && camera && (pose.p_W - point.p_W).norm() <= camera->range_m);
    }
    ++(near ? expected.points_near : expected.points_far);
    (near ? expected.loss_near : expected.loss_far) += point.loss;
  }
  const auto found = never_in_picture(run_);
  if (std::ranges::none_of(run_.cameras, [](const auto& camera) { return camera.has_value(); })) {
    EXPECT_FALSE(found);
    return;
  }
  ASSERT_TRUE(found);
  EXPECT_EQ(found->points_near, expected.points_near);
  EXPECT_EQ(found->points_far, expected.points_far);
  EXPECT_NEAR(found->loss_near, expected.loss_near, 1e-9);
  EXPECT_NEAR(found->loss_far, expected.loss_far, 1e-9);
}

TEST_P(Figures, TheEarnedScoreCountsTheBestPictureOfEachPoint) {
  for (const auto& now : score_steps(run_.captures, kDetected, results::Counts::when_taken)) {
    std::map<std::size_t, double> best;
    for (const results::CaptureRow& capture : run_.captures) {
      if (capture.voided() || capture.q < kDetected || capture.time_s > now.time_s) continue;
      best[capture.point] = std::max(best[capture.point], capture.q);
    }
    double sum = 0.0;
    for (const auto& [point, q] : best) sum += q;
    ASSERT_NEAR(now.score, sum, 1e-9) << now.time_s;
    ASSERT_EQ(now.points, static_cast<double>(best.size()));
  }
}

TEST_P(Figures, ContactFollowsFromTheLinks) {
  const std::vector<Lane> lanes = lanes_of(run_);
  const double first_s = run_.events.front().time_s;
  for (std::size_t k = 0; k < kSteps; k += 7) {
    const double time_s = kStep * (static_cast<double>(k) + 0.5);
    if (time_s < first_s) continue;
    const auto up = links_in(k);
    std::set<std::string> heard = {"gcs"};
    for (std::size_t before = 0; before != heard.size();) {
      before = heard.size();
      for (const auto& [from, to] : up) {
        if (heard.contains(to)) heard.insert(from);
      }
    }
    for (std::size_t uav = 0; uav < run_.uavs.size(); ++uav) {
      const bool direct = up.contains({run_.uavs[uav], "gcs"});
      EXPECT_EQ(within(lanes[uav].direct, time_s), direct) << run_.uavs[uav] << " at " << time_s;
      EXPECT_EQ(within(lanes[uav].relayed, time_s), !direct && heard.contains(run_.uavs[uav])) << time_s;
    }
  }
}

TEST_P(Figures, TheShareOfALinkIsTheShareOfStepsWithTheLink) {
  const LinkShares shares = link_shares(run_);
  std::map<std::pair<std::string, std::string>, double> steps;
  for (std::size_t k = 0; k < kSteps; ++k) {
    for (const auto& link : links_in(k)) steps[link] += 1.0 / kSteps;
  }
  for (const auto& [link, share] : steps) {
    ASSERT_TRUE(shares.contains(link));
    EXPECT_NEAR(shares.at(link), share, 1e-6) << link.first << " to " << link.second;
  }
}

TEST_P(Figures, LatencyCountsEachCaptureOnce) {
  const Latency latency = latency_of(run_);
  std::map<std::pair<std::string, std::uint64_t>, std::optional<double>> captures;
  for (const results::CaptureRow& line : run_.captures) {
    captures[{line.uav, line.capture}] =
        line.delivered_at_s ? std::optional(*line.delivered_at_s - line.time_s) : std::nullopt;
  }
  EXPECT_EQ(latency.delays_s.size() + latency.never, captures.size());
  for (const double share : {0.01, 0.5, 0.9, 1.0}) {
    const double limit = latency.quantile(share);
    const auto count = [&](double most) {
      return static_cast<double>(std::count_if(captures.begin(), captures.end(),
                                               [&](const auto& c) { return c.second && *c.second <= most; }));
    };
    const double all = static_cast<double>(latency.delays_s.size());
    EXPECT_GE(count(limit) / all, share - 1e-12);
    EXPECT_LT(count(limit - 1e-9) / all, share);
  }
}

TEST_P(Figures, AUavIsStillIfItIsSlowAndTookNoBetterPicture) {
  for (std::size_t i = 0; i < 600; ++i) {
    const Vector3d v_W((i / 40) % 2 == below(2) ? 1.0 : 0.0, 0.0, 0.0);
    run_.poses.push_back({0.1 * static_cast<double>(i), run_.uavs[0], Vector3d::Zero(), v_W, i < 500});
  }
  const std::vector<results::PoseRow>& track = run_.poses;
  const std::vector<Lane> lanes = lanes_of(run_);
  for (std::size_t i = 0; i + 1 < track.size(); ++i) {
    const auto recent = [&](const results::CaptureRow& capture) {
      return capture.uav == run_.uavs[0] && capture.time_s <= track[i].time_s && capture.time_s > track[i].time_s - 5.0;
    };
    const bool still = track[i].alive && track[i].v_W.norm() < 0.1 && std::ranges::none_of(run_.captures, recent);
    EXPECT_EQ(within(lanes[0].still, track[i].time_s + 0.05), still) << track[i].time_s;
  }
}

/// In each step, the activity that the UAV reported last counts, if its program takes part.
TEST_P(Figures, EachStepCountsForTheActivityThatWasReportedLast) {
  static const std::vector<std::pair<std::string, TimeUse>> kSaid = {{"takes off", TimeUse::takes_off},
                                                                     {"flies along a line", TimeUse::flies},
                                                                     {"flies back the way it came", TimeUse::recovers},
                                                                     {"stands: too near", TimeUse::stands},
                                                                     {"delivers", TimeUse::homing},
                                                                     {"waits to be shown its way", TimeUse::waits},
                                                                     {"sings", TimeUse::other}};
  run_.events.clear();
  std::vector<TimeBudget> expected(run_.uavs.size(), TimeBudget{});
  for (std::size_t uav = 0; uav + 1 < run_.uavs.size(); ++uav) {  // the last one reports nothing
    bool joined = false;
    std::optional<TimeUse> use;
    for (std::size_t k = 0; k < kSteps; ++k) {
      const double time_s = kStep * static_cast<double>(k);
      if (below(20) == 0) {
        joined = !joined;
        add_event(k, joined ? "joined" : "left", run_.uavs[uav], "");
      }
      if (k == 10 || below(8) == 0) {
        const auto& [mode, usual] = kSaid[below(kSaid.size())];
        const bool waits = below(4) == 0;
        run_.activities.push_back({time_s, run_.uavs[uav], {.mode = mode, .waits_for = waits ? "another" : ""}});
        use = waits ? TimeUse::waits : usual;
      }
      if (joined && use) expected[uav][static_cast<std::size_t>(*use)] += kStep;
    }
  }
  std::ranges::stable_sort(run_.events, {}, &results::EventRow::time_s);
  const auto budgets = time_budgets(run_, lanes_of(run_));
  ASSERT_EQ(budgets.size(), run_.uavs.size());
  EXPECT_FALSE(budgets.back());
  for (std::size_t uav = 0; uav + 1 < run_.uavs.size(); ++uav) {
    ASSERT_TRUE(budgets[uav]);
    for (std::size_t i = 0; i < kTimeUses; ++i) EXPECT_NEAR((*budgets[uav])[i], expected[uav][i], 1e-6) << uav << i;
  }
}

TEST_P(Figures, UndeliveredCapturesAreThoseTakenLessThoseReleased) {
  run_.events.clear();
  int waiting = 0;
  std::map<double, int> expected;
  for (std::size_t k = 0; k < kSteps; ++k) {
    const double time_s = kStep * static_cast<double>(k);
    for (std::size_t i = below(4); i > 0; --i) {
      const bool out = waiting == 0 || below(2) > 0;
      waiting += out ? 1 : -1;
      add_event(k, out ? "captured" : "released", run_.uavs[0], "1");
      expected[time_s] = waiting;
    }
  }
  const std::vector<Lane> lanes = lanes_of(run_);
  ASSERT_EQ(lanes[0].undelivered.size(), expected.size());
  for (const Waiting& change : lanes[0].undelivered) EXPECT_EQ(change.captures, expected.at(change.time_s));
}

INSTANTIATE_TEST_SUITE_P(Drawn, Figures, testing::Range(1U, 9U));

}  // namespace
}  // namespace skein::report
