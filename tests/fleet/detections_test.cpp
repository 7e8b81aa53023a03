// The topics about interest points that programs of CARIC read: each UAV's log of detections, and the score at the
// ground station. A program that knows only the messages reads them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/topics.hpp"
#include "fleet_fixture.hpp"
#include "small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

constexpr int kWallColumns = 12, kWallRows = 5;
const std::vector<std::string> kSmallFleet = {"jurong", "changi"};
using Numbers = std::vector<double>;

class Detections : public FleetTest {
 protected:
  /// A wall of points in an order that does not reveal their positions.
  static SmallScene dense_scene() {
    SmallScene scene = default_scene();
    scene.points.clear();
    for (int i = 0; i < kWallColumns * kWallRows; ++i) {
      const int place = 37 * i % (kWallColumns * kWallRows);
      scene.points.push_back(
          {20.0, -4.5 + 0.8 * (place % kWallColumns), 2.0 + 1.9 * (place / kWallColumns), -1.0, 0.0, 0.0});
    }
    return scene;
  }

  void SetUp() override {
    const std::string scenario = write_small_scene(folder() / "small", dense_scene());
    // Slower than full speed, because a reader may match the writer a little earlier than the writer matches the
    // reader.
    run_ = &start("run",
                  {scenario, "--planner", "star", "--duration", "60", "--clock", "realtime:12", "--debug", "changi"});
    ASSERT_TRUE(run_->wait_for("gdb --args")) << run_->err();
    const int base = run_->domains().first;
    listen("gcs", "fastdds", gcs_domain(base), {topics::score(), topics::score_eval()});
    for (std::size_t i = 0; i < kSmallFleet.size(); ++i) {
      listen(kSmallFleet[i], "cyclonedds", uav_domain(base, UavIndex(i)), {topics::detected_points(kSmallFleet[i])});
    }
    // Meanwhile the fleet waits for changi's agent.
    for (const std::string name : {"gcs", "jurong", "changi"}) {
      ASSERT_TRUE(eventually([&] { return text_of(heard(name)).find("listening") != std::string::npos; })) << name;
    }
    start_program("agent", {"/bin/sh", "-c", run_->debug_command()});
    ASSERT_EQ(run_->exit_code(), 0) << run_->err();
    const Json scene = Json::parse(text_of(run_->dir() / "scene.json"));
    for (const Json& point : scene["points"]) scene_.push_back(point);
    ASSERT_EQ(scene_.size(), static_cast<std::size_t>(kWallColumns * kWallRows));
  }

  void listen(const std::string& name, const std::string& vendor, int domain,
              const std::vector<topics::WireTopic>& topics) {
    Arguments argv = {helper_program("cloud_listener"), vendor, std::to_string(domain), heard(name)};
    for (const topics::WireTopic& topic : topics) argv.insert(argv.end(), {topic.name, topic.type});
    start_program(name + "_listener", argv);
  }
  std::filesystem::path heard(const std::string& name) const { return folder() / (name + ".heard"); }

  /// The points of each sample of a topic: a list of numbers for each field.
  std::vector<Json> samples(const std::string& name, const topics::WireTopic& topic) const {
    std::istringstream lines(text_of(heard(name)));
    std::vector<Json> found;
    for (std::string line; std::getline(lines, line);) {
      const Json sample = Json::parse(line, nullptr, false);
      if (sample.is_object() && sample.value("topic", "") == topic.name) found.push_back(sample["points"]);
    }
    return found;
  }

  /// Index in the scene of the point at this place; nullopt: there is none.
  std::optional<std::size_t> index_at(const Json& points, std::size_t i) const {
    const auto same = [&](const Numbers& point) {
      const char* names[] = {"x", "y", "z", "normal_x", "normal_y", "normal_z"};
      for (std::size_t c = 0; c < 6; ++c) {
        if (std::abs(points[names[c]][i].get<double>() - point[c]) > 1e-5) return false;
      }
      return true;
    };
    const auto point = std::find_if(scene_.begin(), scene_.end(), same);
    return point == scene_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(point - scene_.begin()));
  }

  static std::vector<std::string> names_of(const Json& columns) {
    std::vector<std::string> names;
    for (const auto& [name, values] : columns.items()) names.push_back(name);
    return names;  // sorted
  }

  void check_log(const std::string& uav) const;
  void check_score(const std::vector<Json>& clouds, bool with_indices) const;

  SkeinRun* run_ = nullptr;
  std::vector<Numbers> scene_;  ///< x y z nx ny nz, by index
};

void Detections::check_log(const std::string& uav) const {
  SCOPED_TRACE(uav);
  const std::vector<Json> logs = samples(uav, topics::detected_points(uav));
  ASSERT_GT(logs.size(), 20U);
  std::vector<std::size_t> order;  // indices in the scene, in the order of detection
  Numbers best;
  for (const Json& log : logs) {
    ASSERT_EQ(names_of(log),
              (std::vector<std::string>{"curvature", "intensity", "normal_x", "normal_y", "normal_z", "x", "y", "z"}));
    const std::size_t size = log["x"].size();
    ASSERT_GE(size, order.size()) << "the log shrank";
    for (std::size_t i = 0; i < size; ++i) {
      ASSERT_EQ(log["curvature"][i], static_cast<double>(i)) << "the numbers of detections have a gap";
      const auto index = index_at(log, i);
      ASSERT_TRUE(index) << "not a point of the scene: " << log["x"][i] << ' ' << log["y"][i] << ' ' << log["z"][i];
      const double score = log["intensity"][i];
      if (i < order.size()) {
        ASSERT_EQ(order[i], *index) << "a detection has another number than before";
        ASSERT_GE(score, best[i]) << "the best score of a point decreased";
        best[i] = score;
      } else {
        ASSERT_EQ(std::count(order.begin(), order.end(), *index), 0) << "twice the same point";
        order.push_back(*index);
        best.push_back(score);
      }
      ASSERT_GE(score, 0.2 - 1e-6);
    }
  }
  EXPECT_GT(logs.back()["x"].size(), logs.front()["x"].size()) << "the log did not grow";
  std::size_t by_chance = 0;
  for (std::size_t i = 0; i < order.size(); ++i) by_chance += order[i] == i;
  EXPECT_LT(by_chance, order.size() / 2)
      << "the order of detections is that of indices in the scene, which UAVs must not know";
  // The referee's record of this UAV equals the log that the UAV received.
  std::map<std::size_t, double> audit;
  for (const auto& row : read_csv(run_->dir() / "captures.csv")) {
    if (row.at("uav") == uav) {
      double& q = audit[std::stoul(row.at("point"))];
      q = std::max(q, std::stod(row.at("q")));
    }
  }
  ASSERT_EQ(audit.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_NEAR(audit.at(order[i]), best[i], 1e-6);
}

void Detections::check_score(const std::vector<Json>& clouds, bool with_indices) const {
  SCOPED_TRACE(with_indices ? "/score_eval" : "/gcs/score");
  ASSERT_GT(clouds.size(), 5U);
  std::vector<std::string> names = {"normal_x", "normal_y", "normal_z", "score", "x", "y", "z"};
  if (with_indices) names.insert(names.begin(), "global_index");
  std::map<std::size_t, double> before;
  for (const Json& cloud : clouds) {
    ASSERT_EQ(names_of(cloud), names);
    std::map<std::size_t, double> now;
    for (std::size_t i = 0; i < cloud["x"].size(); ++i) {
      const auto index = index_at(cloud, i);
      ASSERT_TRUE(index) << "not a point of the scene";
      if (with_indices) {
        ASSERT_EQ(cloud["global_index"][i], static_cast<double>(*index));
      }
      ASSERT_TRUE(now.emplace(*index, cloud["score"][i]).second) << "twice the same point";
      ASSERT_GT(now[*index], 0.0) << "a point without score is listed";
    }
    ASSERT_NE(now, before) << "the score was published although it had not changed";
    for (const auto& [index, score] : before)
      ASSERT_GE(now[index], score) << "a point lost score although no UAV collided";
    before = now;
  }
  for (const auto& row : read_csv(run_->dir() / "score.csv")) {
    const double score = std::stod(row.at("score"));
    const auto told = before.find(std::stoul(row.at("index")));
    EXPECT_EQ(told != before.end(), score > 0.0);
    if (told != before.end()) {
      EXPECT_NEAR(told->second, score, 1e-6);
    }
  }
}

TEST_F(Detections, LogsAndScoreAgreeWithTheFilesOfTheRun) {
  EXPECT_TRUE(run_->result()["collisions"].empty());
  for (const std::string& uav : kSmallFleet) check_log(uav);
  const std::vector<Json> score = samples("gcs", topics::score()), judged = samples("gcs", topics::score_eval());
  EXPECT_EQ(score.size(), judged.size());
  check_score(score, false);
  check_score(judged, true);
  EXPECT_GT(run_->result()["score"], 0.0);
}

}  // namespace
}  // namespace skein::test
