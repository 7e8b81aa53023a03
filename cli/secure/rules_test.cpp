// What each program may do in a secured fleet, and which certificates prove it.
#include "cli/secure/rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cli/secure/keys.hpp"
#include "core/messages/view_topics.hpp"
#include "core/topics.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

class SecurityRules : public testing::Test {
 protected:
  FleetPlan plan() const {
    RunOptions options;
    options.scenario = programs_.scenario();
    options.planner = "hover";
    return plan_fleet(options, programs_.dir());
  }
  static bool may_publish(const Rights& rights, const std::string& topic) {
    return std::ranges::find(rights.not_published, topic) == rights.not_published.end();
  }
  const FakePrograms programs_;
};

TEST_F(SecurityRules, AnAgentWritesOnlyInItsOwnDomainAndOnlyForItself) {
  const Rights rights = rights_of(plan(), "uav_agent-beta", 10);
  EXPECT_EQ(rights.first_domain, 13);
  EXPECT_EQ(rights.last_domain, 13);
  EXPECT_FALSE(may_publish(rights, topics::odometry("beta").name));
  EXPECT_FALSE(may_publish(rights, topics::step().name));
  EXPECT_FALSE(may_publish(rights, topics::ledger().name));
  EXPECT_FALSE(may_publish(rights, topics::radio_reply().name));
  EXPECT_TRUE(may_publish(rights, topics::radio_request().name));
  EXPECT_TRUE(may_publish(rights, topics::trajectory_command("beta").name));
  EXPECT_TRUE(may_publish(rights, topics::done().name));
  EXPECT_TRUE(may_publish(rights, topics::capture_stored().name));
  EXPECT_TRUE(may_publish(rights, "rt/some/radio_topic"));
}

TEST_F(SecurityRules, OnlyTheStationWritesTheScoreAndNoAgentReadsThePointIndices) {
  const auto may_read = [](const Rights& rights, const std::string& topic) {
    return std::ranges::find(rights.not_read, topic) == rights.not_read.end();
  };
  for (const char* program : {"uav_agent-gcs", "uav_agent-alpha"}) {
    const Rights rights = rights_of(plan(), program, 10);
    EXPECT_FALSE(may_read(rights, topics::score_eval().name)) << program;
    EXPECT_TRUE(may_read(rights, topics::score().name)) << program;
    EXPECT_FALSE(may_publish(rights, topics::score().name)) << program;
    // DDS Security applies the first rule that fits, so this rule must come before the one for "everything".
    const std::string text = permissions("CN=" + std::string(program), rights);
    const std::size_t denied = text.find("<deny_rule>"), allowed = text.find("<allow_rule>");
    ASSERT_LT(denied, allowed) << text;
    const std::string first = text.substr(denied, allowed - denied), topic = "<topic>rt/score_eval</topic>";
    EXPECT_LT(first.find("<subscribe>"), first.find(topic, first.find("<subscribe>"))) << first;
    EXPECT_NE(first.find(topic, first.find("<subscribe>")), std::string::npos) << first;
  }
  EXPECT_FALSE(may_publish(rights_of(plan(), "comm_router", 10), topics::score().name));
  const Rights station = rights_of(plan(), "station", 10);
  EXPECT_TRUE(may_publish(station, topics::score().name) && may_publish(station, topics::score_eval().name));
}

TEST_F(SecurityRules, OnlyTheServerWritesTheServersTopics) {
  for (const char* program : {"comm_router", "station"}) {
    const Rights rights = rights_of(plan(), program, 10);
    for (const auto& topic : {topics::step(), topics::ledger(), topics::odometry("alpha"), topics::capture()}) {
      EXPECT_FALSE(may_publish(rights, topic.name)) << program << ' ' << topic.name;
    }
  }
  EXPECT_TRUE(rights_of(plan(), "sim_server", 10).not_published.empty());
  EXPECT_FALSE(may_publish(rights_of(plan(), "comm_router", 10), topics::trajectory_command("alpha").name));
  EXPECT_FALSE(may_publish(rights_of(plan(), "station", 10), topics::routed().name));
  for (const char* program : {"comm_router", "station"}) {  // in a run that a viewer watches
    for (const auto& topic : {topics::view_story(), topics::view_state(), topics::view_cloud()}) {
      EXPECT_FALSE(may_publish(rights_of(plan(), program, 10), topic.name)) << program << ' ' << topic.name;
    }
  }
  EXPECT_TRUE(may_publish(rights_of(plan(), "station", 10), topics::view_orders().name));
  EXPECT_FALSE(may_publish(rights_of(plan(), "comm_router", 10), topics::view_orders().name));
  EXPECT_FALSE(may_publish(rights_of(plan(), "comm_router", 10), topics::flight_map("alpha").name));
  EXPECT_EQ(rights_of(plan(), "station", 10).last_domain, 11);
  EXPECT_EQ(rights_of(plan(), "comm_router", 10).last_domain, 13);
}

TEST(SecurityKeys, EveryIdentityHasItsOwnKeyAndItsSubject) {
  const Authority authority("identities");
  const Identity one = authority.issue("station"), other = authority.issue("station");
  EXPECT_EQ(one.subject, "CN=station,O=Skein,C=NL");
  EXPECT_NE(one.key, other.key);
  EXPECT_NE(one.certificate, other.certificate);
  EXPECT_NE(authority.certificate(), Authority("identities").certificate());
}

// OpenSSL limits a name in a certificate to 64 letters, and so does the scenario that of a UAV.
TEST(SecurityKeys, ProgramsOfUavsWithTheLongestNamesHaveDifferentSubjects) {
  const Authority authority("identities");
  const std::string uav(63, 'x');
  const std::string one = authority.issue("uav_agent-" + uav + "1").subject;
  const std::string other = authority.issue("uav_agent-" + uav + "2").subject;
  EXPECT_EQ(one.find("CN=uav_agent-xxx"), 0U) << one;
  EXPECT_NE(one, other);
  EXPECT_EQ(authority.issue("uav_agent-" + uav + "1").subject, one);
}

TEST(SecurityKeys, ADocumentIsSignedAsText) {
  const std::string text = permissions("CN=a,O=Skein,C=NL", {3, 3, {"rt/skein/step"}});
  const std::string signed_text = Authority("permissions").sign(text);
  EXPECT_NE(signed_text.find("multipart/signed"), std::string::npos);
  EXPECT_NE(signed_text.find("<topic>rt/skein/step</topic>"), std::string::npos);
  EXPECT_EQ(signed_text.find("PRIVATE"), std::string::npos);
}

}  // namespace
}  // namespace skein::cli
