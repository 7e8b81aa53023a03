// The contract of every backend (bus/bus.hpp), for each vendor and for two vendors in one domain.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include "bus/bus.hpp"
#include "core/types.hpp"
#include "tests/contract/bus_fixture.hpp"
#include "tests/free_domain.hpp"

namespace skein::test {
namespace {

using bus::Participant;
using bus::ParticipantId;
using bus::Qos;
using bus::Sample;

class BusContract : public testing::TestWithParam<Pair> {
 protected:
  std::unique_ptr<Participant> writing_side(int offset = 0) { return join(GetParam().writer, offset); }
  std::unique_ptr<Participant> reading_side(int offset = 0) { return join(GetParam().reader, offset); }

  std::unique_ptr<Participant> join(const std::string& vendor, int offset) {
    return bus::make_bus({.vendor = vendor})->join(domains_.base() + offset);
  }

  /// Waits until both ends have matched: the writer the reader, and the reader the writer.
  static void connect(const bus::Writer& writer, const bus::Reader& reader, std::size_t count = 1) {
    ASSERT_TRUE(eventually([&] { return writer.matched().size() >= count && reader.matched().size() >= count; }));
  }

  FreeDomains domains_{2};
};

std::vector<std::uint64_t> count_from(std::uint64_t first, std::size_t count) {
  std::vector<std::uint64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

TEST_P(BusContract, SamplesArriveInOrder) {
  auto a = writing_side(), b = reading_side();
  Collector got;
  const auto spec = topic("order", {.depth = 1000});
  auto reader = b->create_reader(spec, got.callback());
  auto writer = a->create_writer(spec);
  connect(*writer, *reader);
  for (const auto n : count_from(0, 1000)) writer->write(numbered(n, 200));
  EXPECT_EQ(got.numbers(1000), count_from(0, 1000));
}

TEST_P(BusContract, NothingIsLostWhileNoMoreThanDepthIsOutstanding) {
  auto a = writing_side(), b = reading_side();
  Collector got;
  const auto spec = topic("rounds", {.depth = 8});
  auto reader = b->create_reader(spec, got.callback());
  auto writer = a->create_writer(spec);
  connect(*writer, *reader);
  for (std::size_t round = 0; round < 50; ++round) {
    for (std::size_t i = 0; i < 8; ++i) writer->write(numbered(8 * round + i, 20'000));
    ASSERT_EQ(got.wait_for(8 * (round + 1)).size(), 8 * (round + 1));
  }
  EXPECT_EQ(got.numbers(400), count_from(0, 400));
}

TEST_P(BusContract, LargeSamplesArriveWhole) {
  auto a = writing_side(), b = reading_side();
  Collector got;
  auto reader = b->create_reader(topic("large"), got.callback());
  auto writer = a->create_writer(topic("large"));
  connect(*writer, *reader);
  const std::vector<std::size_t> sizes{60'000, 65'504, 70'000, 1'000'000, 4'000'000};
  for (const std::size_t size : sizes) writer->write(numbered(size, size));
  const auto samples = got.wait_for(sizes.size());
  ASSERT_EQ(samples.size(), sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) EXPECT_TRUE(samples[i].payload == numbered(sizes[i], sizes[i])) << i;
}

TEST_P(BusContract, BurstsOfManyWritersArriveWholeAndInOrder) {
  auto a = writing_side(), b = reading_side();
  constexpr std::size_t kWriters = 5, kRounds = 20;
  std::vector<Collector> got(kWriters);
  std::vector<std::unique_ptr<bus::Reader>> readers;
  std::vector<std::unique_ptr<bus::Writer>> writers;
  for (std::size_t w = 0; w < kWriters; ++w) {
    const auto spec = topic("burst" + std::to_string(w), {.depth = 8});
    readers.push_back(b->create_reader(spec, got[w].callback()));
    writers.push_back(a->create_writer(spec));
    connect(*writers[w], *readers[w]);
  }
  // Sizes of which a datagram holds many, several, one, or only a part, in changing order.
  const std::vector<std::size_t> sizes{8, 300, 5'000, 13'960, 100'000};
  for (std::size_t round = 0; round < kRounds; ++round) {
    {
      const bus::Burst burst(*a);
      for (std::size_t w = 0; w < kWriters; ++w) writers[w]->write(numbered(round, sizes[(w + round) % sizes.size()]));
    }
    for (std::size_t w = 0; w < kWriters; ++w) {
      const auto samples = got[w].wait_for(round + 1);
      ASSERT_EQ(samples.size(), round + 1);
      EXPECT_TRUE(samples.back().payload == numbered(round, sizes[(w + round) % sizes.size()]));
      EXPECT_EQ(samples.back().source, a->id());
    }
  }
}

TEST_P(BusContract, BurstsOfTwoParticipantsKeepTheirSources) {
  auto a = writing_side(), c = writing_side(), b = reading_side();
  Collector got;
  auto reader = b->create_reader(topic("sources"), got.callback());
  auto from_a = a->create_writer(topic("sources")), from_c = c->create_writer(topic("sources"));
  connect(*from_a, *reader);
  connect(*from_c, *reader);
  ASSERT_TRUE(eventually([&] { return reader->matched().size() == 2; }));
  {
    const bus::Burst burst_a(*a), burst_c(*c);
    for (std::uint64_t n = 0; n < 10; ++n) (n % 2 == 0 ? from_a : from_c)->write(numbered(n));
  }
  const auto samples = got.wait_for(10);
  ASSERT_EQ(samples.size(), 10u);
  for (const Sample& sample : samples) {
    EXPECT_EQ(sample.source, number_of(sample.payload) % 2 == 0 ? a->id() : c->id());
  }
}

TEST_P(BusContract, OddLengthsArePaddedWithZeros) {
  auto a = writing_side(), b = reading_side();
  Collector got;
  auto reader = b->create_reader(topic("odd"), got.callback());
  auto writer = a->create_writer(topic("odd"));
  connect(*writer, *reader);
  for (std::size_t size = 8; size < 13; ++size) writer->write(numbered(size, size));
  const auto samples = got.wait_for(5);
  ASSERT_EQ(samples.size(), 5u);
  for (std::size_t size = 8; size < 13; ++size) {
    Bytes expected = numbered(size, size);
    expected.resize((expected.size() + 3) / 4 * 4);
    EXPECT_EQ(samples[size - 8].payload, expected);
  }
}

TEST_P(BusContract, ALateJoinerGetsTheLastSamplesOfALatchedTopic) {
  auto a = writing_side();
  const auto spec = topic("latched", {.latched = true, .depth = 3});
  auto writer = a->create_writer(spec);
  for (const auto n : count_from(0, 5)) writer->write(numbered(n, 100'000));
  auto b = reading_side();
  Collector got;
  auto reader = b->create_reader(spec, got.callback());
  EXPECT_EQ(got.numbers(3), count_from(2, 3));
  writer->write(numbered(5));
  EXPECT_EQ(got.numbers(4), count_from(2, 4));
}

TEST_P(BusContract, ALateJoinerGetsNoEarlierSamplesOfAVolatileTopic) {
  auto a = writing_side();
  auto writer = a->create_writer(topic("volatile"));
  for (const auto n : count_from(0, 5)) writer->write(numbered(n));
  auto b = reading_side();
  Collector got;
  auto reader = b->create_reader(topic("volatile"), got.callback());
  connect(*writer, *reader);
  writer->write(numbered(5));
  EXPECT_EQ(got.numbers(1), count_from(5, 1));
}

TEST_P(BusContract, ARelayPassesOnATypeThatItDoesNotKnow) {
  auto a = writing_side(0), relay_in = reading_side(0), relay_out = reading_side(1), b = writing_side(1);
  Collector got;
  auto reader = b->create_reader(topic("relayed"), got.callback());
  auto out = relay_out->create_writer(topic("relayed"));
  auto in = relay_in->create_reader(topic("relayed"), [&out](Sample&& sample) { out->write(sample.payload); });
  auto writer = a->create_writer(topic("relayed"));
  connect(*writer, *in);
  connect(*out, *reader);
  for (const auto n : count_from(0, 20)) writer->write(numbered(n, 8 + 1000 * n));
  const auto samples = got.wait_for(20);
  ASSERT_EQ(samples.size(), 20u);
  for (const auto n : count_from(0, 20)) EXPECT_EQ(samples[n].payload, numbered(n, 8 + 1000 * n));
  EXPECT_EQ(samples[0].source, relay_out->id());
}

TEST_P(BusContract, OwnSamplesAreNotEchoed) {
  auto a = writing_side(), b = reading_side();
  Collector got;
  const auto spec = topic("both_ways", {.latched = true});
  auto own = b->create_writer(spec);
  own->write(numbered(1));
  auto reader = b->create_reader(spec, got.callback());
  own->write(numbered(2));
  auto writer = a->create_writer(spec);
  connect(*writer, *reader);
  own->write(numbered(3));
  writer->write(numbered(4));
  EXPECT_EQ(got.numbers(1), count_from(4, 1));
  EXPECT_EQ(reader->matched(), std::vector<ParticipantId>{a->id()});
  EXPECT_TRUE(own->matched().empty());
}

TEST_P(BusContract, TheSourceOfEachSampleIsItsWritersIdFromTheFirstOn) {
  auto a1 = writing_side(), a2 = writing_side(), b = reading_side();
  ASSERT_NE(a1->id(), a2->id());
  const auto spec = topic("source", {.latched = true, .depth = 1});
  auto writer1 = a1->create_writer(spec), writer2 = a2->create_writer(spec);
  writer1->write(numbered(a1->id()));
  writer2->write(numbered(a2->id()));
  Collector got;
  auto reader = b->create_reader(spec, got.callback());
  const auto samples = got.wait_for(2);
  ASSERT_EQ(samples.size(), 2u);
  for (const auto& sample : samples) EXPECT_EQ(sample.source, number_of(sample.payload));
}

TEST_P(BusContract, MatchedListsTheParticipantsOnBothEnds) {
  auto a1 = writing_side(), a2 = writing_side(), b = reading_side();
  auto writer1 = a1->create_writer(topic("matched")), writer2 = a2->create_writer(topic("matched"));
  auto reader = b->create_reader(topic("matched"), [](Sample&&) {});
  connect(*writer1, *reader);
  connect(*writer2, *reader);
  ASSERT_TRUE(eventually([&] { return reader->matched().size() == 2; }));
  auto writers = reader->matched();
  std::sort(writers.begin(), writers.end());
  std::vector<ParticipantId> expected{a1->id(), a2->id()};
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(writers, expected);
  EXPECT_EQ(writer1->matched(), std::vector<ParticipantId>{b->id()});

  auto second = b->create_reader(topic("matched"), [](Sample&&) {});
  EXPECT_TRUE(eventually([&] { return writer1->matched() == std::vector<ParticipantId>{b->id(), b->id()}; }));
  second.reset();
  EXPECT_TRUE(eventually([&] { return writer1->matched() == std::vector<ParticipantId>{b->id()}; }));

  writer2.reset();
  a2.reset();
  EXPECT_TRUE(eventually([&] { return reader->matched() == std::vector<ParticipantId>{a1->id()}; }));
  reader.reset();
  b.reset();
  EXPECT_TRUE(eventually([&] { return writer1->matched().empty(); }));
}

TEST_P(BusContract, OnlyFittingEndpointsMatch) {
  auto a = writing_side(), b = reading_side();
  const auto ignore = [](Sample&&) {};
  auto writer = a->create_writer(topic("fitting"));
  auto other_type = b->create_reader({"rt/fitting2", "other::Type_", {}}, ignore);
  auto wants_latched = b->create_reader(topic("fitting", {.latched = true}), ignore);
  auto fits = b->create_reader(topic("fitting", {.reliable = false, .depth = 1}), ignore);
  connect(*writer, *fits);
  EXPECT_TRUE(wants_latched->matched().empty());
  EXPECT_TRUE(other_type->matched().empty());
  EXPECT_EQ(writer->matched().size(), 1u);
}

/// A program that asked for a radio topic of the wrong type may ask again (docs/radio.md).
TEST_P(BusContract, ATopicMayHaveAnotherTypeOnceItsEndpointsAreGone) {
  auto a = writing_side(), b = reading_side();
  const bus::TopicSpec spec = topic("retyped");
  bus::TopicSpec former = spec;
  former.type = "other::Type_";
  a->create_writer(former).reset();
  b->create_reader(former, [](Sample&&) {}).reset();
  Collector got;
  auto reader = b->create_reader(spec, got.callback());
  auto writer = a->create_writer(spec);
  connect(*writer, *reader);
  writer->write(numbered(7));
  EXPECT_EQ(got.numbers(1), count_from(7, 1));
}

TEST_P(BusContract, SamplesStayWithinTheirDomain) {
  auto a0 = writing_side(0), a1 = writing_side(1), b0 = reading_side(0), b1 = reading_side(1);
  Collector got0, got1;
  auto reader0 = b0->create_reader(topic("apart"), got0.callback());
  auto reader1 = b1->create_reader(topic("apart"), got1.callback());
  auto writer0 = a0->create_writer(topic("apart")), writer1 = a1->create_writer(topic("apart"));
  connect(*writer0, *reader0);
  connect(*writer1, *reader1);
  for (std::uint64_t n = 0; n < 10; ++n) {
    writer0->write(numbered(n));
    writer1->write(numbered(100 + n));
  }
  EXPECT_EQ(got0.numbers(10), count_from(0, 10));
  EXPECT_EQ(got1.numbers(10), count_from(100, 10));
  EXPECT_EQ(reader0->matched(), std::vector<ParticipantId>{a0->id()});
}

TEST_P(BusContract, TwentyParticipantsFindEachOther) {
  std::vector<std::unique_ptr<Participant>> participants;
  std::vector<std::unique_ptr<bus::Writer>> writers;
  std::vector<std::unique_ptr<bus::Reader>> readers;
  for (int i = 0; i < 20; ++i) {
    participants.push_back(i % 2 == 0 ? writing_side() : reading_side());
    writers.push_back(participants.back()->create_writer(topic("crowd")));
    readers.push_back(participants.back()->create_reader(topic("crowd"), [](Sample&&) {}));
  }
  for (int i = 0; i < 20; ++i) connect(*writers[i], *readers[i], 19);
}

TEST_P(BusContract, ReaderAndWriterMayLeaveWhileSamplesFly) {
  auto a = writing_side(), b = reading_side();
  auto writer = a->create_writer(topic("leaving", {.depth = 10}));
  for (int i = 0; i < 20; ++i) {
    std::atomic<int> got = 0;
    auto reader = b->create_reader(topic("leaving", {.depth = 10}), [&got](Sample&&) { ++got; });
    ASSERT_TRUE(eventually([&] {
      writer->write(numbered(0));
      return got > 0;
    }));
    for (int n = 0; n < 20; ++n) writer->write(numbered(1));
  }
}

TEST_P(BusContract, LongLeasesAreAccepted) {
  const auto join_for_long = [this](const std::string& vendor) {
    return bus::make_bus({.vendor = vendor, .lease_s = 3600})->join(domains_.base());
  };
  auto a = join_for_long(GetParam().writer), b = join_for_long(GetParam().reader);
  Collector got;
  const auto spec = topic("long_leases", {.latched = true});
  auto writer = a->create_writer(spec);
  writer->write(numbered(1));
  auto reader = b->create_reader(spec, got.callback());
  EXPECT_EQ(got.numbers(1), count_from(1, 1));
}

TEST_P(BusContract, ADomainOutOfRangeIsRefused) {
  const auto bus = bus::make_bus({.vendor = GetParam().writer});
  EXPECT_THROW(bus->join(-1), InputError);
  if (GetParam().writer == std::string("inproc")) {
    EXPECT_NO_THROW(bus->join(bus::kMaxDomain + 1)) << "this backend uses no ports, so it must accept any domain";
  } else {
    EXPECT_THROW(bus->join(bus::kMaxDomain + 1), InputError);
  }
}

INSTANTIATE_TEST_SUITE_P(Vendors, BusContract,
                         testing::Values(Pair{"inproc", "inproc"}, Pair{"cyclonedds", "cyclonedds"},
                                         Pair{"fastdds", "fastdds"}, Pair{"cyclonedds", "fastdds"},
                                         Pair{"fastdds", "cyclonedds"}),
                         [](const auto& pair) { return name_of(pair.param); });

TEST(Bus, AnUnknownVendorIsRefused) {
  EXPECT_THROW(bus::make_bus({.vendor = "carrier_pigeon"}), InputError);
  EXPECT_EQ(bus::dds_vendors(), (std::vector<std::string>{"cyclonedds", "fastdds"}));
}

}  // namespace
}  // namespace skein::test
