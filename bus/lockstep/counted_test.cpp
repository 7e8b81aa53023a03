// Property: the queues return the same messages as a list of all messages would, in any order in which messages arrive,
// are announced and are forgotten.
#include "bus/lockstep/counted.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"

namespace skein::bus {
namespace {

using Expected = CountedQueues::Expected;
const std::vector<std::string> kTopics = {"rt/x", "rt/y"};
const std::vector<ParticipantId> kSources = {7, 8, 9};

std::string described(const std::string& topic, ParticipantId source, std::uint64_t number) {
  return topic + " " + std::to_string(source) + " " + std::to_string(number);
}

/// The oracle, a simple implementation of the same: one list of samples for each topic and source.
class Oracle {
 public:
  struct Lane {
    std::uint64_t base = 0, released = 0;  ///< of the samples since the base
    std::vector<std::uint64_t> numbers;
  };
  std::map<std::pair<std::string, ParticipantId>, Lane> lanes;
  std::vector<Expected> expected;

  std::uint64_t arrived(const std::string& topic, ParticipantId source) const {
    const auto lane = lanes.find({topic, source});
    return lane == lanes.end() ? 0 : lane->second.base + lane->second.numbers.size();
  }
  std::vector<std::string> missing() const {
    std::vector<std::string> lines;
    for (const Expected& e : expected) {
      const std::uint64_t here = arrived(e.topic, e.source);
      if (here < e.count) lines.push_back(e.topic + " " + std::to_string(here) + " of " + std::to_string(e.count));
    }
    return lines;
  }
  bool has_surplus(ParticipantId source) const {
    return std::ranges::any_of(kTopics, [&](const std::string& topic) {
      std::uint64_t announced = 0;
      for (const Expected& e : expected) {
        if (e.topic == topic && e.source == source) announced = e.count;
      }
      return arrived(topic, source) > announced;
    });
  }
  std::vector<std::string> release() {
    std::vector<std::string> handed_out;
    for (const Expected& e : expected) {
      Lane& lane = lanes[{e.topic, e.source}];
      for (; lane.base + lane.released < e.count && lane.released < lane.numbers.size(); ++lane.released) {
        handed_out.push_back(described(e.topic, e.source, lane.numbers[lane.released]));
      }
    }
    return handed_out;
  }
};

/// The queues and the oracle, with the same inputs.
class Both {
 public:
  Both() {
    for (const std::string& topic : kTopics) add(topic);
  }
  void add(const std::string& topic) {
    queues.add_topic(topic, [this, topic](Sample&& sample) {
      handed_out_.push_back(described(topic, sample.source, sample.payload.at(0) + 256U * sample.payload.at(1)));
    });
  }
  void arrive(const std::string& topic, ParticipantId source) {
    const std::uint64_t number = next_number_++;
    queues.arrive(topic, {{static_cast<std::uint8_t>(number), static_cast<std::uint8_t>(number >> 8)}, source});
    oracle.lanes[{topic, source}].numbers.push_back(number);
  }
  void expect(RandomStream& random) {
    oracle.expected.clear();
    for (const std::string& topic : kTopics) {
      for (const ParticipantId source : kSources) {
        if (random.uniform() < 0.3) continue;
        oracle.expected.push_back({topic, source, oracle.arrived(topic, source) + random.bits() % 3});
      }
    }
    if (random.uniform() < 0.5) std::ranges::reverse(oracle.expected);
    std::vector<Expected> told = oracle.expected;
    told.push_back({"rt/of_no_interest", 7, 5});
    queues.expect(told);
  }
  void forget(ParticipantId source) {
    queues.discard(source);
    std::erase_if(oracle.expected, [&](const Expected& e) { return e.source == source; });
    std::erase_if(oracle.lanes, [&](const auto& lane) { return lane.first.second == source; });
  }
  void begin_anew(const std::string& topic, RandomStream& random) {
    queues.remove_topic(topic);
    queues.set_base(topic, 7, 99);  // without effect, because the topic has been removed
    add(topic);
    std::erase_if(oracle.expected, [&](const Expected& e) { return e.topic == topic; });
    std::erase_if(oracle.lanes, [&](const auto& lane) { return lane.first.first == topic; });
    for (const ParticipantId source : kSources) count_from(topic, source, random.bits() % 5);
  }
  void count_from(const std::string& topic, ParticipantId source, std::uint64_t base) {
    queues.set_base(topic, source, base);
    oracle.lanes[{topic, source}] = {.base = base, .numbers = {}};
  }
  void compare() {
    ASSERT_EQ(queues.missing(), oracle.missing());
    ASSERT_EQ(queues.complete(), oracle.missing().empty());
    for (const ParticipantId source : kSources)
      ASSERT_EQ(queues.surplus(source).has_value(), oracle.has_surplus(source));
  }
  std::size_t release() {
    handed_out_.clear();
    queues.release();
    EXPECT_EQ(handed_out_, oracle.release());
    return handed_out_.size();
  }

  CountedQueues queues;
  Oracle oracle;

 private:
  std::vector<std::string> handed_out_;
  std::uint64_t next_number_ = 0;
};

TEST(CountedQueues, AgreeWithAListOfAllMessages) {
  std::size_t handed_out = 0, completed = 0, incomplete = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    RandomStream random(seed, "counted", 0);
    Both both;
    for (int i = 0; i < 200; ++i) {
      const std::string& topic = kTopics[random.bits() % kTopics.size()];
      const ParticipantId source = kSources[random.bits() % kSources.size()];
      const double what = random.uniform();
      if (what < 0.6) {
        both.arrive(topic, source);
      } else if (what < 0.75) {
        both.expect(random);
      } else if (what < 0.95) {
        ++(both.queues.complete() ? completed : incomplete);
        handed_out += both.release();
      } else if (what < 0.98) {
        both.forget(source);
      } else if (what < 0.99) {
        both.count_from(topic, source, random.bits() % 5);
      } else {
        ASSERT_NO_FATAL_FAILURE(both.begin_anew(topic, random));
      }
      ASSERT_NO_FATAL_FAILURE(both.compare()) << "seed " << seed << " event " << i;
    }
  }
  EXPECT_GT(handed_out, 2000U);
  EXPECT_GT(std::min(completed, incomplete), 300U) << "the test must have seen complete and incomplete steps";
}

TEST(CountedWriter, SendsNoMoreInAStepThanItsHistoryHolds) {
  const auto bus = make_bus({.vendor = "inproc"});
  const auto here = bus->join(3), there = bus->join(3);
  std::size_t heard = 0;
  const TopicSpec topic{"rt/x", "t", {.reliable = true, .latched = false, .depth = 3}};
  const auto reader = there->create_reader(topic, [&](Sample&&) { ++heard; });
  CountedWriter writer(*here, topic);
  EXPECT_TRUE(writer.has_readers());
  EXPECT_TRUE(writer.matches(there->id()));
  EXPECT_FALSE(writer.matches(here->id()));
  const std::vector<std::uint8_t> payload = {0, 1, 0, 0};
  for (std::size_t step = 1; step <= 3; ++step) {
    writer.begin_step();
    for (int i = 0; i < 5; ++i) EXPECT_EQ(writer.write(payload), i < 3) << i;
    EXPECT_EQ(writer.count(), 3 * step);
    EXPECT_EQ(bus->unsent()->count(), 2 * step);
    EXPECT_EQ(heard, 3 * step);
  }
  writer.begin_step();
  writer.skip();
  EXPECT_EQ(writer.count(), 10U) << "a skipped message is counted";
  EXPECT_EQ(heard, 9U) << "but not sent";
  for (int i = 0; i < 3; ++i) EXPECT_EQ(writer.write(payload), i < 2) << "it is one of the three of its step";
}

TEST(CountedWriter, TheBusCountsTheUnsentMessagesOfAllItsWriters) {
  const auto bus = make_bus({.vendor = "inproc"});
  const auto here = bus->join(3), there = bus->join(4);
  const std::vector<std::uint8_t> payload = {0, 1, 0, 0};
  std::uint64_t expected = 0;
  for (const auto& participant : {here.get(), there.get()}) {
    for (const char* name : {"rt/x", "rt/y"}) {
      CountedWriter writer(*participant, {name, "t", {.reliable = true, .latched = false, .depth = 3}});
      for (int step = 0; step < 3; ++step) {
        writer.begin_step();
        for (int i = 0; i < 5; ++i) expected += writer.write(payload) ? 0 : 1;
      }
    }
  }
  EXPECT_EQ(expected, 2U * 2U * 3U * 2U);
  EXPECT_EQ(bus->unsent()->count(), expected);
  EXPECT_EQ(here->unsent().count(), expected);
}

}  // namespace
}  // namespace skein::bus
