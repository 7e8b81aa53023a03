// Every configuration file in the tree loads; printed configuration can be read back; every invalid_*.yaml in this
// folder is refused with the messages in its "# expect:" lines. A new rule needs a new file, but no code.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/config/config_node.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/vehicle/airframe.hpp"
#include "tests/support/places.hpp"
#include "tests/support/text_files.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

const fs::path kConfig = source_path("config");
const fs::path kHere = source_path("tests/config");

std::vector<std::string> bad_files() {
  std::vector<std::string> names;
  for (const std::string& name : config_names(kHere)) {
    if (name.starts_with("invalid_")) names.push_back(name);
  }
  return names;
}

std::vector<std::string> expectations(const fs::path& file) {
  static const std::string mark = "# expect: ";
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line) && line.starts_with(mark);) {
    lines.push_back(line.substr(mark.size()));
  }
  return lines;
}

LoadOptions without_assets() {
  LoadOptions options;
  options.config_dir = kConfig;
  options.needs_scene_files = false;
  return options;
}

/// The configuration in the source tree.
class ConfigFolder {
 public:
  ConfigFolder() { ::setenv("SKEIN_CONFIG_DIR", kConfig.c_str(), 1); }
  ~ConfigFolder() { ::unsetenv("SKEIN_CONFIG_DIR"); }
};

std::string test_name(const ::testing::TestParamInfo<std::string>& parameter) { return parameter.param; }

class InvalidFile : public ::testing::TestWithParam<std::string> {};

TEST_P(InvalidFile, IsRefusedWithAUsefulMessage) {
  const fs::path file = kHere / (GetParam() + ".yaml");
  const auto expected = expectations(file);
  ASSERT_FALSE(expected.empty()) << file << " has no line \"# expect:\"";
  std::string message;
  try {
    if (GetParam().starts_with("invalid_vehicle_")) {
      load_vehicle(file.string(), kConfig);
    } else if (GetParam().starts_with("invalid_faults_")) {
      const ConfigFolder folder;
      load_fault_plan(file, load_scenario("towers", without_assets()));
    } else {
      LoadOptions options;
      options.config_dir = kConfig;
      load_scenario(file.string(), options);
    }
    FAIL() << "the file was accepted";
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find(file.filename().string()), std::string::npos) << message;
  for (const std::string& part : expected) EXPECT_NE(message.find(part), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(Config, InvalidFile, ::testing::ValuesIn(bad_files()), test_name);

class ShippedScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedScenario, LoadsAndIsNamedAfterItsFile) {
  const Scenario scenario = load_scenario(GetParam(), without_assets());
  EXPECT_EQ(scenario.name, GetParam());
  EXPECT_FALSE(scenario.description.empty());
  EXPECT_FALSE(scenario.fleet.empty());
}

TEST_P(ShippedScenario, IsTheSameWhenItIsPrintedAndReadAgain) {
  const Scenario scenario = load_scenario(GetParam(), without_assets());
  const std::string printed = to_yaml(scenario);
  const fs::path copy = fs::path(::testing::TempDir()) / ("skein_copy_of_" + GetParam() + ".yaml");
  std::ofstream(copy) << printed;
  EXPECT_EQ(to_yaml(load_scenario(copy.string(), without_assets())), printed);
  fs::remove(copy);
}

INSTANTIATE_TEST_SUITE_P(Config, ShippedScenario, ::testing::ValuesIn(config_names(kConfig / "scenarios")), test_name);

class ShippedVehicle : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedVehicle, LoadsAndNamesEveryKey) {
  const VehicleConfig vehicle = load_vehicle(GetParam(), kConfig);
  EXPECT_EQ(vehicle.name, GetParam());
  const std::string text = read_text(kConfig / "vehicles" / (GetParam() + ".yaml"));
  const ConfigDocument printed = parse_config_document(to_yaml(vehicle), "printed");
  for (const std::string& key : printed.root.keys) EXPECT_NE(text.find(key + ":"), std::string::npos) << key;
}

INSTANTIATE_TEST_SUITE_P(Config, ShippedVehicle, ::testing::ValuesIn(config_names(kConfig / "vehicles")), test_name);

TEST(ShippedConfig, HasTheVehiclesAndScenariosThatUsersExpect) {
  EXPECT_EQ(config_names(kConfig / "vehicles"), (std::vector<std::string>{"explorer", "photographer"}));
  for (const char* name : {"mbs.yaml", "crane.yaml", "towers.yaml"}) {
    EXPECT_TRUE(fs::exists(kConfig / "scenarios" / name)) << name;
  }
}

TEST(ShippedConfig, MbsAndCraneFindTheOfficialData) {
  if (!std::getenv("SKEIN_ASSETS")) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  LoadOptions options;
  options.config_dir = kConfig;
  for (const char* name : {"mbs", "crane"}) {
    const Scenario scenario = load_scenario(name, options);
    EXPECT_TRUE(fs::exists(scenario.scene.points));
    EXPECT_TRUE(fs::exists(scenario.scene.boxes));
    for (const fs::path& mesh : scenario.scene.meshes) EXPECT_TRUE(fs::exists(mesh));
  }
}

TEST(ShippedConfig, TheExplorerEqualsTheDefaultVehicleAssembledFromParts) {
  VehicleConfig explorer = load_vehicle("explorer", kConfig);
  VehicleConfig plain;
  plain.name = "explorer";
  plain.lidar.emplace();
  EXPECT_NEAR(mass_properties(explorer).mass_kg, plain.mass_kg, 1e-12);
  EXPECT_EQ(explorer.attitude_control.inertia, plain.inertia);
  explorer.mass_kg = plain.mass_kg;
  explorer.rotor_mass_kg = 0.0;
  explorer.links.clear();
  explorer.attitude_control.inertia.reset();
  EXPECT_EQ(to_yaml(explorer), to_yaml(plain));
}

}  // namespace
}  // namespace skein
