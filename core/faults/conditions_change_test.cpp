// Conditions that faults change for a time: the values at each time, and the messages about invalid changes.
#include "core/faults/conditions_change.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/faults/fault_writer.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

class ConditionsChanges : public testing::Test {
 protected:
  ConditionsChanges() {
    scenario_.name = "small";
    scenario_.duration_s = 300.0;
    UavConfig uav;
    uav.name = "changi";
    scenario_.fleet.push_back(uav);
    scenario_.conditions = conditions_preset("breezy");
  }

  const FaultPlan& load(const std::string& faults) {
    const std::filesystem::path file = folder_.path() / "faults.yaml";
    std::ofstream(file) << "faults:\n" << faults;
    plan_ = load_fault_plan(file, scenario_);
    return plan_;
  }
  ConditionsConfig at(double time_s) const {
    return changed_conditions(plan_, scenario_, active_changes(plan_, ticks(time_s)));
  }
  void refused(const std::string& fault, const std::string& words) {
    try {
      load("  - {at_s: 1, " + fault + "}\n");
      ADD_FAILURE() << "accepted: " << fault;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("faults.yaml:2: "), std::string::npos) << error.what();
    }
  }

  ScratchFolder folder_;
  Scenario scenario_;
  FaultPlan plan_;
};

TEST_F(ConditionsChanges, HoldFromTheirBeginToTheirEnd) {
  load("  - {at_s: 10, until_s: 20, conditions: {wind: {mean_mps: 12}, lidar: {clutter_p: 0.001}}}\n");
  for (const double before_or_after_s : {0.0, 9.9, 20.0, 300.0}) {
    EXPECT_TRUE(active_changes(plan_, ticks(before_or_after_s)).empty()) << before_or_after_s;
  }
  const ConditionsConfig now = at(15.0);
  EXPECT_EQ(now.wind.mean_mps, 12.0);
  EXPECT_EQ(now.lidar.clutter_p, 0.001);
  EXPECT_EQ(now.wind.turbulence, scenario_.conditions.wind.turbulence) << "the fault does not change the turbulence";
  EXPECT_EQ(now.camera.exposure_factor, scenario_.conditions.camera.exposure_factor);
}

TEST_F(ConditionsChanges, OfTwoChangesOfAValueTheLaterInTheFileWins) {
  load(
      "  - {at_s: 10, until_s: 30, conditions: {wind: {mean_mps: 12, turbulence: 2}}}\n"
      "  - {at_s: 5, until_s: 20, conditions: {wind: {mean_mps: 8}, radio: {power_dbm: 0}}}\n");
  EXPECT_EQ(at(7.0).wind.mean_mps, 8.0);
  EXPECT_EQ(at(15.0).wind.mean_mps, 8.0);
  EXPECT_EQ(at(15.0).wind.turbulence, 2.0);
  EXPECT_EQ(at(25.0).wind.mean_mps, 12.0);
  EXPECT_EQ(at(25.0).radio.power_dbm, scenario_.conditions.radio.power_dbm);
}

TEST_F(ConditionsChanges, APresetLeavesTheKeysThatCannotChangeDuringARun) {
  scenario_.conditions.wind.from_deg = 45.0;
  load("  - {at_s: 1, conditions: {preset: harsh}}\n");
  const ConditionsConfig now = at(2.0), harsh = conditions_preset("harsh"), &begun = scenario_.conditions;
  EXPECT_EQ(now.wind.mean_mps, harsh.wind.mean_mps);
  EXPECT_EQ(now.odometry.horizontal_sigma_m, harsh.odometry.horizontal_sigma_m);
  EXPECT_EQ(now.camera.vibration_deg_s, harsh.camera.vibration_deg_s);
  EXPECT_EQ(now.radio.exponent, harsh.radio.exponent);
  EXPECT_EQ(now.wind.from_deg, 45.0);
  EXPECT_EQ(now.odometry.latency_s, begun.odometry.latency_s);
  EXPECT_EQ(now.odometry.mean_fix_s, begun.odometry.mean_fix_s);
  EXPECT_EQ(now.battery.endurance_missions, begun.battery.endurance_missions);
}

TEST_F(ConditionsChanges, AnInvalidChangeIsRefusedWithItsKeyAndTheReason) {
  refused("conditions: {}", "must have values");
  refused("conditions: {camera: {}}", "faults[0].conditions.camera: changes nothing: give at least one value");
  refused("conditions: {wind: {mean_mps: 99}}", "faults[0].conditions.wind.mean_mps: must be a number within [0, 25]");
  refused("conditions: {wind: {meanmps: 9}}", "mean_mps");
  refused("conditions: {rain: {}}", "rain");
  refused("conditions: {odometry: {latency_s: 0.2}}",
          "faults[0].conditions.odometry.latency_s: cannot change in a run");
  refused("conditions: {battery: {endurance_missions: 0.2}}", "cannot change in a run");
  refused("conditions: {battery: {swap_s: 20}}", "cannot change in a run");
  refused("conditions: {radio: {exponent: ~}}", "cannot switch the path loss off");
  refused("fix_loss: raffles", "raffles");
  refused("battery_loss: {uav: changi, charge: 1}", "within [0, 0.999]");
  EXPECT_THROW(load("  - {at_s: 1, fix_loss: changi}\n  - {at_s: 2, fix_loss: changi}\n"), InputError)
      << "both faults act at once";
}

TEST_F(ConditionsChanges, NeedAnActiveSectionInTheScenario) {
  scenario_.conditions = conditions_preset("none");
  refused("conditions: {wind: {mean_mps: 9}}", "faults[0].conditions.wind: is off in the scenario");
  refused("conditions: {preset: harsh}", "is off in the scenario");
  refused("conditions: {radio: {power_dbm: 3}}", "faults[0].conditions.radio: is off in the scenario");
  EXPECT_NO_THROW(load("  - {at_s: 1, conditions: {wind: {body_drag_area_m2: 0.1}}}\n"))
      << "the drag area has an effect in gusts";
  refused("fix_loss: changi", "--conditions odometry=breezy");
  refused("battery_loss: {uav: changi, charge: 0.3}", "--conditions battery=breezy");
  load("  - {at_s: 1, conditions: {lidar: {reflectivity: 0.2}, camera: {exposure_factor: 4}}}\n");
  EXPECT_EQ(at(2.0).camera.exposure_factor, 4.0) << "these have no state";
  EXPECT_EQ(at(2.0).lidar.reflectivity, 0.2);
}

TEST_F(ConditionsChanges, AreWrittenAsTheyAreRead) {
  for (const char* line : {"{at_s: 10, until_s: 20, conditions: {wind: {mean_mps: 12}, lidar: {preset: harsh}}}",
                           "{at_s: 1, fix_loss: changi}", "{at_s: 1, battery_loss: {uav: changi, charge: 0.3}}"}) {
    EXPECT_EQ(fault_line(load("  - " + std::string(line) + "\n").faults.front()), line);
  }
}

}  // namespace
}  // namespace skein
