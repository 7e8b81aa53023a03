// The files of a run agree with each other, and the score can be recomputed from captures.csv alone.
#include <algorithm>
#include <cmath>

#include "fleet_fixture.hpp"

namespace skein::test {
namespace {

/// Numbers of the files have nine significant digits; a sum over some thousand points may be off by this.
constexpr double kSumTolerance = 1e-5;
constexpr double kMinPointScore = 0.2;
constexpr double kDurationS = 120.0;
/// Greatest speed: the limit of a commanded speed times the permitted overshoot of the controller [m/s].
constexpr double kMaxSpeed = 1.3 * 6.0;

using Row = std::map<std::string, std::string>;

double number(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

/// One run for all checks, because a run takes a while.
class Results : public FleetTest {
 protected:
  void SetUp() override {
    run_ = &run("towers", {"towers", "--planner", "patrol", "--seed", "4", "--duration", std::to_string(kDurationS)});
    result_ = run_->result();
  }

  std::vector<Row> csv(const std::string& name) const { return read_csv(run_->dir() / name); }
  double score() const { return result_["score"]; }

  void check_result() const {
    SCOPED_TRACE("result.json");
    expect_complete_result(*run_);
    EXPECT_EQ(result_["status"], "completed");
    EXPECT_TRUE(result_["deterministic"]);
    EXPECT_EQ(result_["scenario"], "towers");
    EXPECT_EQ(result_["seed"], 4);
    EXPECT_NEAR(result_["mission_time_s"].get<double>(), kDurationS, 0.1);
    EXPECT_EQ(result_["dds"].size(), kPrograms.size());
    EXPECT_TRUE(result_["lost_members"].empty());
    ASSERT_EQ(result_["uavs"].size(), kFleet.size());
    for (std::size_t i = 0; i < kFleet.size(); ++i) {
      EXPECT_EQ(result_["uavs"][i]["name"], kFleet[i]);
      const Json& uav = result_["uavs"][i];
      EXPECT_GT(uav["planner_cpu_s"], 0.0);
      EXPECT_GT(uav["planner_cpu_p99_ms"], 0.0);
      EXPECT_GE(uav["planner_cpu_max_ms"], uav["planner_cpu_p99_ms"]);
      EXPECT_LE(uav["planner_cpu_max_ms"].get<double>(), 1e3 * uav["planner_cpu_s"].get<double>());
      EXPECT_EQ(uav["planner_exchanges_over_50ms"] > 0, uav["planner_cpu_max_ms"] > 50.0);
      EXPECT_GT(result_["uavs"][i]["distance_m"], 10.0);
      EXPECT_GT(uav["safety_filter"]["steps"], 0);
      EXPECT_LE(uav["safety_filter"]["slowed"], uav["safety_filter"]["steps"]);
      EXPECT_LE(uav["safety_filter"]["breaches"], uav["safety_filter"]["steps"]);
    }
    EXPECT_GT(score(), 10.0) << "the run scored too little for these checks";
    EXPECT_GE(result_["score_earned"].get<double>(), score() - kSumTolerance);
  }

  void check_scores() const {
    SCOPED_TRACE("score.csv, score_timeline.csv, scene.json");
    const auto points = csv("score.csv");
    ASSERT_EQ(points.size(), result_["points_total"].get<std::size_t>());
    double sum = 0.0;
    int detected = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(points[i].at("index"), std::to_string(i));
      sum += number(points[i], "score");
      detected += number(points[i], "score") >= kMinPointScore;
    }
    EXPECT_NEAR(sum, score(), kSumTolerance);
    EXPECT_EQ(result_["points_detected"], detected);
    const auto timeline = csv("score_timeline.csv");
    ASSERT_FALSE(timeline.empty());
    EXPECT_NEAR(number(timeline.back(), "score"), score(), kSumTolerance);
    EXPECT_EQ(number(timeline.back(), "points"), detected);
    const Json scene = Json::parse(text_of(run_->dir() / "scene.json"));
    EXPECT_EQ(scene["points"].size(), points.size());
    EXPECT_FALSE(scene["boxes"].empty());
  }

  /// Recomputes the score: the best delivered capture of each point, by UAVs without a collision.
  void check_captures() const {
    SCOPED_TRACE("captures.csv");
    std::set<std::string> collided;
    for (const Json& collision : result_["collisions"]) collided.insert(collision["uav"]);
    std::map<int, double> best;
    std::set<int> counted;
    for (const Row& row : csv("captures.csv")) {
      const double q = number(row, "q");
      const int point = std::stoi(row.at("point"));
      ASSERT_GE(q, kMinPointScore);
      ASSERT_NEAR(q, number(row, "q_seen") * number(row, "q_blur") * number(row, "q_res"), 1e-6);
      const bool delivered = !row.at("delivered_at_s").empty();
      if (delivered) {
        ASSERT_GT(number(row, "delivered_at_s"), number(row, "time_s"));
      }
      if (delivered && !collided.contains(row.at("uav"))) best[point] = std::max(best[point], q);
      if (!row.at("reason").empty()) continue;
      EXPECT_TRUE(delivered) << "a capture counts although it was not delivered: point " << point;
      EXPECT_TRUE(counted.insert(point).second) << "two captures count for point " << point;
    }
    const auto points = csv("score.csv");
    double sum = 0.0;
    for (const auto& [point, q] : best) {
      sum += q;
      EXPECT_NEAR(q, number(points.at(static_cast<std::size_t>(point)), "score"), 1e-8) << "point " << point;
      EXPECT_TRUE(counted.contains(point)) << "no capture counts for point " << point;
    }
    EXPECT_NEAR(sum, score(), kSumTolerance);
    EXPECT_EQ(best.size(), result_["points_detected"].get<std::size_t>());
  }

  /// Every point's loss has one cause; the sums over the lines are those in result.json.
  void check_losses() const {
    SCOPED_TRACE("losses.csv");
    ASSERT_TRUE(result_["losses"].is_object()) << result_["warnings"];
    std::map<std::string, std::pair<std::size_t, double>> sums, parts;
    double estimate = 0.0, scored = 0.0;
    std::size_t attainable = 0;
    for (const Row& row : csv("losses.csv")) {
      EXPECT_EQ(number(row, "loss"), number(row, "estimate") - number(row, "score"));
      estimate += number(row, "estimate");
      scored += number(row, "score");
      attainable += number(row, "estimate") > 0.0;
      auto& [points, score] = sums[row.at("cause")];
      ++points;
      score += number(row, "loss");
      EXPECT_EQ(row.at("part").empty(), row.at("cause") != "below_threshold");
      if (row.at("part").empty()) continue;
      ++parts[row.at("part")].first;
      parts[row.at("part")].second += number(row, "loss");
      if (row.at("part") == "unsplit") continue;
      EXPECT_LT(number(row, "q"), kMinPointScore);
      EXPECT_LE(number(row, "q_" + row.at("part")),
                std::min({number(row, "q_distance"), number(row, "q_tilt"), number(row, "q_blur")}));
    }
    EXPECT_EQ(estimate, result_["attainable"]["score"].get<double>());
    EXPECT_EQ(attainable, result_["attainable"]["points"].get<std::size_t>());
    EXPECT_EQ(scored, score());
    for (const auto& [cause, sum] : result_["losses"].items()) {
      EXPECT_EQ(sums[cause].first, sum["points"].get<std::size_t>()) << cause;
      EXPECT_EQ(sums[cause].second, sum["score"].get<double>()) << cause;
    }
    for (const auto& [part, sum] : result_["losses"]["below_threshold"]["by_part"].items()) {
      EXPECT_EQ(parts[part].first, sum["points"].get<std::size_t>()) << part;
      EXPECT_EQ(parts[part].second, sum["score"].get<double>()) << part;
    }
    EXPECT_GT(result_["losses"]["never_in_picture"]["points"], 0);
  }

  void check_steps() const {
    SCOPED_TRACE("digests.csv");
    const auto digests = csv("digests.csv");
    const double steps = result_["sim_time_s"].get<double>() / result_["exchange_period_s"].get<double>();
    ASSERT_EQ(digests.size(), static_cast<std::size_t>(std::lround(steps)) + 1);
    for (std::size_t k = 0; k < digests.size(); ++k) ASSERT_EQ(digests[k].at("k"), std::to_string(k));
    EXPECT_EQ(result_["digest"], digests.back().at("digest"));
  }

  void check_trajectories() const {
    SCOPED_TRACE("trajectories.csv");
    std::map<std::string, Row> before;
    for (const Row& row : csv("trajectories.csv")) {
      const auto [found, first] = before.try_emplace(row.at("uav"), row);
      if (first) continue;
      const double dt = number(row, "time_s") - number(found->second, "time_s");
      double squared = 0.0;
      for (const char* axis : {"x", "y", "z"}) squared += std::pow(number(row, axis) - number(found->second, axis), 2);
      ASSERT_NEAR(dt, 0.1, 1e-9);
      ASSERT_LT(std::sqrt(squared), kMaxSpeed * dt) << row.at("uav") << " at " << row.at("time_s");
      ASSERT_GT(number(row, "z"), 0.0);
      found->second = row;
    }
    EXPECT_EQ(before.size(), kFleet.size());
  }

  SkeinRun* run_ = nullptr;
  Json result_;
};

TEST_F(Results, AllFilesAgree) {
  check_result();
  check_scores();
  check_captures();
  check_losses();
  check_steps();
  check_trajectories();
}

}  // namespace
}  // namespace skein::test
