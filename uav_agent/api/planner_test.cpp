#include "uav_agent/api/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "uav_agent/onboard/agent.hpp"

namespace skein::agent {
namespace {

AgentConfig lone_explorer() {
  AgentConfig config;
  config.fleet.resize(1);
  config.fleet[0].name = "jurong";
  return config;
}

std::string message_of(const std::string& spec) {
  try {
    make_planner(spec, lone_explorer());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::filesystem::path write_file(const std::string& name, const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) / name;
  std::ofstream(path) << text;
  return path;
}

TEST(Planner, ShippedPlannersAreRegistered) {
  const auto names = planner_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const std::string name : {"hover", "patrol", "waypoints"}) {
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  }
}

TEST(Planner, TheErrorOfAWrongNameOrKeyNamesTheRightOne) {
  EXPECT_NE(message_of("patrool").find("patrol"), std::string::npos) << message_of("patrool");
  EXPECT_NE(message_of("zzzzzzzz").find("hover"), std::string::npos) << message_of("zzzzzzzz");
  EXPECT_NE(message_of("hover:heigth_m=3").find("height_m"), std::string::npos) << message_of("hover:heigth_m=3");
  EXPECT_NE(message_of("hover:height_m=-3").find("height_m"), std::string::npos);
  EXPECT_NE(message_of("hover:height_m=high").find("height_m"), std::string::npos);
  EXPECT_EQ(message_of("hover:height_m=5,climb_mps=2"), "no error");
}

TEST(Planner, ReadsParametersFromAFile) {
  EXPECT_EQ(message_of("patrol:" + write_file("patrol.yaml", "bottom: false\noverlap: 0.3\n").string()), "no error");
  EXPECT_NE(message_of("patrol:" + write_file("bad.yaml", "bottum: false\n").string()).find("bottom"),
            std::string::npos);
  EXPECT_NE(message_of("patrol:missing.yaml").find("missing.yaml"), std::string::npos);
}

TEST(Planner, WaypointsNamesTheUavThatIsNotInTheFleet) {
  const auto file = write_file("paths.yaml", "paths:\n  sentosa:\n    - {position: [1, 2, 3]}\n");
  EXPECT_NE(message_of("waypoints:" + file.string()).find("sentosa"), std::string::npos);
}

/// Flies an agent whose UAV follows its commands exactly.
std::vector<Vector3d> fly(const std::string& spec, double seconds_to_fly,
                          std::vector<GimbalCommand>* gimbal = nullptr) {
  const AgentConfig config = lone_explorer();
  Agent agent(config, make_planner(spec, config));
  AgentInput input;
  std::vector<Vector3d> track;
  for (input.k = 0; static_cast<double>(input.k) * 0.05 < seconds_to_fly; ++input.k, input.tick += 20) {
    const AgentOutput output = agent.step(input);
    if (output.trajectory) {
      input.state.p_WB = output.trajectory->p_WB;
      input.state.v_WB = output.trajectory->v_WB;
    }
    if (output.gimbal && gimbal) gimbal->push_back(*output.gimbal);
    track.push_back(input.state.p_WB);
  }
  return track;
}

TEST(HoverPlanner, ClimbsStraightUpAndStays) {
  const auto track = fly("hover:height_m=4,climb_mps=2", 10.0);
  for (const Vector3d& p : track) EXPECT_EQ(p.head<2>(), Vector2d::Zero());
  EXPECT_NEAR(track.back().z(), 4.0, 1e-9);
}

TEST(WaypointsPlanner, VisitsAllStopsLooksAndStays) {
  const auto file = write_file("tour.yaml",
                               "paths:\n  jurong:\n    - {position: [0, 0, 5]}\n"
                               "    - {position: [10, 0, 5], look_at: [10, 10, 5], stay_s: 2}\n"
                               "    - {position: [10, 0, 1], speed_mps: 1}\n");
  std::vector<GimbalCommand> gimbal;
  const auto track = fly("waypoints:" + file.string(), 40.0, &gimbal);
  const auto at_second = std::count_if(track.begin(), track.end(),
                                       [](const Vector3d& p) { return (p - Vector3d(10, 0, 5)).norm() < 0.01; });
  EXPECT_GE(at_second, 40) << "it stays for two seconds";
  EXPECT_NEAR((track.back() - Vector3d(10, 0, 1)).norm(), 0.0, 1e-9);
  ASSERT_FALSE(gimbal.empty());
  const bool looked = std::any_of(gimbal.begin(), gimbal.end(), [](const GimbalCommand& g) { return g.yaw > 1.4; });
  EXPECT_TRUE(looked) << "it looks to the left at the end of the second leg";
}

}  // namespace
}  // namespace skein::agent
