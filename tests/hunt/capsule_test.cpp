// `skein run CAPSULE.yaml` reports the find's result, even if it also flies a run without faults for comparison.
#include "fleet_fixture.hpp"

namespace skein::test {
namespace {

using Capsule = FleetTest;

/// Its property compares the score with that of a second run, without the outage: at least nine tenths of it.
constexpr const char* kShare = R"(# fault test
name: share
run: {scenario: towers, planner: patrol, seed: 0, uavs: 2, duration_s: 40}
faults:
  - {at_s: 10, station_outage: true}
properties:
  most: eventually score >= 90 % * undisturbed_score after 15 s
capsule: {property: most, skein: '0.1.0', command: skein hunt towers}
)";

TEST_F(Capsule, ReportsTheScoreOfTheFindAndNotOfTheRunWithoutFaults) {
  // The variable applies to missions without a duration; a capsule has one.
  ChildProcess& run = start_program(
      "share", {program("skein"), "run", write("share.yaml", kShare), "--one-process", "--out", folder() / "find"},
      {{"SKEIN_DURATION", "20"}});
  EXPECT_EQ(run.wait().code, 1) << run.out() << run.err();
  const Json find = Json::parse(text_of(folder() / "find" / "result.json"));
  EXPECT_FALSE(find["faults"].empty());
  EXPECT_EQ(find["mission_time_s"], 40.0);
  char score[32];
  std::snprintf(score, sizeof score, "%.3f", find["score"].get<double>());
  const std::string out = run.out(), told = "this run, with its faults: score " + std::string(score) + ", results in " +
                                            (folder() / "find").string() + "\nmost fails: ";
  EXPECT_NE(out.find(told), std::string::npos) << out;
  // There is one table, that of the find, and no score after these words.
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  EXPECT_EQ(count(out, "digest    "), 1u) << out;
  EXPECT_EQ(out.find("score ", out.find(told) + told.size()), std::string::npos) << out;
  // The launcher announces the second run before the messages of that run, and its end after them.
  const std::string err = run.err();
  const std::size_t first = err.find("first run, the find itself, with its faults"),
                    second = err.find("second run, without the faults"), over = err.find("the second run has ended");
  EXPECT_LT(first, second) << err;
  EXPECT_LT(second, over) << err;
  EXPECT_EQ(err.find("score", over), std::string::npos) << err;
}

// The capsule defines the flight: options that would change it are refused.
TEST_F(Capsule, RefusesOptionsThatWouldChangeTheFlight) {
  const std::string capsule = write("share.yaml", kShare);
  const std::vector<Arguments> refused = {{"--duration", "20"},
                                          {"--planner", "kios"},
                                          {"--seed", "3"},
                                          {"--uavs", "4"},
                                          {"--clock", "realtime"},
                                          {"--secure"},
                                          {"--rules", "paper"},
                                          {"--cores"},
                                          {"--debug", "jurong=wait"},
                                          {"--stop-at", "10"},
                                          {"--faults", "nobody.yaml"},
                                          {"--scene-seed", "2"},
                                          {"--place", "jurong=host"}};
  const auto expect_refusal = [&](const Arguments& more, const Environment& environment) {
    ChildProcess& run = start_program(
        "refused", joined({program("skein"), "run", capsule, "--out", folder() / "none"}, more), environment);
    EXPECT_EQ(run.wait().code, 2) << more[0] << run.out() << run.err();
    EXPECT_NE(run.err().find(more[0] + " cannot be used with a capsule"), std::string::npos) << run.err();
  };
  for (const Arguments& more : refused) expect_refusal(more, {});
  for (const char* usual : {"20", "30"}) expect_refusal({"--duration", "20"}, {{"SKEIN_DURATION", usual}});
  EXPECT_FALSE(std::filesystem::exists(folder() / "none"));
}

}  // namespace
}  // namespace skein::test
