// Wrong input: exit code 2, one message that says where the mistake is and what would be right, and no program starts.
#include <sys/stat.h>

#include <algorithm>
#include <regex>

#include "fleet_fixture.hpp"
#include "small_scene.hpp"

namespace skein::test {
namespace {

class BadInput : public FleetTest {
 protected:
  /// Expects the run to be refused with a message that contains all of `parts`.
  void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts, std::size_t most_lines = 2) {
    const std::string name = "run" + std::to_string(++count_);
    SkeinRun& refused = run(name, arguments, {}, 2);
    const std::string message = refused.err();
    for (const std::string& part : parts) {
      EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
    }
    const auto lines = static_cast<std::size_t>(std::count(message.begin(), message.end(), '\n'));
    EXPECT_GE(lines, 1u);
    EXPECT_LE(lines, most_lines) << message;
    EXPECT_FALSE(std::regex_search(message, std::regex("terminate|what\\(\\)|backtrace|std::|Assertion"))) << message;
    EXPECT_EQ(message.find("DDS domains"), std::string::npos) << "the run took domains before it was refused";
    EXPECT_EQ(refused.out(), "");
    EXPECT_FALSE(std::filesystem::exists(refused.dir())) << "the refused run has left a results folder";
  }

  int count_ = 0;
};

TEST_F(BadInput, TheSmallSceneIsAccepted) {
  const auto scenario = write_small_scene(folder());
  const Json result = run("good", {scenario, "--planner", "hover", "--duration", "2"}).result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_EQ(result["points_total"], kSmallScenePoints);
  EXPECT_EQ(result["uavs"].size(), 2u);
}

TEST_F(BadInput, BadSceneFilesAreNamed) {
  const auto scenario = write_small_scene(folder());
  const std::string points = folder() / "scene/points.pcd", boxes = folder() / "scene/box_description.yaml";
  const std::string good_points = text_of(points), good_boxes = text_of(boxes);

  write("scene/points.pcd", good_points.substr(0, good_points.size() - 20));
  expect_refused({scenario}, {points});
  write("scene/points.pcd", good_points);

  std::string bad = good_boxes;
  bad.replace(bad.find("20.0"), 4, "wide");
  write("scene/box_description.yaml", bad);
  const auto line = 1 + std::count(bad.begin(), bad.begin() + static_cast<std::ptrdiff_t>(bad.find("wide")), '\n');
  expect_refused({scenario}, {boxes + ":" + std::to_string(line), "size", "wide"});
  write("scene/box_description.yaml", good_boxes);

  std::filesystem::remove(folder() / "scene/mesh.stl");
  expect_refused({scenario}, {(folder() / "scene/mesh.stl").string()});
}

TEST_F(BadInput, ABadScenarioIsNamedWithTheKeyAndACorrectValue) {
  const auto scenario = write_small_scene(folder());
  const std::string good = text_of(scenario);
  const auto file = write("typo.yaml", good + "duraton_s: 10\n");
  const auto line = 1 + std::count(good.begin(), good.end(), '\n');
  expect_refused({file}, {file.string() + ":" + std::to_string(line), "duraton_s", "duration_s"});
  expect_refused({"twoers"}, {"twoers", "towers"});
  expect_refused({folder() / "nowhere.yaml"}, {(folder() / "nowhere.yaml").string()});
}

TEST_F(BadInput, AnUnknownPlannerIsNamedWithTheKnownOnes) {
  expect_refused({"towers", "--planner", "partol"}, {"partol", "patrol"});
  expect_refused({"towers", "--planner", "patrol:aproach_mps=2"}, {"aproach_mps", "approach_mps"});
  expect_refused({"towers", "--planner", "patrol:approach_mps=fast"}, {"approach_mps", "fast"});
  expect_refused({"towers", "--planner", "patrol,jurnog=hover"}, {"jurnog", "jurong"});
}

TEST_F(BadInput, BadOptionsAreNamed) {
  expect_refused({"towers", "--dds", "opendds"}, {"--dds", "opendds", "fastdds"});
  expect_refused({"towers", "--seed", "-1"}, {"--seed", "-1"});
  expect_refused({"towers", "--domain", "199"}, {"--domain", "199"});
  expect_refused({"towers", "--debug", "jurnog"}, {"jurnog", "jurong"});
  expect_refused({"towers", "--sede", "1"}, {"--sede"});
}

TEST_F(BadInput, AnEarlierResultIsKeptWithoutForce) {
  const Arguments brief = {"towers", "--planner", "hover", "--duration", "2"};
  const SkeinRun& first = run("kept", brief);
  const std::string result = text_of(first.dir() / "result.json");
  const auto changed_at = std::filesystem::last_write_time(first.dir() / "digests.csv");
  const SkeinRun& second = run("kept", brief, {}, 2);
  EXPECT_NE(second.err().find("--force"), std::string::npos) << second.err();
  EXPECT_NE(second.err().find(first.dir().string()), std::string::npos) << second.err();
  EXPECT_EQ(text_of(first.dir() / "result.json"), result);
  EXPECT_EQ(std::filesystem::last_write_time(first.dir() / "digests.csv"), changed_at);

  Arguments forced = brief;
  forced.insert(forced.end(), {"--force", "--seed", "9"});
  EXPECT_EQ(run("kept", forced).result()["seed"], 9);
}

TEST_F(BadInput, AProgramStartedByHandNamesAMissingFolder) {
  const std::string scenario = write_small_scene(folder()), missing = folder() / "none";
  for (const char* name : {"sim_server", "comm_router", "station", "uav_agent"}) {
    ChildProcess& refused = start_program(name, {program(name), "--scenario", scenario, "--out", missing});
    EXPECT_EQ(refused.wait().code, 2) << name;
    const std::string said = ": --out " + missing + ": does not exist; make this folder first, or choose another one\n";
    EXPECT_EQ(refused.err(), name + said);
    ChildProcess& checked = start_program(std::string(name) + "-check",
                                          {program(name), "--scenario", scenario, "--out", missing, "--check"});
    EXPECT_EQ(checked.wait().code, 0) << name << " wants to write although it only checks: " << checked.err();
  }
}

TEST_F(BadInput, AnAgentWithoutAPlannerRefusesOptionsOfPlanners) {
  const std::string scenario = write_small_scene(folder());
  for (const Arguments& role : {Arguments{"--role", "gcs", "--planner", "xxh"}, {"--planner", "ros"}}) {
    for (const Arguments& option : {Arguments{"--maps-every", "1"}, {"--pdb", "1"}, {"--time-parts"}}) {
      Arguments arguments = {program("uav_agent"), "--scenario", scenario, "--check"};
      arguments.insert(arguments.end(), option.begin(), option.end());
      arguments.insert(arguments.end(), role.begin(), role.end());
      ChildProcess& refused = start_program(role.back() + option.front(), arguments);
      EXPECT_EQ(refused.wait().code, 2) << role.back() << ' ' << option.front();
      EXPECT_TRUE(refused.err().starts_with("uav_agent: " + option.front())) << refused.err();
    }
  }
  ChildProcess& refused = start_program("both", {program("uav_agent"), "--scenario", scenario, "--check", "--role",
                                                 "gcs", "--uav", "a", "--planner", "xxh"});
  EXPECT_EQ(refused.wait().code, 2) << refused.err();
}

TEST_F(BadInput, APipeDeviceOrHugeFileIsRefusedAtOnce) {
  const std::string scenario = write_small_scene(folder());
  const std::string pipe = folder() / "pipe.yaml", recorded = folder() / "recorded", hole = folder() / "hole.csv";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_directory(recorded);
  ASSERT_EQ(::mkfifo((recorded + "/digests.csv").c_str(), 0600), 0);
  write("hole.csv", "");
  std::filesystem::resize_file(hole, std::uintmax_t{1} << 36);
  std::filesystem::rename(folder() / "scene/mesh.stl", folder() / "scene/was.stl");
  ASSERT_EQ(::mkfifo((folder() / "scene/mesh.stl").c_str(), 0600), 0);
  const std::vector<std::pair<Arguments, std::string>> wrong = {
      {{"check", "--golden", pipe}, pipe},
      {{"check", "--golden", "/dev/zero"}, "/dev/zero"},
      {{"check", "--golden", recorded}, recorded},
      {{"check", "--golden", hole}, hole},
      {{"check", pipe}, pipe},
      {{"check", "/dev/zero"}, "/dev/zero"},
      {{"check", scenario}, "mesh.stl"},
      {{"diff", recorded, recorded}, recorded + "/digests.csv"},
      {{"run", "towers", "--faults", pipe}, pipe},
      {{"run", pipe}, pipe},
      {{"run", "towers", "--agent", pipe}, pipe},
      {{"run", "towers", "--planner", "waypoints:" + pipe}, pipe}};
  for (const auto& [arguments, named] : wrong) {
    ChildProcess& refused = skein(arguments);
    EXPECT_EQ(refused.wait().code, 2) << arguments.front() << ' ' << arguments.back() << ": " << refused.err();
    EXPECT_NE((refused.err() + refused.out()).find(named), std::string::npos) << refused.err();
  }
}

TEST_F(BadInput, AWrongDurationInTheEnvironmentDoesNotPreventHelp) {
  for (const char* command : {"run", "compose", "compare", "contest"}) {
    ChildProcess& help = start_program(command, {program("skein"), command, "--help"}, {{"SKEIN_DURATION", "soon"}});
    EXPECT_EQ(help.wait().code, 0) << command << ": " << help.err();
    EXPECT_NE(help.out().find("--duration"), std::string::npos) << help.out();
  }
}

}  // namespace
}  // namespace skein::test
