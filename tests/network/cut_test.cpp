// The network between two hosts is cut during a flight. With a lease longer than the cut, nothing happens. With a
// shorter one, the server drops the UAV and names the network as the reason, not a violation of the protocol.
#include <signal.h>

#include <stdexcept>

#include "fleet_fixture.hpp"
#include "hosts.hpp"
#include "small_scene.hpp"
#include "tests/free_domain.hpp"

namespace skein::test {
namespace {

/// A fleet whose agent of changi is a user's command on another host.
class Cut : public FleetTest {
 protected:
  void SetUp() override {
    if (!hosts_.there()) GTEST_SKIP() << "network namespaces need root, and a kernel and an `ip` that have them";
    try {
      hosts_.connect(0, {"fleet", "changi"});
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << "no bridges between network namespaces here: " << error.what();
    }
  }

  std::string network() const {
    return "{usual: {peers: [" + hosts_.address(0, "fleet") + ", " + hosts_.address(0, "changi") + "]}}";
  }
  /// @param lease_s  lease of changi's agent [s]; the other programs have the launcher's default.
  ChildProcess& fly(int lease_s) {
    const std::string domain = std::to_string(domains_.base());
    std::string agent = "exec";
    for (const std::string& word :
         hosts_.on("changi", {program("uav_agent"), "--scenario", scene_, "--duration", "2000", "--domain", domain,
                              "--uav", "changi", "--planner", "hover", "--network", network(), "--lease",
                              std::to_string(lease_s), "--out", folder()})) {
      agent += " '" + word + "'";
    }
    return start_program("fleet",
                         hosts_.on("fleet", {program("skein"), "run", scene_, "--planner", "hover,changi=exec:" + agent,
                                             "--duration", "2000", "--domain", domain, "--network", network(),
                                             "--agent-timeout", "20", "--no-oracle", "--no-report", "--out", dir_}));
  }
  void cut(ChildProcess& fleet) {
    ASSERT_TRUE(eventually([&] { return is_flying(dir_) || fleet.ended(); }));
    ASSERT_FALSE(fleet.ended()) << fleet.err();
    ASSERT_TRUE(hosts_.run("changi", "ip link set eth0 down"));
    EXPECT_TRUE(eventually([&] { return log().find("waiting for changi to answer (5 s)") != std::string::npos; }))
        << log();
    ASSERT_TRUE(hosts_.run("changi", "ip link set eth0 up"));
  }
  std::string log() const { return text_of(dir_ / "sim_server.log"); }
  Json end(ChildProcess& fleet) {
    fleet.signal(SIGINT);
    fleet.wait();
    return Json::parse(text_of(dir_ / "result.json"), nullptr, false);
  }

  Hosts hosts_{{"fleet", "changi"}};
  const FreeDomains domains_{4};
  const std::string scene_ = write_small_scene(folder());
  const std::filesystem::path dir_ = folder() / "run";
};

TEST_F(Cut, WithAShorterLeaseTheUavIsLostBecauseOfTheNetwork) {
  ChildProcess& fleet = fly(1);
  cut(fleet);
  EXPECT_TRUE(eventually([&] { return log().find("changi is lost") != std::string::npos; })) << log();
  const Json lost = end(fleet)["lost_members"];
  ASSERT_EQ(lost.size(), 1U) << lost;
  const std::string reason = lost[0]["reason"];
  EXPECT_NE(reason.find("; the network was cut for longer than its lease, and it is back since"), std::string::npos)
      << reason;
  EXPECT_EQ(reason.find("more than it announced"), std::string::npos) << reason;
}

TEST_F(Cut, WithALongerLeaseTheUavIsNotLost) {
  ChildProcess& fleet = fly(600);
  cut(fleet);
  const auto size = std::filesystem::file_size(dir_ / "trajectories.csv");
  EXPECT_TRUE(eventually([&] { return std::filesystem::file_size(dir_ / "trajectories.csv") > size + 20'000; }))
      << log();
  const Json result = end(fleet);
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
}

}  // namespace
}  // namespace skein::test
