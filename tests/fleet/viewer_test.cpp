// Viewers in the world domain: the shown data are those of the run, and the run is the same with a viewer, with a
// viewer that stops reading, and without one.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <sstream>
#include <stdexcept>

#include "core/topics.hpp"
#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

using Numbers = std::vector<double>;
/// From 10 s to 40 s no UAV has a link to the station: so long that a viewer on a busy machine sees a part of it.
constexpr double kOutageBegins_s = 10.0, kOutageEnds_s = 40.0;
constexpr double kPeriod_s = 0.1, kExchange_s = 0.05;

/// The DDS vendors of fleet and viewer.
struct Vendors {
  std::string fleet, viewer;
};

class Viewer : public FleetTest, public testing::WithParamInterface<Vendors> {
 protected:
  Arguments flight() const {
    return {"towers",
            "--planner",
            "patrol",
            "--stop-at",
            "60",
            "--faults",
            write("outage.yaml", "faults:\n  - {at_s: 10, until_s: 40, station_outage: true}\n")};
  }
  /// Flies a run that a viewer has matched before its begin. @param signal  sent to the viewer then; 0: none.
  SkeinRun& run_with_viewer(int signal = 0) {
    Arguments arguments = flight();
    arguments.insert(arguments.end(), {"--dds", GetParam().fleet, "--debug", "changi"});
    SkeinRun& run = start("seen", arguments);
    if (!run.wait_for("gdb --args")) throw std::runtime_error(run.err());
    ChildProcess& viewer = start_program("viewer", {helper_program("viz_listener"), GetParam().viewer,
                                                    std::to_string(world_domain(run.domains().first)), heard()});
    EXPECT_TRUE(eventually([&] { return text_of(heard()).find("listening") != std::string::npos; }));
    if (signal != 0) viewer.signal(signal);
    start_program("agent", {"/bin/sh", "-c", run.debug_command()});
    EXPECT_EQ(run.exit_code(), 0) << run.err();
    viewer.signal(SIGKILL);  // otherwise it would also see the next run in these domains
    return run;
  }
  std::filesystem::path heard() const { return folder() / "heard"; }

  void read_samples() {
    std::istringstream lines(text_of(heard()));
    for (std::string line; std::getline(lines, line);) {
      Json sample = Json::parse(line, nullptr, false);
      if (sample.is_object() && sample.contains("topic")) samples_[sample["topic"]].push_back(std::move(sample));
    }
  }

  static void expect_untouched(const SkeinRun& seen, const SkeinRun& alone) {
    EXPECT_EQ(seen.digest(), alone.digest());
    const Json result = seen.result();
    EXPECT_TRUE(result["deterministic"]);
    EXPECT_EQ(result["warnings"], alone.result()["warnings"]);
    EXPECT_EQ(result["radio"]["unsent"], 0);
  }

  void expect_where_they_were(const SkeinRun& run) const;
  void expect_lines_between_nodes() const;
  void expect_growing_map() const;
  void expect_delivered_points(const SkeinRun& run) const;

  std::map<std::string, std::vector<Json>> samples_;  ///< by topic
};

double distance(const Json& a, const Json& b) {
  return std::hypot(a[0].get<double>() - b[0].get<double>(), a[1].get<double>() - b[1].get<double>(),
                    a[2].get<double>() - b[2].get<double>());
}

void Viewer::expect_where_they_were(const SkeinRun& run) const {
  std::size_t compared = 0;
  std::map<long, const Json*> by_exchange;
  for (const Json& sample : samples_.at("/tf")) {
    by_exchange[std::lround(sample["stamp"].get<double>() / kExchange_s)] = &sample["frames"];
  }
  for (const auto& row : read_csv(run.dir() / "trajectories.csv")) {
    const auto frames = by_exchange.find(std::lround(std::stod(row.at("time_s")) / kExchange_s));
    if (frames == by_exchange.end()) continue;
    const Json& frame = frames->second->at(row.at("uav") + "/base_link");
    EXPECT_EQ(frame["parent"], "world");
    EXPECT_LT(distance(frame["position"], {std::stod(row.at("x")), std::stod(row.at("y")), std::stod(row.at("z"))}),
              1e-3);
    ++compared;
  }
  EXPECT_GT(compared, kFleet.size() * samples_.at("/tf").size() / 3);
}

void Viewer::expect_lines_between_nodes() const {
  std::map<double, std::vector<Json>> places;
  for (const Json& fleet : samples_.at("/viz/fleet")) {
    std::set<std::string> names;
    for (const Json& marker : fleet["markers"]) {
      if (marker["text"] == "") {
        places[fleet["stamp"]].push_back(marker["position"]);
      } else {
        names.insert(marker["text"]);
      }
    }
    std::set<std::string> expected(kFleet.begin(), kFleet.end());
    expected.insert("gcs");
    EXPECT_EQ(names, expected);
  }
  std::map<bool, std::size_t> lines, with_station;  ///< by whether the station has its outage
  for (const Json& links : samples_.at("/viz/links")) {
    const auto known = places.find(links["stamp"]);
    if (known == places.end()) continue;
    const bool out = links["stamp"] >= kOutageBegins_s - 1e-6 && links["stamp"] < kOutageEnds_s - 1e-6;
    for (const Json& end : links["points"]) {
      ++lines[out];
      with_station[out] += distance(known->second[0], end) < 1e-9;
      EXPECT_TRUE(std::ranges::any_of(known->second, [&](const Json& p) { return distance(p, end) < 1e-9; })) << end;
    }
  }
  EXPECT_GT(with_station[false], 0U);
  EXPECT_EQ(with_station[true], 0U) << "links of the station are shown during its outage";
  EXPECT_GT(lines[true], 0U) << "no links of other nodes are shown during the outage";
}

void Viewer::expect_growing_map() const {
  std::size_t before = 0;
  for (const Json& map : samples_.at("/viz/map")) {
    std::set<std::vector<long>> cells;
    for (const Json& p : map["points"]) {
      cells.insert({std::lround(std::floor(2.0 * p[0].get<double>())),
                    std::lround(std::floor(2.0 * p[1].get<double>())),
                    std::lround(std::floor(2.0 * p[2].get<double>()))});
    }
    EXPECT_EQ(cells.size(), map["points"].size()) << "a cell of the map has more than one point";
    EXPECT_TRUE(before < cells.size()) << "the map did not grow";
    before = cells.size();
  }
  EXPECT_GT(before, 100U);
}

void Viewer::expect_delivered_points(const SkeinRun& run) const {
  const Json scene = Json::parse(text_of(run.dir() / "scene.json"))["points"];
  std::vector<std::pair<Json, double>> scores;
  for (const auto& row : read_csv(run.dir() / "score.csv")) {
    scores.emplace_back(scene[std::stoul(row.at("index"))], std::stod(row.at("score")));
  }
  std::size_t shown = 0;
  for (const Json& scored : samples_.at("/viz/scored")) {
    for (const Json& point : scored["points"]) {
      ++shown;
      EXPECT_TRUE(std::ranges::any_of(scores,
                                      [&](const auto& one) {
                                        return distance(one.first, point) < 1e-3 &&
                                               point[3].get<double>() <= one.second + 1e-6;
                                      }))
          << point << " was not delivered";
      EXPECT_GT(point[3], 0.0);
      EXPECT_LE(point[3], 1.0);
    }
  }
  EXPECT_GT(shown, 0U);
}

TEST_P(Viewer, SeesTheRunAsItIsAndDoesNotChangeIt) {
  SkeinRun& seen = run_with_viewer();
  SkeinRun& alone = run("alone", flight());
  expect_untouched(seen, alone);
  read_samples();
  for (const topics::TopicInfo& topic : topics::viewer_topics()) {
    const std::string name(topic.pattern);
    ASSERT_FALSE(samples_[name].empty()) << name;
    if (topic.latched) continue;
    const std::vector<Json>& samples = samples_[name];
    EXPECT_GT(samples.back()["stamp"], 20.0) << name;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      EXPECT_GT(samples[i]["stamp"].get<double>() - samples[i - 1]["stamp"].get<double>(), kPeriod_s - 1e-6) << name;
    }
  }
  for (const char* once : {"/viz/structure", "/viz/boxes", "/tf_static"}) EXPECT_EQ(samples_[once].size(), 1U) << once;
  EXPECT_FALSE(samples_["/viz/structure"][0]["points"].empty());
  EXPECT_EQ(samples_["/tf_static"][0]["frames"].size(), kFleet.size() + 1);
  expect_where_they_were(seen);
  expect_lines_between_nodes();
  expect_growing_map();
  expect_delivered_points(seen);
}

TEST_P(Viewer, DelaysNoProgramWhileItIsStopped) {
  SkeinRun& seen = run_with_viewer(SIGSTOP);
  expect_untouched(seen, run("alone", flight()));
}

INSTANTIATE_TEST_SUITE_P(Pairs, Viewer,
                         testing::Values(Vendors{"cyclonedds", "fastdds"}, Vendors{"fastdds", "cyclonedds"}),
                         [](const auto& pair) { return pair.param.fleet + "_to_" + pair.param.viewer; });

}  // namespace
}  // namespace skein::test
