// Property files, and the ready properties that Skein ships.
#include "signals/properties/property_file.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "core/config/config_files.hpp"
#include "core/expressions/signal_table.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"

namespace skein::properties {
namespace {

class PropertyFiles : public testing::Test {
 protected:
  PropertyFiles() {
    ::setenv("SKEIN_CONFIG_DIR", source_path("config").c_str(), 1);
    file_ = std::filesystem::path(testing::TempDir()) / ("skein_properties_" + std::to_string(::getpid()) + ".yaml");
    LoadOptions load;
    load.needs_scene_files = false;
    towers_ = load_scenario("towers", load);
  }
  ~PropertyFiles() override { std::filesystem::remove(file_); }

  PropertySet load(const std::string& text) {
    std::ofstream(file_) << text;
    return load_properties(file_, towers_);
  }
  void refused(const std::string& text, const std::string& words) {
    try {
      load(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(file_.string() + words), std::string::npos) << error.what();
    }
  }

  std::filesystem::path file_;
  Scenario towers_;
};

TEST_F(PropertyFiles, TextsAndReadyPropertiesAreRead) {
  const PropertySet set = load(
      "name: mine\ndescription: all kinds\nproperties:\n"
      "  low: always held < 30\n"
      "  separation: ready\n"
      "  restarted_works: {deadline: 12 s}\n"
      "  folded:\n    eventually captures >= 3\n    within 20 s\n");
  ASSERT_EQ(set.size(), 4U);
  EXPECT_EQ(set[0].text, "always held < 30");
  EXPECT_EQ(set[1].cases.size(), 1U);
  EXPECT_EQ(set[2].cases.size(), towers_.fleet.size());
  EXPECT_EQ(*set[2].cases[0].window.within_s, 12.0);
  EXPECT_EQ(*set[3].cases[0].window.within_s, 20.0);
}

TEST_F(PropertyFiles, WrongPropertiesAreRefusedWithLineAndColumn) {
  refused("properties:\n  low: always hold < 30\n", ":2:15: properties.low: there is no signal 'hold'");
  refused("properties:\n  low: always held < 30 s\n", ":2:22: properties.low: units do not fit");
  refused("properties:\n  low:\n    eventually held > 3\n    within 9999 s\n",
          ":4:12: properties.low: 9999 s are beyond");
  refused("properties:\n  low: \"always held < 3 from 9 s to 8 s\"\n", ":2:37: properties.low: the interval is upside");
  refused("properties:\n  separatoin: ready\n",
          ":2: properties.separatoin: there is no ready property 'separatoin'; did");
  refused("properties:\n  separation: {most: 2 m}\n", ":2: properties.separation.most: 'separation' has no such");
  refused("properties:\n  separation: {least: 2 s}\n", ":2:23: properties.separation.least: must be a number of m");
  refused("properties:\n  separation: {least: 2x}\n", ":2:24: properties.separation.least: there is no unit 'x'");
  refused("propertis: {}\n", ":1: unknown key 'propertis'");
}

// Hunts and fault tests name folders and files after properties.
TEST_F(PropertyFiles, NamesThatCouldBePathsAreRefused) {
  const std::string longest(64, 'a');
  for (const std::string& name : std::vector<std::string>{"../../x", "a/b", ".", "a b", "ä", longest + "a"}) {
    refused("properties:\n  low: always held < 30\n  '" + name + "': always held < 30\n",
            ":3: properties." + name + ": a property's name consists of 1 to 64 letters, digits, '_' and '-'");
  }
  EXPECT_EQ(load("properties:\n  " + longest + ": always held < 30\n  A-b_2: always held < 30\n").size(), 2U);
}

TEST_F(PropertyFiles, EveryReadyPropertyFitsTheShippedScenarios) {
  const std::vector<std::string> names = ready_property_names();
  EXPECT_GE(names.size(), 10U);
  std::set<std::string> signals;
  for (const SignalInfo& info : signal_table()) signals.emplace(info.name);
  for (const std::string& scenario : config_names(source_path("config/scenarios"))) {
    LoadOptions options;
    options.needs_scene_files = false;
    const Scenario fleet = load_scenario(scenario, options);
    for (const std::string& name : names) {
      std::ofstream(file_) << "properties:\n  " << name << ": ready\n";
      EXPECT_FALSE(load_properties(file_, fleet)[0].cases.empty()) << name << " in " << scenario;
    }
  }
  for (const std::string& name : names) {
    const ReadyProperty ready = load_ready_property(name);
    for (const auto& [parameter, value] : ready.parameters) {
      EXPECT_FALSE(signals.contains(parameter)) << name << ": " << parameter << " hides a signal";
      EXPECT_NE(ready.description.find("`" + parameter + "`"), std::string::npos) << name << ": " << parameter;
    }
  }
}

}  // namespace
}  // namespace skein::properties
