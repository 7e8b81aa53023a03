// Matches that Fast DDS reports from several threads, in every possible order.
#include "bus/fastdds/matches.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein::bus::fastdds {
namespace {

GUID_t endpoint(std::uint8_t participant, std::uint8_t entity) {
  GUID_t guid;
  guid.guidPrefix.value[11] = participant;
  guid.entityId.value[3] = entity;
  return guid;
}

const GuidPrefix_t kOwn = endpoint(9, 0).guidPrefix;

TEST(Matches, AWriterCountsAsMatchedFromItsFirstSampleOn) {
  Matches matches(kOwn);
  const GUID_t writer = endpoint(1, 1);
  matches.note_sample(writer);
  EXPECT_EQ(matches.participants(), std::vector{id_of(writer.guidPrefix)});
  matches.begin(writer);
  EXPECT_EQ(matches.participants(), std::vector{id_of(writer.guidPrefix)}) << "the match must not add the writer again";
  matches.end(writer);
  EXPECT_TRUE(matches.empty());
}

TEST(Matches, OnlyANewMatchBringsAWriterBackNotALateSample) {
  Matches matches(kOwn);
  const GUID_t writer = endpoint(1, 1);
  matches.begin(writer);
  matches.end(writer);
  matches.note_sample(writer);
  EXPECT_TRUE(matches.empty());
  matches.begin(writer);
  matches.note_sample(writer);
  EXPECT_FALSE(matches.empty());
}

TEST(Matches, EndpointsOfTheOwnParticipantDoNotCount) {
  Matches matches(kOwn);
  matches.begin(endpoint(9, 1));
  matches.note_sample(endpoint(9, 2));
  EXPECT_TRUE(matches.empty());
}

// Matches of one endpoint begin and end alternately. Its samples may come at any time, even shortly before the match.
TEST(Matches, ExactlyThePresentEndpointsAreMatchedAfterAnyOrderOfEvents) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    Matches matches(kOwn);
    std::set<GUID_t> known;
    std::map<GUID_t, bool> there;
    for (int event = 0; event < 60; ++event) {
      const GUID_t writer = endpoint(static_cast<std::uint8_t>(random() % 3), static_cast<std::uint8_t>(random() % 3));
      if (random() % 2 == 0) {
        matches.note_sample(writer);
        if (known.insert(writer).second) there[writer] = true;
      } else {
        known.insert(writer);
        bool& is_there = there[writer];
        const bool leaves = is_there && random() % 2 == 0;
        is_there = !leaves;
        leaves ? matches.end(writer) : matches.begin(writer);
      }
      std::vector<ParticipantId> expected;
      for (const auto& [endpoint, is_there] : there) {
        if (is_there) expected.push_back(id_of(endpoint.guidPrefix));
      }
      ASSERT_EQ(matches.participants(), expected) << "seed " << seed << ", event " << event;
    }
  }
}

}  // namespace
}  // namespace skein::bus::fastdds
