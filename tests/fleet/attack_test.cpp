// Attacks on a run: programs of another run in its domains, a ground program that forges the station's messages, and
// SIGSTOP and SIGCONT from outside.
#include <signal.h>

#include <algorithm>
#include <random>

#include "core/topics.hpp"
#include "fleet_fixture.hpp"
#include "tests/free_domain.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

constexpr int kAttempts = 5;

class Attack : public FleetTest, public testing::WithParamInterface<std::string> {
 protected:
  SkeinRun& fly_a_minute(const std::string& name, const std::string& planner, const Arguments& more = {}) {
    Arguments arguments = {"towers", "--planner", planner, "--duration", "60", "--dds", GetParam()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(name, arguments);
  }

  /// Starts a client of another run in the domain of each UAV. Call it before the fleet starts.
  std::vector<ChildProcess*> start_leftover_clients(int base) {
    std::vector<ChildProcess*> clients;
    for (std::size_t i = 0; i < kFleet.size(); ++i) {
      clients.push_back(&start_program("leftover_" + kFleet[i], {helper_program("minimal_client")},
                                       {{"SKEIN_RUN", "7"},
                                        {"SKEIN_DOMAIN", std::to_string(uav_domain(base, UavIndex(i)))},
                                        {"SKEIN_UAV", kFleet[i]},
                                        {"SKEIN_DDS", GetParam()}}));
    }
    return clients;
  }
};

TEST_P(Attack, TheServerIgnoresClientsThatAnotherRunLeftBehind) {
  const std::string digest = fly_a_minute("alone", "patrol").digest();
  // The clients hold no lock, so another test's fleet may take the domains first. Then the test tries other domains.
  for (int attempt = 1; attempt <= kAttempts; ++attempt) {
    const int base = FreeDomains(2 + static_cast<int>(kFleet.size())).base();
    const std::vector<ChildProcess*> leftover = start_leftover_clients(base);
    SkeinRun& visited = start(
        "visited" + std::to_string(attempt),
        {"towers", "--planner", "patrol", "--duration", "60", "--dds", GetParam(), "--domain", std::to_string(base)});
    const bool taken =
        visited.exit_code() == 2 && visited.err().find("another one of this host uses domain") != std::string::npos;
    if (taken && attempt < kAttempts) {
      for (ChildProcess* client : leftover) client->signal(SIGKILL);
      continue;
    }
    ASSERT_EQ(visited.exit_code(), 0) << visited.err();
    EXPECT_EQ(visited.digest(), digest);
    EXPECT_TRUE(visited.result()["lost_members"].empty());
    EXPECT_NE(text_of(visited.dir() / "sim_server.log").find("takes part in another run (7,"), std::string::npos)
        << "the server has not reported the clients of the other run";
    return;
  }
}

TEST_P(Attack, AUavIgnoresForgedAcknowledgements) {
  SkeinRun& alone = fly_a_minute("alone", "patrol");
  ASSERT_GT(alone.result()["score"], 0.0);
  std::string forger = "patrol,gcs=exec:" + helper_program("forger");
  for (const std::string& uav : kFleet) forger += " " + uav;
  SkeinRun& forged = fly_a_minute("forged", forger);
  EXPECT_TRUE(forged.result()["lost_members"].empty())
      << "the forger does not join the lock-step, so it cannot be lost";
  EXPECT_EQ(forged.result()["score"], alone.result()["score"]);
  EXPECT_EQ(forged.digest(), alone.digest()) << "a UAV has received forged acknowledgements";
}

TEST_P(Attack, AProgramThatIsPausedForAWhileIsNotLost) {
  SkeinRun& flying = start("run", {"towers", "--planner", "patrol", "--duration", "120", "--dds", GetParam()});
  ASSERT_TRUE(flying.wait_until_flying()) << flying.err();
  const auto found = processes_of(flying.dir());
  std::vector<std::string> victims = {"sim_server", "comm_router", "station", "uav_agent-changi"};
  std::mt19937 random(std::random_device{}());
  std::ranges::shuffle(victims, random);
  std::string order;
  for (const std::string& victim : victims) order += " " + victim;
  SCOPED_TRACE("order:" + order);
  for (const std::string& victim : victims) ::kill(found.at(victim), SIGSTOP);
  // The pause is longer than the lease of Cyclone DDS without settings (10 s).
  EXPECT_FALSE(eventually([&] { return flying.skein().ended().has_value(); }, std::chrono::seconds(12)));
  for (const std::string& victim : victims) ::kill(found.at(victim), SIGCONT);
  EXPECT_EQ(flying.exit_code(), 0) << flying.err();
  EXPECT_EQ(flying.result()["status"], "completed");
  EXPECT_TRUE(flying.result()["lost_members"].empty()) << flying.result()["lost_members"];
  EXPECT_TRUE(flying.result()["deterministic"]);
}

INSTANTIATE_TEST_SUITE_P(Vendors, Attack, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

}  // namespace
}  // namespace skein::test
