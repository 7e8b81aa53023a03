// Skein has the commands, parameters and variables that the pages show, and the changelog is up to date.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "cli/command_line.hpp"
#include "cli/help.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "run/exec_variables.hpp"
#include "run/fleet_plan.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pages() {
  const fs::path root = source_path();
  std::vector<fs::path> files = {root / "README.md", root / "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  return files;
}

/// The arguments after "./skein" in the blocks of a page, without comments, pipes and redirections.
std::vector<std::string> commands_of(const fs::path& page) {
  static const std::regex kCommand(R"(^\s*(?:\$ )?\./skein (.*))"), kRest(R"(\s+(#|&$|<|\d?>|\||\\$).*)");
  std::vector<std::string> commands;
  std::ifstream in(page);
  bool in_block = false;
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) in_block = !in_block;
    if (in_block && std::regex_match(line, match, kCommand)) {
      commands.push_back(std::regex_replace(match.str(1), kRest, ""));
    }
  }
  return commands;
}

TEST(Pages, ShowOnlyCommandsThatExist) {
  std::size_t read = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& command : commands_of(page)) {
      const bool is_shown_as_a_form = command.find("...") != std::string::npos;
      if (is_shown_as_a_form || command.starts_with("test --sanitize"))
        continue;  // the script ./skein executes it itself
      EXPECT_NO_THROW(parse_command_line(shell_words(command))) << page << ": skein " << command;
      ++read;
    }
  }
  EXPECT_GT(read, 80u);
}

/// The sources of one of our planners and of the flight core's configuration; empty: there is no such planner.
std::string source_of_planner(const std::string& name) {
  const fs::path planners = source_path("uav_agent/planners");
  std::string text;
  for (const fs::path& folder : {planners / name, planners / "basic"}) {
    const bool is_its_own = folder.filename() == name;
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (!is_its_own && !entry.path().filename().string().starts_with(name + ".")) continue;
      text += read_text(entry.path());
    }
  }
  if (text.empty()) return text;
  return text + read_text(source_path("uav_agent/flight_core/flight_config.hpp"));
}

// A parameter of a planner that a page shows has a key in that planner's sources.
TEST(Pages, ShowOnlyParametersThatExist) {
  static const std::regex kPlanner(R"(\b([a-z]+):((?:[a-z_]+=[0-9a-z.]+,?)+))"), kKey(R"(([a-z_]+)=)");
  static const std::set<std::string> kUavs = {"jurong", "raffles", "sentosa", "changi", "nanyang"};
  std::size_t read = 0;
  for (const fs::path& page : pages()) {
    std::ifstream in(page);
    for (std::string line; std::getline(in, line);) {
      for (std::sregex_iterator it(line.begin(), line.end(), kPlanner), end; it != end; ++it) {
        const std::string source = source_of_planner(it->str(1)), given = it->str(2);
        if (source.empty()) continue;  // the page itself shows how to write this planner
        for (std::sregex_iterator key(given.begin(), given.end(), kKey); key != end; ++key) {
          if (kUavs.contains(key->str(1))) break;  // the planner of another UAV follows
          EXPECT_NE(source.find('"' + key->str(1) + '"'), std::string::npos) << page << ": " << it->str(0);
          ++read;
        }
      }
    }
  }
  EXPECT_GT(read, 10u);
}

// A program of the user's own gets no variable that the page does not name.
TEST(Pages, NameTheVariablesOfAProgramOfOnesOwn) {
  const FakePrograms programs;
  RunOptions run;
  run.scenario = programs.scenario();
  run.planner = "exec:mine";
  run.network = "all";
  const FleetPlan plan = plan_fleet(run, programs.dir());
  const std::string how_to = read_text(source_path("docs/how-to.md"));
  const auto variables = exec_variables(plan, "uav_agent-alpha", 0, "out", {});
  for (const auto& [name, value] : variables) EXPECT_NE(how_to.find("`" + name + "`"), std::string::npos) << name;
  for (const char* name : {"SKEIN_RUN", "SKEIN_NETWORK"}) EXPECT_TRUE(variables.contains(name)) << name;
  // Programs in containers find Skein's files in the image.
  const std::string containers = read_text(source_path("docs/containers.md"));
  for (const std::string name :
       {"SKEIN_DOMAIN", "ROS_DOMAIN_ID", "SKEIN_UAV", "SKEIN_ROLE", "SKEIN_DDS", "SKEIN_RUN", "SKEIN_NETWORK",
        "SKEIN_OUT", "SKEIN_EXCHANGE_S", "SKEIN_RADIO_SENDS", "SKEIN_RADIO_HEARS"}) {
    EXPECT_TRUE(variables.contains(name)) << name;
    EXPECT_NE(containers.find("`" + name + "`"), std::string::npos) << name;
  }
}

// A development version has the number of the release that it becomes.
TEST(Pages, TheNewestVersionOfTheChangelogIsThisOne) {
  const std::string changelog = read_text(source_path("CHANGELOG.md"));
  std::istringstream said(parse_command_line({"--version"}).get<HelpText>().text);
  std::string name, version;
  said >> name >> version;
  const std::size_t suffix = version.find("-dev"), first = changelog.find("\n## [");
  const std::string number = version.substr(0, suffix), released = "\n## [" + number + "]";
  if (suffix == std::string::npos) {
    EXPECT_EQ(changelog.find(released), first) << version;
  } else {
    EXPECT_EQ(changelog.find("\n## [Unreleased]\n\nThis will be " + number + "."), first) << version;
    EXPECT_EQ(changelog.find(released), std::string::npos) << version << ": this version is released already";
  }
}

}  // namespace
}  // namespace skein::cli
