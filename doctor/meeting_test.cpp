#include "doctor/meeting.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <sstream>

#include "process/program.hpp"

namespace skein::doctor {
namespace {

using Random = std::mt19937_64;

constexpr double kNow = 1.7e9;
constexpr std::size_t kLarge = 1472;

/// The state of one peer, and of the network between it and this host, in one domain.
struct Way {
  bool small = true, large = true, dds = true, hears_us = true;
  int base = 1;
  std::string at = "10.0.0.1";
  double clock_ahead_s = 0.0;
  std::vector<std::string> vendors = {"cyclonedds"};
};

/// A meeting with `ways.size()` other hosts. The name of each resolves to an address.
Meetings meeting_of(const std::vector<Way>& ways) {
  Meetings all{.id = 1, .name = "we"};
  Meeting world{.domain = "world", .number = 1, .base = 1, .address = "10.0.0.1", .largest = kLarge};
  world.vendors = {"cyclonedds"};
  world.peers.push_back({"we", "10.0.0.1", "10.0.0.1"});
  for (std::size_t i = 0; i < ways.size(); ++i) {
    world.peers.push_back({"host" + std::to_string(i), "10.0.0." + std::to_string(i + 2), "10.0.0.1"});
  }
  all.domains.push_back(world);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Way& way = ways[i];
    const std::string address = *world.peers[i + 1].address;
    Greeting greeting{.id = static_cast<std::uint32_t>(i + 2), .name = "other" + std::to_string(i), .domain = "world"};
    greeting.base = way.base;
    greeting.address = address;
    greeting.vendors = way.vendors;
    greeting.sent_s = kNow + way.clock_ahead_s;
    if (way.hears_us) greeting.heard_udp = greeting.heard_dds = {1};
    if (way.small) all.note_datagram(greeting, address, way.at, 300, kNow);
    greeting.size = kLarge;
    if (way.large) all.note_datagram(greeting, address, way.at, kLarge, kNow);
    greeting.size = 0;
    for (const std::string& vendor : way.vendors) {
      greeting.by = vendor;
      if (way.dds) all.note_sample(all.domains[0], greeting);
    }
  }
  return all;
}

struct Break {
  std::function<void(Way&)> of;
  Verdict verdict;
  std::string hint;  ///< words that the hint contains
};

const std::vector<Break>& breaks() {
  static const std::vector<Break> kAll = {
      {[](Way& w) { w.small = w.large = w.dds = false; }, Verdict::fail, "nothing arrives"},
      {[](Way& w) { w.dds = false; }, Verdict::fail, "UDP ports 7650.."},
      {[](Way& w) { w.dds = false, w.base = 9; }, Verdict::fail, "--domain"},
      {[](Way& w) { w.dds = false, w.at = "10.9.9.9"; }, Verdict::fail, "wrong interface"},
      {[](Way& w) { w.dds = false, w.vendors = {"fastdds"}; }, Verdict::fail, "--dds"},
      {[](Way& w) { w.large = false; }, Verdict::fail, "MTU"},
      {[](Way& w) { w.hears_us = false; }, Verdict::warn, "not received our messages"},
      {[](Way& w) { w.small = w.large = false; }, Verdict::ok, "7390"},
      {[](Way& w) { w.clock_ahead_s = -3.0, w.vendors = {"fastdds"}; }, Verdict::warn, "behind"}};
  return kAll;
}

TEST(Meetings, EachTroubleIsReportedForItsPeerAndForNoOther) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    std::vector<Way> ways(1 + random() % 6);
    const Meetings whole = meeting_of(ways);
    ASSERT_EQ(judge_meeting(whole, whole.domains[0]).size(), ways.size()) << "the list must not contain this host";
    for (const PeerState& state : judge_meeting(whole, whole.domains[0])) {
      EXPECT_EQ(state.verdict, Verdict::ok);
      EXPECT_EQ(state.hint, "");
    }
    EXPECT_EQ(exit_code(whole), kExitDone);
    const Break& broken = breaks()[random() % breaks().size()];
    const std::size_t which = random() % ways.size();
    broken.of(ways[which]);
    const Meetings poor = meeting_of(ways);
    const std::vector<PeerState> states = judge_meeting(poor, poor.domains[0]);
    for (std::size_t k = 0; k < states.size(); ++k) {
      EXPECT_EQ(states[k].verdict, k == which ? broken.verdict : Verdict::ok) << states[k].hint;
      EXPECT_EQ(states[k].hint.empty(), k != which);
    }
    EXPECT_NE(states[which].hint.find(broken.hint), std::string::npos) << states[which].hint;
    EXPECT_EQ(exit_code(poor), broken.verdict == Verdict::fail ? kExitCheckFailed : kExitDone);
  }
}

TEST(Meetings, TheHintNamesTheReasonWhyAPeerIsSilent) {
  Way silent;
  silent.small = silent.large = silent.dds = false;
  Meetings all = meeting_of({silent});
  Meeting& world = all.domains[0];
  const auto hint = [&] { return judge_meeting(all, world).at(0).hint; };
  world.refused["10.0.0.2"] = "Connection refused";
  EXPECT_NE(hint().find("Connection refused"), std::string::npos);
  all.note_datagram({.id = 2, .name = "other", .domain = "jurong"}, "10.0.0.2", "10.0.0.1", 300, kNow);
  EXPECT_NE(hint().find("jurong only"), std::string::npos);
  world.peers[1].source = "10.9.9.9";
  EXPECT_NE(hint().find("leave by 10.9.9.9"), std::string::npos);
  world.peers[1].source.reset();
  EXPECT_NE(hint().find("no route"), std::string::npos);
  world.peers[1].address.reset();
  EXPECT_NE(hint().find("no address"), std::string::npos);
}

TEST(Meetings, APeerThatTheUserDidNotNameIsListedAndFailsNothing) {
  Way way;
  way.large = false;
  Meetings all = meeting_of({way});
  all.domains[0].peers.clear();
  const std::vector<PeerState> states = judge_meeting(all, all.domains[0]);
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states[0].name, "other0");
  EXPECT_EQ(states[0].verdict, Verdict::warn);
  EXPECT_EQ(exit_code(all), kExitDone);
  all.domains[0].trouble = "cyclonedds cannot join";
  EXPECT_EQ(exit_code(all), kExitCheckFailed);
}

TEST(Meetings, AGreetingNamesTheDoctorsThatItsSenderHeard) {
  Way deaf, plain;
  deaf.dds = false;
  const Meetings all = meeting_of({deaf, plain});
  const Greeting greeting = all.greeting(all.domains[0]);
  EXPECT_EQ(greeting.heard_udp, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(greeting.heard_dds, (std::vector<std::uint32_t>{3}));
  Meetings ours = all;
  ours.note_datagram(greeting, "10.0.0.1", "10.0.0.1", 300, kNow);
  EXPECT_EQ(ours.domains[0].heard.size(), 2u) << "a doctor ignores its own greetings";
}

TEST(Meetings, TheTextAndTheJsonHaveTheSameFindings) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    std::vector<Way> ways(1 + random() % 6);
    for (Way& way : ways) breaks()[random() % breaks().size()].of(way);
    const Meetings all = meeting_of(ways);
    std::ostringstream text;
    print(text, all);
    const Json json = as_json(all);
    EXPECT_EQ(json["ok"], exit_code(all) == kExitDone);
    for (const Json& peer : json["domains"][0]["peers"]) {
      EXPECT_NE(text.str().find(peer["hint"].get<std::string>()), std::string::npos);
      EXPECT_NE(text.str().find(peer["verdict"].get<std::string>() + " "), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace skein::doctor
