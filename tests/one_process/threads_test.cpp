// A flight in one process has the same digest with any number of threads. Planners, conditions, seeds and faults are
// drawn at random.
#include "core/math/random_stream.hpp"
#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_program.hpp"

namespace skein::test {
namespace {

class Threads : public FleetTest, public testing::WithParamInterface<std::size_t> {};

/// Faults at random times: programs that are killed and come back, or are paused for a while.
std::string drawn_faults(RandomStream& random) {
  std::string text = "faults:\n";
  for (const std::string& uav : kFleet) {
    const std::uint64_t kind = random.bits() % 4, from_s = 2 + random.bits() % 8;
    const std::string times = "{at_s: " + std::to_string(from_s) + ", until_s: " + std::to_string(from_s + 2);
    const bool is_killed = kind == 0 || uav == "jurong";
    if (is_killed) text += "  - " + times + ", kill: " + uav + "}\n";
    if (kind == 1 && !is_killed) text += "  - " + times + ", pause: " + uav + "}\n";
  }
  return text;
}

TEST_P(Threads, DoNotChangeTheDigest) {
  if (!has_turn(GetParam(), 3)) GTEST_SKIP() << "not its turn";
  RandomStream random(GetParam(), "threads", 0);
  const std::vector<std::string> planners = {"patrol", "kios", "xxh", "star", "flock"};
  std::string planner = planners[random.bits() % planners.size()];
  for (const std::string& uav : kFleet) planner += "," + uav + "=" + planners[random.bits() % planners.size()];
  const std::string conditions = random.bits() % 2 == 0 ? "none" : "harsh";
  const Arguments flight = {"towers",       "--one-process",
                            "--no-oracle",  "--no-report",
                            "--duration",   sanitizer() == "thread" ? "8" : "20",
                            "--planner",    planner,
                            "--conditions", conditions,
                            "--seed",       std::to_string(random.bits() % 1000),
                            "--faults",     write("faults.yaml", drawn_faults(random))};
  std::set<std::string> digests;
  for (const std::string threads : {"1", "2", "16"}) {
    Arguments more = flight;
    more.insert(more.end(), {"--threads", threads});
    SkeinRun& run = this->run("threads" + threads, more);
    digests.insert(run.digest());
    EXPECT_EQ(run.digest().size(), 64U) << run.err();
    EXPECT_GT(run.result()["timing"]["steps"].get<int>(), 100);
  }
  EXPECT_EQ(digests.size(), 1U) << planner << " under " << conditions;
}

INSTANTIATE_TEST_SUITE_P(Drawn, Threads, testing::Range(std::size_t{1}, std::size_t{10}));

}  // namespace
}  // namespace skein::test
