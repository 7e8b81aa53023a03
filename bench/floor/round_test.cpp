#include "bench/floor/round.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/topics.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"

namespace skein::bench {
namespace {

constexpr int kBase = 10;

bool is(const Flow& flow, const topics::WireTopic& topic) { return flow.topic.name == topic.name; }

TEST(Round, EachProgramWaitsForMessagesAndWritesMessages) {
  for (const std::size_t uavs : {1, 5, 20}) {
    const std::vector<Flow> flows = round_flows(uavs, kBase);
    ASSERT_EQ(seats(uavs).size(), uavs + 3);
    for (const Seat& seat : seats(uavs)) {
      EXPECT_TRUE(std::ranges::any_of(flows, [&](const Flow& flow) { return flow.writer == seat; }));
      EXPECT_TRUE(std::ranges::any_of(flows, [&](const Flow& flow) { return flow.goes_to(seat); }));
    }
  }
}

TEST(Round, AgentsStayInTheirDomain) {
  for (const Flow& flow : round_flows(7, kBase)) {
    std::vector<Seat> ends = flow.readers;
    ends.push_back(flow.writer);
    for (const Seat& seat : ends) {
      EXPECT_TRUE(seat.role != Role::agent || flow.domain == uav_domain(kBase, skein::UavIndex(seat.uav)))
          << flow.topic.name;
    }
    EXPECT_FALSE(flow.goes_to(flow.writer));
  }
}

TEST(Round, NoTopicIsWrittenTwiceInADomain) {
  std::set<std::pair<int, std::string>> seen;
  for (const Flow& flow : round_flows(5, kBase)) EXPECT_TRUE(seen.emplace(flow.domain, flow.topic.name).second);
}

TEST(Round, EachMessageHasTheTypeOfItsTopic) {
  for (const Flow& flow : round_flows(5, kBase)) {
    EXPECT_TRUE(flow.topic.qos.reliable) << flow.topic.name;
    EXPECT_FALSE(flow.topic.qos.latched) << flow.topic.name;
    EXPECT_EQ(flow.payload.size() % 4, 0u);
    if (!is(flow, topics::step())) continue;
    msg::Step step;
    ASSERT_TRUE(decode(flow.payload, step));
    EXPECT_EQ(step.links().size(), flow.domain == world_domain(kBase) ? 36u : 0u);
    EXPECT_EQ(step.members().size(), flow.domain == world_domain(kBase) ? 7u : 2u);
  }
}

TEST(Round, DoneReachesServerAndRouter) {
  std::size_t dones = 0;
  for (const Flow& flow : round_flows(5, kBase)) {
    if (!is(flow, topics::done())) continue;
    ++dones;
    EXPECT_TRUE(flow.goes_to({Role::server}) && flow.goes_to({Role::router}));
  }
  EXPECT_EQ(dones, 6u);  // five agents and the station
}

}  // namespace
}  // namespace skein::bench
