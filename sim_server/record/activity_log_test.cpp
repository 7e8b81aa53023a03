#include "sim_server/record/activity_log.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"

namespace skein::sim {
namespace {

class ActivityLogTest : public testing::Test {
 protected:
  ActivityLogTest() {
    for (const char* name : {"jurong", "changi"}) {
      const double y = 3.0 * static_cast<double>(scenario_.fleet.size());
      scenario_.fleet.push_back(
          {.name = name, .vehicle = load_vehicle("photographer", source_path("config")), .start = {0, y}});
    }
  }
  ~ActivityLogTest() override { std::filesystem::remove_all(folder_); }

  std::string text() const {
    std::ostringstream text;
    text << std::ifstream(folder_ / "activity.csv").rdbuf();
    return text.str();
  }

  const std::filesystem::path folder_ = [] {
    std::string name = std::filesystem::path(testing::TempDir()) / "skein_activity_XXXXXX";
    return std::filesystem::path(::mkdtemp(name.data()));
  }();
  Scenario scenario_;
};

TEST_F(ActivityLogTest, TheLogHasALineForEachNewActivityAndIgnoresChangedNumbers) {
  constexpr UavIndex kJurong{0}, kChangi{1};
  Simulation simulation(scenario_, {}, 0);
  const std::string head = "step,time_s,uav,mode,goal_x,goal_y,goal_z,waits_for,no_way\n";
  ActivityLog log(folder_, scenario_);
  EXPECT_EQ(text(), head) << "the log writes the head at once, so that the table is complete even if the server is "
                             "killed before the first row";
  Activity activity{.mode = "takes off", .goal_W = Vector3d(1.0, 2.25, -0.5)};
  EXPECT_TRUE(log.add(simulation, kJurong, activity));
  EXPECT_TRUE(log.add(simulation, kChangi, {.mode = "on the ground", .waits_for = "jurong", .no_way = "no way"}));
  simulation.advance();
  activity.speed_mps = 3.0;
  activity.undelivered = 2;
  activity.cpu_s = 1.5;
  EXPECT_FALSE(log.add(simulation, kJurong, activity)) << "only the numbers differ";
  activity.goal_W.reset();
  EXPECT_TRUE(log.add(simulation, kJurong, activity));
  EXPECT_FALSE(log.add(simulation, kJurong, activity));
  log.file().flush();
  EXPECT_EQ(text(), head +
                        "0,0.00,jurong,takes off,1.00,2.25,-0.50,,\n0,0.00,changi,on the ground,,,,jurong,no way\n"
                        "1,0.05,jurong,takes off,,,,,\n");
}

}  // namespace
}  // namespace skein::sim
