#include "cli/completion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "cli/command_line.hpp"
#include "cli/help.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

using Words = std::vector<std::string>;

const KnownNames kKnown{[] { return Words{"cranes", "sail", "spire"}; }, [] { return Words{"hover", "kios"}; }};

Words offered(const Words& words) { return completions(words, kKnown); }

std::string text_of(const Words& arguments) { return parse_command_line(arguments).get<HelpText>().text; }

/// The commands that --help lists, in its order, each with its task: the heading above it.
std::vector<std::pair<std::string, std::string>> tasks_of_help() {
  static const std::regex kHeading("([A-Z].*):"), kCommand("  ([a-z-]+) .*");
  std::istringstream lines(text_of({"--help"}));
  std::vector<std::pair<std::string, std::string>> tasks;
  std::string task;
  std::smatch match;
  for (std::string line; std::getline(lines, line) && line != "Example:";) {
    if (std::regex_match(line, match, kHeading)) task = match.str(1);
    if (std::regex_match(line, match, kCommand)) tasks.emplace_back(match.str(1), task);
  }
  std::erase_if(tasks, [](const auto& entry) { return entry.first.starts_with('-'); });
  return tasks;
}

Words commands_of_help() {
  Words commands;
  for (const auto& [command, task] : tasks_of_help()) commands.push_back(command);
  return commands;
}

/// The options ("--seed", "-v" and so on) with which the entries of --help begin.
std::set<std::string> options_of_help(const std::string& help) {
  static const std::regex kEntry(R"(\n  (-[-,a-z]*))"), kName("--?[a-z-]+");
  std::set<std::string> options;
  for (std::sregex_iterator entry(help.begin(), help.end(), kEntry), end; entry != end; ++entry) {
    const std::string names = (*entry)[1];
    for (std::sregex_iterator name(names.begin(), names.end(), kName); name != end; ++name) options.insert(name->str());
  }
  return options;
}

/// The text of a manual page as a reader sees it, without roff's marks.
std::string plain(std::string page) {
  page = std::regex_replace(page, std::regex(R"(\\f[BR])"), "");
  return std::regex_replace(page, std::regex(R"(\\-)"), "-");
}

TEST(Completion, EveryCommandAndOptionOfHelpIsOfferedAndInTheManual) {
  const std::string manual = plain(text_of({"--manual"}));
  const Words commands = commands_of_help();
  ASSERT_GE(commands.size(), 9u);
  EXPECT_EQ(offered({""}), commands);
  for (const std::string& command : commands) {
    const std::size_t begin = manual.find("\n.SS skein " + command + " ");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string section = manual.substr(begin, manual.find("\n.S", begin + 1) - begin);
    const std::set<std::string> options = options_of_help(text_of({command, "--help"}));
    ASSERT_TRUE(options.contains("--help"));
    for (const std::string& option : options) {
      EXPECT_TRUE(std::regex_search(section, std::regex("\n.TP\n(.*, )?" + option + "[ ,\n]")))
          << command << ' ' << option;
    }
    const Words all = offered({command, "-"});
    EXPECT_EQ(std::set<std::string>(all.begin(), all.end()), options) << command;
  }
}

// A newcomer looks for a task, not for a name.
TEST(Help, ListsEachCommandOnceUnderItsTask) {
  std::map<std::string, std::string> task_of;
  for (const auto& [command, task] : tasks_of_help()) {
    EXPECT_TRUE(task_of.emplace(command, task).second) << command << " is listed twice";
    EXPECT_NE(task, "Subcommands") << command << " belongs to no task";
  }
  EXPECT_EQ(task_of["run"], "Fly a fleet");
  EXPECT_EQ(task_of["replay"], "Examine runs");
  EXPECT_EQ(task_of["contest"], "Compare planners");
  EXPECT_EQ(task_of["hunt"], "Find faults");
  EXPECT_EQ(task_of["bench"], "Scenarios and machines");
  EXPECT_EQ(task_of.size(), offered({""}).size());
}

TEST(Help, CommandsAreInTheReadmesTable) {
  std::ifstream in(source_path("README.md"));
  std::string row;
  while (std::getline(in, row) && !row.starts_with("| commands | ")) continue;
  std::set<std::string> listed;
  static const std::regex kName("`([^`]+)`");
  for (std::sregex_iterator name(row.begin(), row.end(), kName), end; name != end; ++name) listed.insert((*name)[1]);
  const Words commands = commands_of_help();
  EXPECT_EQ(listed, std::set<std::string>(commands.begin(), commands.end()));
}

TEST(Completion, ValuesAreOfferedWhereTheyAreKnown) {
  EXPECT_EQ(offered({"run", ""}), Words({"cranes", "sail", "spire"}));
  EXPECT_EQ(offered({"run", "s"}), Words({"sail", "spire"}));
  EXPECT_EQ(offered({"run", "sail", "--planner", ""}), Words({"hover", "kios"}));
  EXPECT_EQ(offered({"run", "--planner", "kios,jurong=h"}), Words({"kios,jurong=hover"}));
  EXPECT_EQ(offered({"compare", "--planners", "hover,"}), Words({"hover,hover", "hover,kios"}));
  EXPECT_EQ(offered({"contest", "--scenarios", "sail,c"}), Words({"sail,cranes"}));
  EXPECT_EQ(offered({"run", "--dds", ""}), Words({"cyclonedds", "fastdds", "mixed"}));
  EXPECT_EQ(offered({"compare", "--executor", ""}), Words({"local", "parallel", "slurm"}));
  EXPECT_EQ(offered({"run", "--dds=f"}), Words({"--dds=fastdds"}));
  EXPECT_EQ(offered({"oracle", "--rules", "p"}), Words({"paper"}));
}

TEST(Completion, FilesOfPlannersInPythonAreOffered) {
  const std::string folder = "py:" + source_path("python/examples") + "/";
  const Words files = offered({"run", "--planner", folder});
  EXPECT_TRUE(std::ranges::find(files, folder + "hover.py") != files.end());
  EXPECT_TRUE(std::ranges::all_of(files, [](const std::string& file) { return file.ends_with(".py"); }));
  EXPECT_EQ(offered({"run", "--planner", folder + "ho"}), Words({folder + "hover.py"}));
  EXPECT_EQ(offered({"run", "--planner", "kios,jurong=" + folder + "orb"}),
            Words({"kios,jurong=" + folder + "orbit.py"}));
  EXPECT_EQ(offered({"run", "--planner", "py:" + source_path("python/exa")}), Words({folder}));
  EXPECT_EQ(offered({"run", "--planner", "py:/no/such/folder/"}), Words{});
}

TEST(Completion, NothingIsOfferedForAnOptionThatTakesAnyTextOrFile) {
  EXPECT_EQ(offered({"run", "--out", ""}), Words{});
  EXPECT_EQ(offered({"check", ""}), Words{});
  EXPECT_EQ(offered({"no-command", ""}), Words{});
  EXPECT_EQ(offered({"run", "--no-such"}), Words{});
}

/// Tests the script itself, which splits the line and gives bash the replacement. A function replaces `skein`: it
/// completes the last word by "hover", and adds the number of words.
TEST(Completion, BashGetsTheLastPartOfAWord) {
  const auto replies = [](const std::string& line) {
    const std::string script = "skein() { shift; printf \"%s\\n\" \"${@: -1}hover\" \"$#\"; }; . " +
                               source_path("cli/completion/skein.bash") + "; COMP_LINE=\"" + line +
                               "\" COMP_POINT=" + std::to_string(line.size()) + "; _skein skein; echo ${COMPREPLY[*]}";
    const std::unique_ptr<FILE, decltype(&::pclose)> pipe(::popen(("bash -c '" + script + "'").c_str(), "r"),
                                                          &::pclose);
    std::string text(200, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), pipe.get()));
    return text;
  };
  EXPECT_EQ(replies("skein run --planner "), "hover 3\n");
  EXPECT_EQ(replies("skein run --planner kios,jurong="), "hover 3\n");
  EXPECT_EQ(replies("skein run --planner kios,"), "kios,hover 3\n");
}

}  // namespace
}  // namespace skein::cli
