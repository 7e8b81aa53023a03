// docker-compose reads every name of the user unchanged, or Skein refuses the name. No name can add entries to the file
// or become a variable.
#include "cli/compose/compose_yaml.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <random>

#include "cli/compose/compose_file.hpp"
#include "cli/testing/compose_programs.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/supervisor.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/host/environment.hpp"
#include "tests/support/test_program.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kDrawn = 300;

/// Pieces that YAML, docker-compose, bash or a comment might take for something else.
std::string draw_hostile_text(std::mt19937& random) {
  static const std::vector<std::string> kPieces = {"a",
                                                   "x=1",
                                                   "$",
                                                   "$$",
                                                   "${HOME}",
                                                   "${X:-y}",
                                                   "$(id)",
                                                   "\n",
                                                   "\nevil: 1\n",
                                                   "\r",
                                                   "\r\n",
                                                   "\t",
                                                   "\"",
                                                   "'",
                                                   "\\",
                                                   ": ",
                                                   " #",
                                                   "- ",
                                                   "|",
                                                   ">",
                                                   "{",
                                                   "}",
                                                   "[",
                                                   "]",
                                                   "&a",
                                                   "*a",
                                                   "!!b",
                                                   "%",
                                                   "\x01",
                                                   "\x1b[0m",
                                                   "\x7f",
                                                   "\x80",
                                                   "\xc2\x85",
                                                   "\xe9",
                                                   "\xe2\x80\xa8",
                                                   " ",
                                                   "é",
                                                   "\\n",
                                                   "ab:c",
                                                   "yes",
                                                   "~",
                                                   "\xed\xa0\x80",
                                                   "\xef\xbb\xbf",
                                                   "\xef\xbf\xbe",
                                                   "\xf0\x9f\x9a\x81"};
  std::string text;
  const int count = std::uniform_int_distribution<int>(1, 6)(random);
  for (int i = 0; i < count; ++i) {
    text += kPieces[std::uniform_int_distribution<std::size_t>(0, kPieces.size() - 1)(random)];
  }
  return text;
}

/// A value without variables as docker-compose reads it.
std::string without_doubling(const std::string& text) {
  std::string read;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '$' && (++i == text.size() || text[i] != '$')) throw std::runtime_error("a variable: " + text);
    read += text[i];
  }
  return read;
}

class HostileTexts : public testing::Test {
 protected:
  FleetPlan plan() const {
    RunOptions run;
    run.scenario = programs_.scenario();
    run.planner = "hover";
    return plan_fleet(run, programs_.dir());
  }
  /// The compose file of this plan; nullopt if Skein refuses the plan as the user's mistake.
  static std::optional<std::string> file_of(const FleetPlan& plan, const ComposeLayout& layout) {
    try {
      return compose_file(plan, layout);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }
  /// Expects the same structure and keys in both nodes. Values may differ. @param path  of the nodes, for messages
  static void expect_same_but_for_values(const YAML::Node& one, const YAML::Node& other, const std::string& path) {
    ASSERT_EQ(one.Type(), other.Type()) << path;
    ASSERT_EQ(one.size(), other.size()) << path;
    if (one.IsMap()) {
      for (const auto& entry : one) {
        const auto key = entry.first.as<std::string>();
        ASSERT_TRUE(other[key].IsDefined()) << path << '.' << key;
        expect_same_but_for_values(entry.second, other[key], path + "." + key);
      }
    } else if (one.IsSequence()) {
      for (std::size_t i = 0; i < one.size(); ++i) expect_same_but_for_values(one[i], other[i], path);
    }
  }

  const FakePrograms programs_;
  std::mt19937 random_{static_cast<unsigned>(turn_number())};  ///< other texts in each turn; SKEIN_TURN repeats them
};

TEST_F(HostileTexts, AreReadBackAsTheyWereGivenOrRefused) {
  const FleetPlan usual = plan();
  ComposeLayout usual_layout;
  usual_layout.results = usual_layout.build = "/r";
  const YAML::Node expected = YAML::Load(compose_file(usual, usual_layout));
  const std::string uav = usual.planners[0].uav, service = "uav_agent-" + uav;
  int taken = 0;
  for (int i = 0; i < kDrawn && !HasFailure(); ++i) {
    const std::string text = draw_hostile_text(random_);
    SCOPED_TRACE("'" + text + "'");
    FleetPlan drawn = usual;
    ComposeLayout layout = usual_layout;
    drawn.planners[0].spec = "hover:note=" + text;
    drawn.scenario.name = text;
    layout.command = shell_line({"skein", "compose", "towers", "--out", text});
    layout.results = layout.build = "/r" + text;
    const std::optional<std::string> file = file_of(drawn, layout);
    if (!file) continue;
    ++taken;
    const YAML::Node read = YAML::Load(*file);
    expect_same_but_for_values(expected, read, "");
    const YAML::Node agent = read["services"][service];
    std::vector<std::string> arguments;
    for (const YAML::Node& argument : agent["command"]) {
      const auto written = argument.as<std::string>();
      if (written.starts_with("--planner")) arguments.push_back(without_doubling(written));
    }
    EXPECT_EQ(arguments, std::vector<std::string>{"--planner=hover:note=" + text});
    EXPECT_EQ(without_doubling(agent["volumes"][0]["source"].as<std::string>()), *layout.results / "agents" / uav);
    EXPECT_EQ(without_doubling(agent["volumes"][2]["source"].as<std::string>()), *layout.build / "bin");
    // Whichever characters a reader takes for the end of a line, it finds two lines of comment.
    std::size_t end = file->find('\n', file->find('\n') + 1);
    EXPECT_TRUE(file->substr(end + 1).starts_with("\"x-program\""));
    EXPECT_TRUE(
        std::ranges::all_of(file->substr(0, end), [](unsigned char c) { return c == '\n' || (c >= 32 && c < 127); }));
  }
  EXPECT_GT(taken, kDrawn / 10);
}

TEST_F(HostileTexts, AreRefusedAsNamesOfImages) {
  const FleetPlan fleet = plan();
  const std::string uav = fleet.planners[0].uav;
  for (int i = 0; i < kDrawn; ++i) {
    const std::string text = draw_hostile_text(random_);
    SCOPED_TRACE("'" + text + "'");
    ComposeLayout theirs, ours, agents;
    theirs.images[uav] = text;
    ours.chosen["SKEIN_IMAGE"] = agents.chosen["SKEIN_AGENT_IMAGE"] = text;
    const bool plain = std::ranges::all_of(
        text, [](char c) { return c == 'a' || c == 'b' || c == 'c' || c == ':' || c == 'y' || c == 'e' || c == 's'; });
    EXPECT_EQ(file_of(fleet, theirs).has_value(), plain);
    EXPECT_EQ(file_of(fleet, ours).has_value(), plain);
    EXPECT_EQ(file_of(fleet, agents).has_value(), plain);
  }
  for (const char* image : {"mine", "mine:1.2", "registry.example:5000/a_b/c-d@sha256:00ff"}) {
    ComposeLayout layout;
    layout.images[uav] = image;
    const YAML::Node read = YAML::Load(compose_file(fleet, layout));
    EXPECT_EQ(read["services"]["uav_agent-" + uav]["image"].as<std::string>(), image);
  }
}

// The comment shows the command that wrote the file. bash must split it into the words of that command.
TEST_F(HostileTexts, TheCommandInACommentHasTheSameWordsInBash) {
  for (int i = 0; i < 40; ++i) {
    const std::string text = draw_hostile_text(random_) + ".";
    const fs::path out = programs_.dir() / "words";
    const std::string line = "printf %s " + in_comment(shell_word(text + "\x01")) + " >" + shell_word(out);
    ASSERT_EQ(run_to_end({"bash", {"/bin/bash", "-c", line}, environment_with({}), programs_.dir() / "log"}).code, 0);
    EXPECT_EQ(read_text(out), text + "\x01") << line;
  }
}

// Each docker-compose on this machine must read the same values as yaml-cpp, the library that writes the file.
TEST_F(HostileTexts, AreReadBackByDockerCompose) {
  const auto programs = compose_programs();
  if (programs.empty()) GTEST_SKIP() << "there is no docker-compose here";
  const FleetPlan usual = plan();
  for (int i = 0; i < 4;) {
    FleetPlan drawn = usual;
    std::string text;
    for (int part = 0; part < 8; ++part) text += draw_hostile_text(random_);
    // docker-compose prints these characters as \N and \uFEFF, which yaml-cpp reads back as other bytes.
    if (text.find("\xC2\x85") != std::string::npos || text.find("\xEF\xBB\xBF") != std::string::npos) continue;
    drawn.planners[0].spec = "hover:note=" + text;
    const std::optional<std::string> file = file_of(drawn, {});
    if (!file) continue;
    ++i;
    const fs::path path = programs_.dir() / "compose.yaml", log = programs_.dir() / "compose.log";
    write_text(path, *file);
    for (std::vector<std::string> words : programs) {
      words.insert(words.end(), {"-f", path, "config"});
      ASSERT_EQ(run_to_end({"docker-compose", words, environment_with({}), log}).code, 0) << read_text(log) << text;
      const YAML::Node read = YAML::Load(read_text(log));
      bool found = false;
      for (const YAML::Node& argument : read["services"]["uav_agent-" + usual.planners[0].uav]["command"]) {
        const std::string written = argument.as<std::string>();
        found =
            found || (written.starts_with("--planner") && without_doubling(written) == "--planner=hover:note=" + text);
      }
      EXPECT_TRUE(found) << words[2] << ": " << text << read_text(log);
    }
  }
}

}  // namespace
}  // namespace skein::cli
