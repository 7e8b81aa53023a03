// Every fault test in config/faults/ loads, and the tables on the pages about faults and properties are complete.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "cli/fault_tests/fault_test.hpp"
#include "core/config/config_files.hpp"
#include "core/expressions/signal_table.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/suggestion.hpp"
#include "signals/properties/property_file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/text_files.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = source_path();

std::string page(const std::string& name) { return read_text(kRoot / "docs" / name); }

/// The YAML blocks of a page.
std::vector<std::string> examples(const std::string& text) {
  static const std::string begin_mark = "```yaml", end_mark = "```\n";
  std::vector<std::string> blocks;
  for (std::size_t at = 0; (at = text.find(begin_mark, at)) != std::string::npos;) {
    at = text.find('\n', at) + 1;  // skips the rest of the line, which may have the block's name
    const std::size_t end = text.find(end_mark, at);
    blocks.push_back(text.substr(at, end - at));
    at = end;
  }
  return blocks;
}

class FaultFiles : public testing::Test {
 protected:
  FaultFiles() {
    ::setenv("SKEIN_CONFIG_DIR", (kRoot / "config").c_str(), 1);
    file_ = fs::path(testing::TempDir()) / ("skein_fault_files_" + std::to_string(::getpid()) + ".yaml");
  }
  ~FaultFiles() override { fs::remove(file_); }

  fs::path written(const std::string& text) {
    std::ofstream(file_) << text;
    return file_;
  }
  static std::vector<std::string> shipped() { return config_names(kRoot / "config" / "faults"); }

  fs::path file_;
};

TEST_F(FaultFiles, EveryShippedFileIsAFaultTestWithTheFilesName) {
  EXPECT_GE(shipped().size(), 12u);
  double total_s = 0.0;
  for (const std::string& name : shipped()) {
    const FaultTest test = load_fault_test(kRoot / "config" / "faults" / (name + ".yaml"));
    EXPECT_EQ(test.plan.faults.name, name);
    EXPECT_FALSE(test.plan.faults.description.empty()) << name;
    total_s += *test.plan.options.duration_s;
    EXPECT_LE(*test.plan.options.duration_s, 180.0) << name;
  }
  EXPECT_LE(total_s, 100.0 * static_cast<double>(shipped().size())) << "the suite should stay short";
}

// Other UAVs take over a UAV's work only if its program does not come back. If it does, the property is vacuous.
TEST_F(FaultFiles, FilesThatRequireATakeoverKillAProgramForGood) {
  std::size_t asked = 0;
  for (const std::string& name : shipped()) {
    const FaultTest test = load_fault_test(kRoot / "config" / "faults" / (name + ".yaml"));
    if (std::ranges::find(test.property_set, "taken_over", &properties::NamedProperty::name) ==
        test.property_set.end()) {
      continue;
    }
    ++asked;
    EXPECT_TRUE(std::ranges::any_of(test.plan.faults.faults, [](const Fault& fault) {
      return fault_kind(fault) == "kill" && !fault.until_s && !fault.for_s;
    })) << name;
  }
  EXPECT_GE(asked, 1u);
}

TEST_F(FaultFiles, FindsWithADigestNameTheBuildThatFlewIt) {
  std::size_t finds = 0;
  for (const std::string& name : config_names(kRoot / "config" / "faults" / "found")) {
    const FaultTest test = load_fault_test(kRoot / "config" / "faults" / "found" / (name + ".yaml"));
    ASSERT_TRUE(test.capsule) << name;
    EXPECT_EQ(test.capsule->digest.empty(), test.capsule->build.empty()) << name;
    ++finds;
  }
  EXPECT_GE(finds, 6u);
}

TEST_F(FaultFiles, TheShippedFilesUseEveryKindOfFault) {
  std::set<std::string> kinds;
  for (const std::string& name : shipped()) {
    const FaultTest test = load_fault_test(kRoot / "config" / "faults" / (name + ".yaml"));
    for (const Fault& fault : test.plan.faults.faults) kinds.insert(fault_kind(fault));
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<FaultAction>);
}

TEST_F(FaultFiles, ThePageOfFaultsHasExamplesThatLoadAndNamesEveryShippedFile) {
  const std::string text = page("faults.md");
  const Scenario towers = load_scenario("towers", {});
  const auto blocks = examples(text);
  ASSERT_FALSE(blocks.empty());
  for (const std::string& block : blocks) EXPECT_NO_THROW(load_fault_plan(written(block), towers)) << block;
  for (const std::string& name : shipped()) EXPECT_NE(text.find("`" + name + "`"), std::string::npos) << name;
}

TEST_F(FaultFiles, ExamplesOfThePageOfTestsLoad) {
  const auto blocks = examples(page("how-to-test-faults.md"));
  ASSERT_GE(blocks.size(), 2u);
  for (const std::string& block : blocks) EXPECT_NO_THROW(load_fault_test(written(block))) << block;
}

TEST_F(FaultFiles, ThePageOfTestsListsEveryExpectationAndEveryDefaultProperty) {
  const std::string text = page("how-to-test-faults.md");
  for (const char* row : {"| `status` | `completed` |", "| `exit_code` | `0` |", "| `deterministic` | `true` |",
                          "| `faults_acted` | `true` |", "| `radio` | |", "| `same_digest` | `[]` |"}) {
    EXPECT_NE(text.find(std::string("\n") + row), std::string::npos) << row;
  }
  for (const char* name : properties::kDefaultProperties) {
    EXPECT_NE(text.find("`" + std::string(name) + "`"), std::string::npos) << name;
  }
}

// A shipped file must not list a property that every fault test has anyway.
TEST_F(FaultFiles, NoShippedFileRepeatsADefaultProperty) {
  for (const std::string& name : shipped()) {
    const FaultTest test = load_fault_test(kRoot / "config" / "faults" / (name + ".yaml"));
    for (const char* usual : properties::kDefaultProperties) EXPECT_FALSE(test.states(usual)) << name << " " << usual;
  }
}

TEST_F(FaultFiles, ThePageOfPropertiesListsEverySignalAndEveryReadyProperty) {
  const std::string text = page("properties.md");
  const auto has_row = [&](const std::string& row) {
    EXPECT_NE(text.find("\n" + row + "\n"), std::string::npos) << "the page lacks this row: " << row;
  };
  for (const SignalInfo& info : signal_table()) {
    const std::string unit = info.is_boolean ? "yes or no" : unit_text(info.unit);
    has_row("| `" + info.text() + "` | " + unit + " | " + (info.is_live ? "live" : "") + " | " +
            std::string(info.meaning) + " |");
  }
  for (const std::string& name : properties::ready_property_names()) {
    const properties::ReadyProperty ready = properties::load_ready_property(name);
    std::vector<std::string> parameters;
    for (const auto& [parameter, value] : ready.parameters) parameters.push_back("`" + parameter + ": " + value + "`");
    std::vector<std::string> spoilt_by;
    for (const std::string& fault : ready.not_with) spoilt_by.push_back("`" + fault + "`");
    const std::string hunts = !ready.in_hunts ? "no" : spoilt_by.empty() ? "all" : "not with " + joined(spoilt_by);
    has_row("| `" + name + "` | " + joined(parameters) + " | " + ready.description + " | " + hunts + " |");
  }
  for (const UnitName& unit : kUnitNames) EXPECT_NE(text.find(unit.name), std::string::npos) << unit.name;
}

TEST_F(FaultFiles, ExamplesOfThePageOfPropertiesLoad) {
  const auto blocks = examples(page("properties.md"));
  ASSERT_FALSE(blocks.empty());
  for (const std::string& block : blocks) EXPECT_NO_THROW(load_fault_test(written(block))) << block;
}

}  // namespace
}  // namespace skein::cli
