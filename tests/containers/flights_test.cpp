// A fleet in containers has the same digest as without containers, and leaves nothing behind.
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <regex>

#include "cli/bench/scenario.hpp"
#include "container_fixture.hpp"
#include "core/text/text.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class FlightInContainers : public Containers {
 protected:
  void expect_secured(const Arguments& options);

  std::mt19937 random_{std::random_device{}()};
};

class EveryVendor : public FlightInContainers,
                    public testing::WithParamInterface<std::pair<std::string, std::string>> {};

TEST_P(EveryVendor, HasTheDigestOfAFlightWithoutContainers) {
  const auto& [vendor, planner] = GetParam();
  const SkeinRun& run = up("up", arguments(planner, "60", {"--dds", vendor}));
  expect_whole(run);
  EXPECT_GT(run.result()["score"], 0.0);
  EXPECT_EQ(flight_of(run), alone(arguments(planner)));
}

INSTANTIATE_TEST_SUITE_P(Vendors, EveryVendor,
                         testing::Values(std::pair("cyclonedds", "patrol"), std::pair("fastdds", "kios"),
                                         std::pair("mixed", "patrol")),
                         [](const auto& vendor) { return vendor.param.first; });

// If the images have other programs, all other tests mount those of the build folder instead.
TEST_F(FlightInContainers, TheImagesOwnProgramsAreThoseOfThisBuild) {
  if (programs_of_this_build().empty()) return;
  const std::string untested = "the images have the programs of another build: not tested is that their own fly";
  if (engine_is_required()) FAIL() << untested;
  GTEST_SKIP() << untested;
}

TEST_F(FlightInContainers, ProgramsOfABuildFolderFlyInPlaceOfTheImagesPrograms) {
  const SkeinRun& run = up("up", arguments("patrol", "20", {"--build-folder", build_path()}));
  expect_whole(run);
  EXPECT_NE(text_of(run.dir() / "compose.yaml").find("/opt/skein/bin"), std::string::npos);
  EXPECT_EQ(flight_of(run), alone(arguments("patrol", "20")));
}

// A member of each kind is killed and paused once, in a random order, while links lose messages.
TEST_F(FlightInContainers, FaultsHaveTheSameEffectAsWithoutContainers) {
  std::vector<std::string> killed = {"jurong", "changi", "station", "comm_router", "gcs"}, stopped = killed;
  std::ranges::shuffle(killed, random_);
  std::ranges::shuffle(stopped, random_);
  std::string faults = "faults:\n  - {at_s: 8, until_s: 90, link: {to: gcs, loss: 0.3}}\n";
  for (std::size_t i = 0; i < killed.size(); ++i) {
    const double at_s = 12.0 + 15.0 * static_cast<double>(i);
    faults += fmt::format("  - {{at_s: {}, until_s: {}, kill: {}}}\n", at_s, at_s + 5.0, killed[i]);
    faults += fmt::format("  - {{at_s: {}, until_s: {}, pause: {}}}\n", at_s + 7.0, at_s + 12.0, stopped[i]);
  }
  SCOPED_TRACE(faults);
  const Arguments flown = arguments("patrol,gcs=listen", "240", {"--faults", write("faults.yaml", faults)});
  const SkeinRun& run = up("up", flown);
  expect_whole(run);
  EXPECT_EQ(flight_of(run), alone(flown));
  EXPECT_GT(run.result()["radio"]["dropped_fault"], 0);
  // A UAV whose program was absent photographs and delivers afterwards.
  const auto captures = read_csv(run.dir() / "captures.csv");
  EXPECT_TRUE(std::ranges::any_of(captures, [](const auto& capture) {
    return capture.at("uav") == "changi" && std::stod(capture.at("time_s")) > 90.0 &&
           !capture.at("delivered_at_s").empty();
  }));
  for (const std::string& member : killed) {
    const bool is_uav = std::ranges::find(kFleet, member) != kFleet.end();
    const std::string program = is_uav || member == "gcs" ? "uav_agent-" + member : member;
    EXPECT_NE(log_of(run, program).find("here it starts again"), std::string::npos) << program;
  }
}

// The steps of docs/how-to-containers.md without the compilation, in a fleet of another size.
TEST_F(FlightInContainers, APlannersOwnImageFliesAUav) {
  const fs::path context = folder() / "image";
  fs::create_directory(context);
  fs::copy_file(helper_program("probe_agent"), context / "my_agent");
  std::ofstream(context / "Dockerfile")
      << "FROM skein-agent\nCOPY my_agent /usr/local/bin/\nENTRYPOINT [\"my_agent\"]\n";
  const std::string image = "skein-test-" + std::to_string(::getpid());
  const Answer built = shell("docker build --tag " + image + " " + context.string());
  ASSERT_EQ(built.code, 0) << built.text;
  const auto flown = [&](const std::string& of, const Arguments& more) {
    Arguments all = arguments("patrol,jurong=probe:east_m=20" + of, "60", more);
    all.insert(all.end(), {"--uavs", "4"});
    return all;
  };
  const SkeinRun& run = up("up", flown("", {"--image", "jurong=" + image}));
  EXPECT_EQ(shell("docker image rm " + image).code, 0);
  expect_whole(run);
  EXPECT_EQ(run.result()["uavs"].size(), 4u);
  EXPECT_GT(run.result()["uavs"][0]["distance_m"], 1.0) << "the UAV did not take off";
  EXPECT_EQ(flight_of(run), alone(flown("@" + helper_program("probe_agent"), {})));
}

// The images have no gdb: SIGCONT lets the program continue, as leaving gdb would.
TEST_F(FlightInContainers, TheFleetWaitsForTheDebuggedAgent) {
  const std::string agent = "uav_agent-jurong";
  const Arguments flown = arguments("kios", "20");
  Arguments debugged = flown;
  debugged.insert(debugged.end(), {"--debug", "jurong"});
  SkeinRun& run = start_up("up", debugged);
  std::string process;
  const auto told = [&] {
    const std::string log = log_of(run, agent);
    std::smatch match;
    if (!std::regex_search(log, match, std::regex("process ([0-9]+) waits for a debugger"))) return false;
    process = match[1];
    return true;
  };
  ASSERT_TRUE(eventually(told)) << run.err();
  const auto waits_for_longer_than_a_lease = [&] {
    const std::string err = run.err();
    const std::regex notice("waiting for [^\n]*\\((\\d+) s\\)");
    return std::any_of(std::sregex_iterator(err.begin(), err.end(), notice), std::sregex_iterator(),
                       [](const std::smatch& match) { return std::stoi(match[1]) > 10; });
  };
  ASSERT_TRUE(eventually(waits_for_longer_than_a_lease)) << run.err();
  EXPECT_FALSE(run.skein().ended()) << run.err();
  EXPECT_EQ(shell("docker exec " + container(run, agent) + " bash -c 'kill -CONT " + process + "'").text, "");
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  expect_whole(run);
  EXPECT_EQ(flight_of(run), alone(flown));
}

// The steps of docs/how-to-debug.md, with commands from a pipe.
TEST_F(FlightInContainers, GdbOpensInTheContainerOfTheDebuggedAgent) {
  const std::string image = "skein-agent-debug";
  if (shell("docker image inspect " + image).code != 0) {
    const std::string untested = "the engine has no image '" + image + "': not tested is gdb in a container";
    if (engine_is_required()) FAIL() << untested;
    GTEST_SKIP() << untested;
  }
  const Arguments flown = arguments("kios", "20");
  const fs::path dir = folder() / "debugged";
  Arguments words = joined(Arguments{program("skein"), "compose"}, flown);
  words = joined(words, Arguments{"--debug", "jurong=gdb", "--up", "--out", dir});
  words = joined(words, programs_of_this_build());
  const std::string commands =
      write("commands", "tbreak skein::agent::KiosPlanner::plan\ncontinue\nprint in.state.p_WB\ncontinue\n");
  ChildProcess& skein = start_program(
      "skein", {"/bin/sh", "-c", "SKEIN_AGENT_IMAGE=" + image + " exec " + shell_line(words) + " <" + commands});
  EXPECT_EQ(skein.wait().code, 0) << skein.err();
  const std::string shown = skein.out();
  EXPECT_NE(skein.err().find("jurong is in gdb here, in its container"), std::string::npos) << skein.err();
  EXPECT_NE(shown.find("Temporary breakpoint 1, skein::agent::KiosPlanner::plan"), std::string::npos) << shown;
  EXPECT_NE(shown.find("$1 = ("), std::string::npos) << shown;
  EXPECT_NE(shown.find("exited normally"), std::string::npos) << shown;
  const Json result = Json::parse(text_of(dir / "result.json"));
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
  EXPECT_EQ((Flight{result["digest"], result["score"]}), alone(flown));
}

class TwentyUavs : public FlightInContainers, public testing::WithParamInterface<std::string> {};

// The scenario is a user's file, which the image does not contain.
TEST_P(TwentyUavs, HaveTheDigestOfAFlightWithoutContainers) {
  const std::string text = cli::bench_scenario({.uavs = 20, .duration_s = 60});
  const Arguments flown = {write("twenty.yaml", text), "--planner", "patrol", "--no-oracle"};
  Arguments in_containers = flown;
  if (!GetParam().empty()) in_containers.insert(in_containers.end(), {"--subnet", GetParam()});
  const SkeinRun& run = up("up", in_containers);
  expect_whole(run);
  EXPECT_EQ(run.result()["uavs"].size(), 20u);
  static std::optional<Flight> without;
  if (!without) without = alone(flown);
  EXPECT_EQ(flight_of(run), *without);
  if (!GetParam().empty()) {
    EXPECT_NE(text_of(run.dir() / "compose.yaml").find("10.99.1.80/28"), std::string::npos)
        << "the 22nd network has another address";
  }
}

INSTANTIATE_TEST_SUITE_P(Subnets, TwentyUavs, testing::Values("", "10.99.0.0/20"),
                         [](const auto& subnet) { return subnet.param.empty() ? "of_the_engine" : "named"; });

TEST_F(FlightInContainers, PlannersInPythonFlyInAnImageThatHasIt) {
  if (shell("docker image inspect skein-agent-python").code != 0) {
    if (engine_is_required()) FAIL() << "the engine has no image 'skein-agent-python' (docker/Dockerfile)";
    GTEST_SKIP() << "no image skein-agent-python: not tested are planners in Python in containers";
  }
  const Arguments flown = arguments("patrol,jurong=py:" + source_path("python/examples/facade.py"), "30");
  const SkeinRun& run = up("up", flown);
  expect_whole(run);
  EXPECT_EQ(flight_of(run), alone(flown));
}

TEST_F(FlightInContainers, ASecuredFleetFliesTheSameAndItsKeysAreDeleted) { expect_secured({"--secure"}); }

TEST_F(FlightInContainers, ASecuredFleetFliesTheSameOverFastDds) { expect_secured({"--secure", "--dds", "fastdds"}); }

void FlightInContainers::expect_secured(const Arguments& options) {
  const Arguments flown = arguments("patrol", "60", options);
  const SkeinRun& run = up("up", flown);
  expect_whole(run);
  EXPECT_EQ(flight_of(run), alone(flown));
  const std::string file = text_of(run.dir() / "compose.yaml");
  std::smatch keys;
  ASSERT_TRUE(std::regex_search(file, keys, std::regex("source: \"([^\"]+/sim_server)\"\\s+target: \"/keys\"")))
      << file;
  EXPECT_FALSE(fs::exists(keys[1].str()));
  for (const auto& entry : fs::recursive_directory_iterator(run.dir())) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(text_of(entry.path()).find("PRIVATE KEY"), std::string::npos) << entry.path();
  }
}

}  // namespace
}  // namespace skein::test
