#include "core/scenario/conditions.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/scenario/scenario_reader.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

class ConditionsFile : public ::testing::Test {
 protected:
  /// A scenario with this text in it.
  Scenario load(const std::string& conditions, const std::optional<std::string>& option = {}) const {
    std::ofstream(file_) << "desired_mm_per_pixel: 2.0\n"
                         << conditions
                         << "scene: {family: towers}\n"
                            "fleet: [{name: a, vehicle: explorer}]\n";
    return load_scenario(file_, {.conditions = option});
  }
  std::string complaint(const std::string& conditions, const std::optional<std::string>& option = {}) const {
    try {
      load(conditions, option);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "windy.yaml";
};

TEST_F(ConditionsFile, AreOffByDefaultAndNotPrintedThen) {
  const Scenario scenario = load("");
  EXPECT_FALSE(scenario.conditions.on());
  EXPECT_EQ(conditions_text(scenario.conditions), "none");
  EXPECT_EQ(to_yaml(scenario).find("conditions"), std::string::npos);
}

TEST_F(ConditionsFile, ASectionBeginsWithItsPresetAndOneKeyMayDiffer) {
  const Scenario scenario =
      load("conditions: {preset: breezy, wind: {preset: harsh, mean_mps: 8}, battery: {reserve: 0.3}}\n");
  const ConditionsConfig& conditions = scenario.conditions;
  EXPECT_EQ(conditions.wind.mean_mps, 8.0);
  EXPECT_EQ(conditions.wind.turbulence, conditions_preset("harsh").wind.turbulence);
  EXPECT_EQ(conditions.battery.endurance_missions, conditions_preset("breezy").battery.endurance_missions);
  EXPECT_EQ(conditions.battery.reserve, 0.3);
  EXPECT_EQ(conditions_text(conditions),
            "none,wind=own,odometry=breezy,battery=own,lidar=breezy,camera=breezy,radio=breezy");
}

TEST_F(ConditionsFile, PrintedConditionsReadBackUnchanged) {
  const Scenario scenario =
      load("conditions: {wind: {preset: harsh, from_deg: 30}, odometry: {preset: harsh, yaw_sigma_deg: 0}}\n");
  const std::string printed = to_yaml(scenario);
  std::ofstream(folder_.path() / "again.yaml") << printed;
  EXPECT_EQ(to_yaml(load_scenario(folder_.path() / "again.yaml")), printed);
}

TEST_F(ConditionsFile, BatteriesThatAPresetHasCanBeSwapped) {
  EXPECT_TRUE(load("conditions: {preset: breezy, battery: {swap_s: 60}}\n").conditions.battery.swaps());
  EXPECT_TRUE(load("conditions: {battery: {preset: harsh, swap_s: 60}}\n").conditions.battery.swaps());
}

TEST_F(ConditionsFile, KeysOfASectionThatIsOffMayHaveAnEffectLater) {
  EXPECT_EQ(complaint("conditions: {wind: {body_drag_area_m2: 0.1}}\n"), "") << "in a gust";
  EXPECT_EQ(complaint("conditions: {lidar: {full_range_m: 40}}\n"), "") << "during a fault";
  EXPECT_EQ(complaint("conditions: {wind: {mean_mps: 0, turbulence: 1}}\n"), "") << "in a study of the mean wind";
  EXPECT_EQ(complaint("conditions: {wind: {turbulence: 0}}\n"), "") << "the value of an exported scenario";
}

TEST_F(ConditionsFile, TheOptionReplacesWholeSections) {
  const std::string file = "conditions: {wind: {mean_mps: 3}, battery: {endurance_missions: 2}}\n";
  EXPECT_EQ(conditions_text(load(file, "none").conditions), "none");
  EXPECT_EQ(conditions_text(load(file, "harsh").conditions), "harsh");
  EXPECT_EQ(load(file, "harsh,wind=none").conditions.wind.mean_mps, 0.0);
  const ConditionsConfig some = load(file, "wind=harsh+odometry=breezy").conditions;
  EXPECT_EQ(some.wind.mean_mps, conditions_preset("harsh").wind.mean_mps);
  EXPECT_EQ(some.odometry.horizontal_sigma_m, conditions_preset("breezy").odometry.horizontal_sigma_m);
  EXPECT_EQ(some.battery.endurance_missions, 2.0) << "the section of the file stays";
  EXPECT_EQ(conditions_text(conditions_preset("breezy")), "breezy");
}

TEST(LidarSigma, HasTheValuesOfTheConditionsPage) {
  const LidarConditions breezy = conditions_preset("breezy").lidar;
  EXPECT_NEAR(lidar_sigma_m(breezy, 20.0, 0.0), 0.020, 1e-12);
  EXPECT_NEAR(lidar_sigma_m(breezy, 20.0, 1.0), 0.025, 1e-12);  // the noise grows by 1 and 0.75 mm per metre
  EXPECT_EQ(lidar_sigma_m(breezy, 20.0, 1e9), lidar_sigma_m(breezy, 20.0, kMostTanIncidence));
  EXPECT_TRUE(LidarConditions{.divergence_mrad = 1.0}.on());
}

struct BadValue {
  const char *text, *option, *names;
};
class BadConditions : public ConditionsFile, public ::testing::WithParamInterface<BadValue> {};

TEST_P(BadConditions, AreRefusedWithTheirPlace) {
  const BadValue& bad = GetParam();
  const std::string text =
      complaint(bad.text, *bad.option == 0 ? std::nullopt : std::optional<std::string>(bad.option));
  EXPECT_NE(text.find(bad.names), std::string::npos) << text;
  const bool of_file = *bad.option == 0;
  EXPECT_EQ(text.find("windy.yaml:2: ") != std::string::npos, of_file) << text;
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadConditions,
    ::testing::Values(BadValue{"conditions: {preset: stormy}\n", "", "preset: must be one of none, breezy, harsh"},
                      BadValue{"conditions: {wind: {preset: gale}}\n", "", "wind.preset: must be one of"},
                      BadValue{"conditions: {wind: {mean_mps: -1}}\n", "", "wind.mean_mps: must be"},
                      BadValue{"conditions: {wind: {speed: 4}}\n", "", "wind.speed"},
                      BadValue{"conditions: {odometry: {latency_s: 2}}\n", "", "odometry.latency_s: must be"},
                      BadValue{"conditions: {odometry: {yaw_sigma_deg: .nan}}\n", "", "odometry.yaw_sigma_deg"},
                      BadValue{"conditions: {battery: {endurance_missions: 0}}\n", "", "endurance_missions: must be"},
                      BadValue{"conditions: {battery: {efficiency: 1.2}}\n", "", "battery.efficiency: must be"},
                      BadValue{"conditions: {battery: {swap_s: 0}}\n", "", "battery.swap_s: must be"},
                      BadValue{"conditions: {lidar: {clutter_p: 1}}\n", "", "lidar.clutter_p: must be"},
                      BadValue{"conditions: {lidar: {divergence_mrad: 21}}\n", "", "divergence_mrad: must be"},
                      BadValue{"conditions: {camera: {exposure_factor: 0}}\n", "", "exposure_factor: must be"},
                      BadValue{"conditions: {radio: {exponent: 9}}\n", "", "radio.exponent: must be"},
                      BadValue{"conditions: {battery: {swap_s: 5}}\n", "", "battery.swap_s: needs endurance_missions"},
                      BadValue{"conditions: {wind: {turbulence: 2}}\n", "", "wind.turbulence: needs mean_mps"},
                      BadValue{"conditions: {odometry: {walk_m_per_sqrt_s: 1}}\n", "", "sqrt_s: needs an error"},
                      BadValue{"conditions: {battery: {preset: none, reserve: 0.3}}\n", "", "reserve: needs endurance"},
                      BadValue{"conditions: {radio: {power_dbm: 3}}\n", "", "radio.power_dbm: needs exponent"},
                      BadValue{"conditions: {odometry: {latency_s: 0.01}}\n", "", "latency_s: must be 0, or at least"},
                      BadValue{"", "wind=breezy,wind=harsh", "--conditions: the section 'wind' is named twice"},
                      BadValue{"", "breezy+harsh", "--conditions: 'harsh' is for all sections"},
                      BadValue{"", "wind=harsh,breezy", "--conditions: 'breezy' is for all sections"},
                      BadValue{"", "windy", "--conditions: there is no preset 'windy'"},
                      BadValue{"", "wind=", "--conditions: there is no preset ''"},
                      BadValue{"", "rain=harsh", "--conditions: there is no section 'rain'"}));

}  // namespace
}  // namespace skein
