// A fleet whose containers are killed or paused from outside, or lose their network for a while.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <random>
#include <regex>

#include "container_fixture.hpp"

namespace skein::test {
namespace {

class FromOutside : public Containers {
 protected:
  /// @returns the step at which `member` last rejoined; 0: it has not rejoined
  static long returned_at(const SkeinRun& run, const std::string& member) {
    const std::string log = log_of(run, "sim_server");
    const std::regex again(member + " joined again at step (\\d+)");
    long step = 0;
    for (std::sregex_iterator it(log.begin(), log.end(), again), end; it != end; ++it) step = std::stol((*it)[1]);
    return step;
  }
  /// Whether captures that `uav` took after this step were delivered.
  static bool delivers_after(const SkeinRun& run, const std::string& uav, long step) {
    return std::ranges::any_of(read_csv(run.dir() / "captures.csv"), [&](const auto& capture) {
      return capture.at("uav") == uav && std::stod(capture.at("time_s")) > 0.05 * static_cast<double>(step) &&
             !capture.at("delivered_at_s").empty();
    });
  }
  /// Whether all lost members have rejoined.
  static bool all_are_back(const Json& result) {
    return std::ranges::all_of(result["lost_members"], [](const Json& lost) { return lost["back_at_s"].is_number(); });
  }
  /// Expects the run to be the same as without the disturbance, or to name its lost members.
  void expect_same_or_named_loss(SkeinRun& run, const Arguments& flown) {
    const int code = run.exit_code();
    const Json result = run.result();
    EXPECT_EQ(result["status"], "completed") << run.err();
    if (result["lost_members"].empty()) {
      EXPECT_EQ(code, 0) << run.err();
      EXPECT_EQ(flight_of(run), alone(flown));
    } else {
      EXPECT_EQ(code, all_are_back(result) ? 0 : 3) << run.err();
      EXPECT_TRUE(result["digest"].is_null());
      EXPECT_NE(log_of(run, "sim_server").find(" is lost at step"), std::string::npos);
    }
    expect_complete_result(run);
  }
  static std::string in_network_of(const std::string& id) {
    return "nsenter --net --target " + shell("docker inspect --format '{{.State.Pid}}' " + id).text + " ";
  }
};

TEST_F(FromOutside, AProgramThatIsKilledAndStartedAgainWorksAgain) {
  SkeinRun& run = start_up("up", arguments("patrol", "300"));
  ASSERT_TRUE(run.wait_until_flying()) << run.err();
  std::vector<std::string> victims = {"uav_agent-changi", "station", "comm_router"};
  std::ranges::shuffle(victims, std::mt19937(std::random_device{}()));
  SCOPED_TRACE("killed: " + victims[0] + ", " + victims[1] + ", " + victims[2]);
  std::map<std::string, long> returned;
  for (const std::string& victim : victims) {
    const std::string id = container(run, victim), member = victim.substr(victim.find('-') + 1);
    ASSERT_EQ(shell("docker kill " + id + " && docker start " + id).code, 0) << victim;
    EXPECT_TRUE(eventually([&] { return (returned[member] = returned_at(run, member)) > 0 || run.skein().ended(); }));
    EXPECT_GT(returned[member], 0) << victim << ": " << log_of(run, "sim_server");
  }
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  const Json result = run.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_EQ(result["lost_members"].size(), victims.size()) << result["lost_members"];
  EXPECT_TRUE(all_are_back(result)) << result["lost_members"];
  expect_complete_result(run);
  EXPECT_TRUE(delivers_after(run, "changi", returned["changi"]));
  EXPECT_NE(log_of(run, "uav_agent-changi").find("the container was started again"), std::string::npos);
  for (const char* uav : {"sentosa", "nanyang"}) {
    EXPECT_TRUE(delivers_after(run, uav, std::ranges::max(returned["station"], returned["comm_router"]))) << uav;
  }
  // The killed station has lost no delivered capture. Captures of the last moments may not have arrived yet.
  EXPECT_GE(result["score"].get<double>(), 0.99 * result["score_earned"].get<double>()) << result["losses"];
}

TEST_F(FromOutside, AProgramThatIsPausedForAMomentIsNotLost) {
  const Arguments flown = arguments();
  SkeinRun& run = start_up("up", flown);
  const std::string id = flying(run, "uav_agent-changi");
  EXPECT_EQ(shell("docker pause " + id + " && sleep 3 && docker unpause " + id).code, 0);
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  expect_whole(run);
  EXPECT_EQ(flight_of(run), alone(flown));
}

// The pause is longer than the program's lease: the server drops the UAV, which must join again.
TEST_F(FromOutside, AProgramThatIsPausedForLongIsLostAndComesBack) {
  SkeinRun& run = start_up("up", arguments("patrol", "300"));
  const std::string id = flying(run, "uav_agent-changi");
  EXPECT_EQ(shell("docker pause " + id + " && sleep 13 && docker unpause " + id).code, 0);
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  const Json result = run.result();
  EXPECT_EQ(result["status"], "completed");
  ASSERT_EQ(result["lost_members"].size(), 1u) << result["lost_members"];
  EXPECT_EQ(result["lost_members"][0]["member"], "changi");
  EXPECT_TRUE(all_are_back(result)) << result["lost_members"];
  expect_complete_result(run);
  EXPECT_GT(returned_at(run, "changi"), 0) << log_of(run, "sim_server");
  EXPECT_TRUE(delivers_after(run, "changi", returned_at(run, "changi")));
}

TEST_F(FromOutside, LostPacketsAreSentAgain) {
  const Arguments flown = arguments();
  SkeinRun& run = start_up("up", flown);
  const std::string network = in_network_of(flying(run, "uav_agent-changi"));
  std::string rules = "true";
  for (const char* chain : {"INPUT -i eth0", "OUTPUT -o eth0"}) {
    rules +=
        fmt::format(" && {}iptables --append {} -m statistic --mode random --probability 0.05 -j DROP", network, chain);
  }
  const Answer cut = shell(rules);
  expect_same_or_named_loss(run, flown);
  if (cut.code != 0) GTEST_SKIP() << "no nsenter or iptables; the loss of packets is not tested: " << cut.text;
}

TEST_F(FromOutside, ALinkThatIsDownForAMomentDoesNotChangeTheFlight) {
  const Arguments flown = arguments();
  SkeinRun& run = start_up("up", flown);
  const Answer link = shell(in_network_of(flying(run, "uav_agent-changi")) + "ip -oneline link show eth0");
  std::smatch match;
  Answer pulled = link;
  // This host's end of the link: "eth0@if7" in the container is the peer of interface 7 on this host.
  if (std::regex_search(link.text, match, std::regex("eth0@if(\\d+)"))) {
    pulled = shell("end=$(ip -oneline link | sed -n 's/^" + match[1].str() +
                   ": \\([^@]*\\)@.*/\\1/p') && ip link set \"$end\" down && sleep 2 && ip link set \"$end\" up");
  }
  expect_same_or_named_loss(run, flown);
  if (pulled.code != 0) GTEST_SKIP() << "a link that goes down is not tested: " << pulled.text;
}

}  // namespace
}  // namespace skein::test
