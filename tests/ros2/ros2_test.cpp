// ROS 2 nodes with default settings beside a fleet on the same host: what they receive, and the effects of their
// messages. Real nodes (rclpy) on either middleware, and fleets with either vendor.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/topics.hpp"
#include "ros2_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

constexpr double kExchange_s = 0.05;
const std::string kUav = "jurong";  // an explorer, with a LiDAR
const Arguments kFlight = {"towers", "--stop-at", "40", "--duration", "60"};

class Ros2 : public Ros2Test, public testing::WithParamInterface<std::string> {
 protected:
  ChildProcess& start_listener(const std::string& name, const std::string& middleware, int domain,
                               const std::string& localhost = "") {
    return start_node(name, middleware, domain, localhost,
                      "python3 " + source_path("tests/ros2/listener.py") + " " + kUav + " " + file(name));
  }

  /// Expects a listener to have received all messages from some time on, because a writer may match it only during the
  /// flight, and the messages to agree with the run's files.
  void expect_all_heard(const SkeinRun& run, const std::string& listener) const {
    SCOPED_TRACE(listener);
    const Json heard = Json::parse(text_of(file(listener)));
    const std::size_t steps = read_csv(run.dir() / "digests.csv").size();
    const Json& odometry = heard["odometry"];
    ASSERT_GT(odometry.size(), steps / 4);
    for (std::size_t i = 1; i < odometry.size(); ++i) {
      ASSERT_NEAR(odometry[i][0].get<double>() - odometry[i - 1][0].get<double>(), kExchange_s, 1e-6)
          << "the listener missed a message";
    }
    const double first_s = odometry.front()[0], last_s = odometry.back()[0];
    EXPECT_GT(last_s, (static_cast<double>(steps) - 20.0) * kExchange_s)
        << "the listener missed more than the last messages of the flight";
    EXPECT_GT(heard["clocks"], steps / 4);
    EXPECT_GT(heard["clouds"].size(), odometry.size() / 4);
    std::size_t compared = 0;
    for (const auto& row : read_csv(run.dir() / "trajectories.csv")) {
      const double t = std::stod(row.at("time_s"));
      if (row.at("uav") != kUav || t < first_s - 1e-6 || t > last_s + 1e-6) continue;
      const auto sample = std::find_if(heard["odometry"].begin(), heard["odometry"].end(),
                                       [&](const Json& s) { return std::abs(s[0].get<double>() - t) < 1e-6; });
      ASSERT_NE(sample, heard["odometry"].end()) << t;
      const std::array<const char*, 3> axes = {"x", "y", "z"};
      for (std::size_t i = 0; i < axes.size(); ++i) {
        EXPECT_NEAR((*sample)[i + 1].get<double>(), std::stod(row.at(axes[i])), 1e-4) << t;
      }
      ++compared;
    }
    EXPECT_GT(compared, odometry.size() / 3);
    std::size_t most_points = 0;  // a scan far from all structure has no points
    for (const Json& cloud : heard["clouds"]) {
      most_points = std::max(most_points, cloud[1].get<std::size_t>());
      EXPECT_EQ(cloud[2], Json({"x", "y", "z", "intensity"}));
    }
    EXPECT_GT(most_points, 100U);
    EXPECT_EQ(heard["types"]["/" + kUav + "/ground_truth/odometry"], Json({"nav_msgs/msg/Odometry"}));
    EXPECT_EQ(heard["types"]["/" + kUav + "/command/trajectory"],
              Json({"trajectory_msgs/msg/MultiDOFJointTrajectory"}));
    EXPECT_EQ(heard["types"]["/clock"], Json({"rosgraph_msgs/msg/Clock"}));
  }
};

TEST_P(Ros2, NodesWithDefaultSettingsHearAUavAndTheLauncherReportsIgnoredCommands) {
  SkeinRun& fleet = start("fleet", joined(kFlight, {"--dds", GetParam(), "--debug", kUav}));
  ASSERT_TRUE(fleet.wait_for("gdb --args")) << fleet.err();
  const int domain = fleet.domains().first + 2;
  const std::vector<std::string> listeners = {"cyclonedds", "fastrtps", "cyclonedds_localhost", "fastrtps_localhost"};
  std::vector<ChildProcess*> nodes;
  for (const std::string& name : listeners) {
    const std::size_t end = name.find('_');
    nodes.push_back(&start_listener(name, name.substr(0, end), domain, end == std::string::npos ? "" : "localhost"));
  }
  ChildProcess& commander =
      start_node("commander", GetParam() == "fastdds" ? "cyclonedds" : "fastrtps", domain, "",
                 "python3 " + source_path("tests/ros2/commander.py") + " " + kUav + " " + file("commander"));
  const topics::WireTopic rejected = topics::command_rejected(kUav);
  start_program("rejections", {helper_program("radio_listener"), GetParam(), std::to_string(domain),
                               folder() / "rejections", rejected.name, rejected.type});
  ASSERT_TRUE(eventually([&] {
    return ready("commander") &&
           std::all_of(listeners.begin(), listeners.end(), [&](const auto& name) { return ready(name); });
  })) << fleet.err();
  ASSERT_TRUE(eventually([&] { return text_of(folder() / "rejections").find(" 1 0") != std::string::npos; }));
  start_agent(fleet);
  ASSERT_EQ(fleet.exit_code(), 0) << fleet.err();
  for (ChildProcess* node : nodes) EXPECT_EQ(node->wait().code, 0) << node->err();
  commander.signal(SIGKILL);

  for (const std::string& name : listeners) expect_all_heard(fleet, name);
  const Json result = fleet.result();
  EXPECT_TRUE(result["deterministic"]);
  EXPECT_EQ(fleet.digest(), run("alone", kFlight).digest()) << "programs outside the fleet changed the run";

  EXPECT_GT(result["uavs"][0]["commands_unheard"], 0);
  EXPECT_EQ(result["uavs"][1]["commands_unheard"], 0);
  const std::string word =
      kUav + ": samples on /" + kUav + "/command/trajectory are ignored: the sender does not take part";
  EXPECT_NE(fleet.err().find(word), std::string::npos) << "the launcher must print this during the flight";
  const auto told = [&](const std::string& text) {
    return std::count_if(result["warnings"].begin(), result["warnings"].end(),
                         [&](const Json& w) { return w.get<std::string>().find(text) != std::string::npos; });
  };
  EXPECT_EQ(told(word), 1) << "one warning for all ignored commands";
  EXPECT_GT(result["radio"]["unheard"], 0);
  EXPECT_EQ(told(kUav + ": samples on /plan are ignored: the sender does not take part"), 1);
  EXPECT_NE(text_of(folder() / "rejections").find(" 1\n"), std::string::npos)
      << "the ignored commands were not reported on command_rejected";
}

INSTANTIATE_TEST_SUITE_P(Vendors, Ros2, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

}  // namespace
}  // namespace skein::test
