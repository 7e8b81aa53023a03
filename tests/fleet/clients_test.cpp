// Programs that are not Skein's own, and programs that hang.
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "by_hand_fixture.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/topics.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

using topics::WireTopic;

class Clients : public FleetTest {
 protected:
  /// Starts a run that waits for the agent of `uav`, so that a test can use its domains before the flight.
  SkeinRun& waiting_for(const std::string& name, const std::string& uav, Arguments arguments) {
    arguments.insert(arguments.end(), {"--debug", uav});
    SkeinRun& run = start(name, arguments);
    EXPECT_TRUE(run.wait_for("gdb --args")) << run.err();
    return run;
  }

  /// Starts the agent with the command that the launcher printed, without gdb.
  ChildProcess& start_printed_command(const SkeinRun& run) {
    return start_program("agent", {"/bin/sh", "-c", run.debug_command()});
  }
};

/// Samples that a program outside the fleet receives in one domain.
class Listener {
 public:
  explicit Listener(std::filesystem::path file) : file_(std::move(file)) {}

  Arguments command(int domain, const std::vector<WireTopic>& topics) const {
    Arguments argv = {helper_program("radio_listener"), "fastdds", std::to_string(domain), file_};
    for (const WireTopic& topic : topics) argv.insert(argv.end(), {topic.name, topic.type});
    return argv;
  }
  long writers(const WireTopic& topic) const { return entry(topic).first; }
  long samples(const WireTopic& topic) const { return entry(topic).second; }

 private:
  std::pair<long, long> entry(const WireTopic& topic) const {
    std::istringstream text(text_of(file_));
    std::pair<long, long> numbers;
    for (std::string name; text >> name >> numbers.first >> numbers.second;) {
      if (name == topic.name) return numbers;
    }
    return {0, 0};
  }
  std::filesystem::path file_;
};

long delivered(const Json& result, const std::string& from, const std::string& to) {
  for (const Json& link : result["radio"]["per_link"]) {
    if (link["from"] == from && link["to"] == to) return link["delivered"];
  }
  return 0;
}

/// Topics that other UAVs must not receive: those in this UAV's own domain, and some others.
std::vector<WireTopic> private_topics(const std::string& uav) {
  return {topics::odometry(uav),
          topics::gimbal(uav),
          topics::cloud(uav),
          topics::lidar_servo(uav),
          topics::self_keyframe(uav),
          topics::neighbour_odometry(uav),
          topics::detected_points(uav),
          topics::trajectory_command(uav),
          topics::captures(uav),
          topics::captures_at_station(uav),
          topics::captures_ack_at_uav(uav),
          topics::score(),
          topics::score_eval(),
          topics::ledger(),
          topics::routed(),
          topics::attached(),
          topics::drop()};
}

TEST_F(Clients, AProgramOutsideTheFleetReceivesOnlyWhatTheRouterForwards) {
  // The fault loses all messages about maps, so that the links count only capture reports and acknowledgements.
  const auto faults = write("no_plans.yaml", "faults:\n  - {at_s: 0, link: {loss: 1, topics: [/plan]}}\n");
  SkeinRun& run =
      waiting_for("run", "nanyang", {"towers", "--planner", "patrol", "--duration", "90", "--faults", faults.string()});
  const int base = run.domains().first;
  const WireTopic acks = topics::captures_ack_at_uav("nanyang"), own = topics::odometry("nanyang");
  const auto forbidden = private_topics("raffles");

  std::vector<WireTopic> at_uav = {acks, own}, at_gcs;
  at_uav.insert(at_uav.end(), forbidden.begin(), forbidden.end());
  for (const std::string& uav : kFleet) at_gcs.push_back(topics::captures_at_station(uav));
  for (const WireTopic& topic : {topics::odometry("nanyang"), topics::captures("nanyang"), topics::ledger()}) {
    at_gcs.push_back(topic);
  }
  const Listener uav_listener(folder() / "uav_heard"), gcs_listener(folder() / "gcs_heard");
  start_program("uav_listener", uav_listener.command(uav_domain(base, UavIndex{4}), at_uav));
  start_program("gcs_listener", gcs_listener.command(gcs_domain(base), at_gcs));
  // The fleet waits for nanyang's agent, so no message is sent before the listeners have matched.
  ASSERT_TRUE(eventually([&] { return uav_listener.writers(acks) == 1 && uav_listener.writers(own) == 1; }));
  ASSERT_TRUE(eventually([&] {
    return std::all_of(kFleet.begin(), kFleet.end(), [&](const std::string& uav) {
      return gcs_listener.writers(topics::captures_at_station(uav)) == 1;
    });
  }));
  start_printed_command(run);
  EXPECT_EQ(run.exit_code(), 0) << run.err();

  const Json result = run.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_TRUE(result["deterministic"]) << "a listener outside the fleet changed the run";
  const long acknowledged = delivered(result, "gcs", "nanyang");
  ASSERT_GT(acknowledged, 0) << "the station sent nanyang no message to listen to";
  // The fleet does not wait for a program outside the lock-step. A writer of another vendor may take a second to match
  // it, and the whole flight takes two; samples that it has not requested again when the router leaves are lost.
  const auto hears = [](const Listener& listener, const WireTopic& topic, long sent) {
    eventually([&] { return listener.samples(topic) >= sent; }, std::chrono::seconds(2));
    EXPECT_LE(listener.samples(topic), sent) << topic.name;
    EXPECT_GE(3 * listener.samples(topic), sent) << topic.name;
  };
  hears(uav_listener, acks, acknowledged);
  EXPECT_GT(uav_listener.samples(own), 1000) << "a listener in a UAV's domain must receive the UAV's own topics";
  for (const WireTopic& topic : forbidden) EXPECT_EQ(uav_listener.samples(topic), 0) << topic.name;
  for (const std::string& uav : kFleet) {
    hears(gcs_listener, topics::captures_at_station(uav), delivered(result, uav, "gcs"));
  }
  for (const WireTopic& topic : {topics::odometry("nanyang"), topics::captures("nanyang"), topics::ledger()}) {
    EXPECT_EQ(gcs_listener.samples(topic), 0) << topic.name;
  }
}

const std::string kForeignPlanner = "hover,sentosa=exec:" + helper_program("minimal_client");

TEST_F(Clients, AForeignClientTakesPartInTheLockStep) {
  std::set<std::string> digests;
  for (const std::string vendor : {"cyclonedds", "fastdds"}) {
    const bool tells = vendor == "fastdds";
    SkeinRun& done = run(
        vendor, {"towers", "--duration", "20", "--dds", vendor, "--planner", kForeignPlanner + (tells ? " tell" : "")});
    const Json result = done.result();
    EXPECT_EQ(result["status"], "completed");
    EXPECT_TRUE(result["deterministic"]);
    EXPECT_TRUE(result["lost_members"].empty());
    EXPECT_NEAR(result["uavs"][2]["distance_m"].get<double>(), 3.0, 0.5)
        << "the foreign client's commands had no effect";
    EXPECT_EQ(result["uavs"][2]["commands_rejected"], 0);
    digests.insert(done.digest());
    const std::string activity = text_of(done.dir() / "activity.csv"), said = ",sentosa,hovers; all by itself,";
    EXPECT_EQ(activity.find(said) != std::string::npos, tells) << activity;
    EXPECT_EQ(activity.find(said), activity.rfind(said))
        << "the client reports one activity, which must be listed once";
    EXPECT_EQ(activity.find(",sentosa,") != std::string::npos, tells)
        << "activities of the client are listed exactly if it reports them";
    EXPECT_NE(activity.find(",jurong,"), std::string::npos);
  }
  EXPECT_EQ(digests.size(), 1u) << "neither the vendor nor reported activities may change the run";
}

TEST_F(Clients, AnnouncedDebugValuesThatAreNotReadAreNamed) {
  SkeinRun& done = run("run", {"towers", "--duration", "5", "--planner", kForeignPlanner + " announce"});
  const std::string log = text_of(done.dir() / "sim_server.log"), what = "sentosa announces the topic '";
  const std::size_t said = log.find(what + "rt/sentosa/debug/n64', which sim_server does not read");
  ASSERT_NE(said, std::string::npos) << log;
  EXPECT_NE(log.find("at most 64 of a UAV", said), std::string::npos) << log;
  EXPECT_EQ(log.find(what), log.rfind(what)) << "the server repeats its message";
}

TEST_F(Clients, AForeignClientThatDiesIsReportedLikeAnyProgram) {
  SkeinRun& run = start("run", {"towers", "--duration", "60", "--planner", kForeignPlanner});
  ASSERT_TRUE(run.wait_until_flying()) << run.err();
  ::kill(processes_of(run.dir()).at("uav_agent-sentosa"), SIGKILL);
  EXPECT_EQ(run.exit_code(), 3) << run.err();
  EXPECT_NE(run.err().find("uav_agent-sentosa failed: "), std::string::npos) << run.err();
  expect_complete_result(run);
  EXPECT_EQ(run.result()["status"], "completed");
  ASSERT_EQ(run.result()["lost_members"].size(), 1u);
  EXPECT_EQ(run.result()["lost_members"][0]["member"], "sentosa");
}

class Hanging : public ByHand, public testing::WithParamInterface<std::string> {};

TEST_P(Hanging, ProgramIsDroppedAndTheRunGoesOn) {
  // The leases are longer than the timeout of an answer.
  start_fleet({.all = {"--duration", "40", "--lease", "60"}, .server = {"--agent-timeout", "12"}});
  ASSERT_TRUE(eventually([&] { return is_flying(dir_); }));
  ChildProcess& victim = *fleet_.at(GetParam());
  victim.signal(SIGSTOP);
  expect_run_without(GetParam(), "did not answer");
  victim.signal(SIGCONT);
  EXPECT_EQ(victim.wait().code, 3) << "the victim must notice that the fleet continued without it";
}

INSTANTIATE_TEST_SUITE_P(Programs, Hanging, testing::Values("uav_agent-changi", "comm_router"), [](const auto& victim) {
  std::string name = victim.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

class Lying : public ByHand, public testing::WithParamInterface<std::string> {};

TEST_P(Lying, ClientIsDroppedAndTheRunGoesOn) {
  start_fleet({.all = {"--duration", "40"}, .server = {"--agent-timeout", "12"}},
              {{"uav_agent-sentosa", {helper_program("minimal_client"), GetParam()}}});
  expect_run_without("uav_agent-sentosa",
                     GetParam() == "boast" ? "rt/sentosa/command/trajectory 41 of 42" : "sent more than it announced");
  if (GetParam() == "smuggle") {
    const Json report = Json::parse(text_of(dir_ / "sim_server.report.json"));
    const std::string reason = report["lost_members"][0]["reason"];
    EXPECT_NE(reason.find(" samples on rt/sentosa/command/trajectory, "), std::string::npos) << reason;
    long sent = 0, announced = 0;
    ASSERT_EQ(
        std::sscanf(reason.c_str(), "sent more than it announced: %ld samples on rt/sentosa/command/trajectory, %ld",
                    &sent, &announced),
        2)
        << reason;
    EXPECT_EQ(sent, announced + 1);
  }
  ChildProcess& client = *fleet_.at("uav_agent-sentosa");
  EXPECT_EQ(client.wait().code, 3);
  EXPECT_NE(client.err().find("sim_server gave this program up"), std::string::npos) << client.err();
}

INSTANTIATE_TEST_SUITE_P(Clients, Lying, testing::Values("smuggle", "boast"),
                         [](const auto& lie) { return lie.param; });

}  // namespace
}  // namespace skein::test
