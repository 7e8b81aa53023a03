// docs/scenarios.md is correct: its examples load, and its table has every key.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/config/config_node.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/scenario/scene_families.hpp"
#include "tests/support/places.hpp"
#include "tests/support/text_files.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = source_path();

std::string page() { return read_text(kRoot / "docs" / "scenarios.md"); }

/// The page's YAML blocks, except those that are marked as something else.
std::vector<std::string> examples() {
  static const std::string begin_mark = "```yaml\n", end_mark = "```\n";
  const std::string text = page();
  std::vector<std::string> blocks;
  for (std::size_t at = 0; (at = text.find(begin_mark, at)) != std::string::npos;) {
    at += begin_mark.size();
    const std::size_t end = text.find(end_mark, at);
    if (end == std::string::npos) break;
    const std::string block = text.substr(at, end - at);
    if (!block.starts_with("# not a scenario")) blocks.push_back(block);
    at = end + end_mark.size();
  }
  return blocks;
}

Scenario load(const std::string& yaml) {
  const fs::path file = fs::path(::testing::TempDir()) / "skein_docs_example.yaml";
  std::ofstream(file) << yaml;
  LoadOptions options;
  options.config_dir = kRoot / "config";
  options.needs_scene_files = false;
  Scenario scenario = load_scenario(file.string(), options);
  fs::remove(file);
  return scenario;
}

TEST(ScenarioPage, ItsExamplesLoad) {
  const auto blocks = examples();
  ASSERT_GE(blocks.size(), 4u);
  for (const std::string& block : blocks) EXPECT_NO_THROW(load(block)) << block;
}

TEST(ScenarioPage, ItsExamplesMbsAndCraneAreTheShippedScenarios) {
  LoadOptions options;
  options.config_dir = kRoot / "config";
  options.needs_scene_files = false;
  std::size_t found = 0;
  for (const std::string& block : examples()) {
    const Scenario shown = load(block);
    if (shown.name != "mbs" && shown.name != "crane") continue;
    Scenario shipped = load_scenario(shown.name, options);
    shipped.description.clear();
    EXPECT_EQ(to_yaml(shown), to_yaml(shipped));
    ++found;
  }
  EXPECT_EQ(found, 2u);
}

TEST(ScenarioPage, ItsTableHasEveryKeyAndFamily) {
  const std::string text = page();
  const auto expect_keys = [&](const ConfigNode& map, const std::string& prefix) {
    for (const std::string& key : map.keys) {
      EXPECT_NE(text.find("`" + prefix + key + "`"), std::string::npos) << prefix << key;
    }
  };
  for (const std::string& block : examples()) {
    const ConfigNode printed = parse_config_document(to_yaml(load(block)), "printed").root;
    expect_keys(printed, "");
    expect_keys(*printed.find("station"), "station.");
    expect_keys(*printed.find("scene"), "scene.");
    expect_keys(printed.find("fleet")->items.at(0), "fleet[].");
  }
  for (const SceneFamily& family : scene_families()) {
    EXPECT_NE(text.find(std::string("| `") + family.name + "` |"), std::string::npos) << family.name;
  }
}

}  // namespace
}  // namespace skein
