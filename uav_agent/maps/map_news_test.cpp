#include "uav_agent/maps/map_news.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "uav_agent/testing/news_radio.hpp"

namespace skein::agent {
namespace {

using test::draw_space;
using test::NewsRadio;
using test::visit_chunks;

NewsRadio::Config drawn_radio(RandomStream& random) {
  NewsRadio::Config config;
  config.uavs = 2 + static_cast<std::size_t>(random.uniform() * 3.0);
  config.loss = random.uniform() < 0.3 ? 0.0 : 0.3;
  config.most_delay = 1 + static_cast<int>(random.uniform() * 12.0);
  config.news.bytes_per_s = random.uniform(3'000.0, 20'000.0);
  config.news.period_s = random.uniform(0.05, 0.5);
  return config;
}

/// Either all UAVs hear each other, or each hears only its neighbours in a row.
void draw_links(NewsRadio& radio, RandomStream& random) {
  if (random.uniform() < 0.5) return;
  radio.linked = [](std::size_t i, std::size_t j) { return i + 1 == j || j + 1 == i; };
}

TEST(MapNews, AllUavsEndUpWithTheSameMapAndSendNoMoreBytesThanTheyMay) {
  constexpr int kDrawn = 10, kMost = 2000;
  for (std::uint64_t seed = 1; seed <= kDrawn; ++seed) {
    RandomStream random(seed, "news_drawn", 0);
    const NewsRadio::Config config = drawn_radio(random);
    NewsRadio radio(config, seed);
    draw_links(radio, random);
    for (int i = 0; i < 200; ++i) {  // they send news while their maps grow
      const auto uav = static_cast<std::size_t>(random.uniform() * static_cast<double>(config.uavs));
      draw_space(*radio[uav].map, random, {0.0, 0.0, 10.0}, 40.0, 8);
      radio.exchange();
    }
    EXPECT_LT(radio.exchanges_to_agree(kMost), kMost) << seed;
    EXPECT_LE(static_cast<double>(radio.most_bytes_in_a_second()), config.news.bytes_per_s) << seed;
  }
}

TEST(MapNews, ARestartedUavReceivesEverythingAgainAndSendsItsNews) {
  constexpr int kDrawn = 10, kMost = 2000;
  for (std::uint64_t seed = 1; seed <= kDrawn; ++seed) {
    RandomStream random(seed, "news_restart", 0);
    NewsRadio::Config config = drawn_radio(random);
    config.loss = 0.3;
    config.news.bytes_per_s = 10'000.0;
    NewsRadio radio(config, seed);
    draw_links(radio, random);
    for (std::size_t uav = 0; uav < config.uavs; ++uav) {
      draw_space(*radio[uav].map, random, {0.0, 0.0, 10.0}, 40.0, 400);
    }
    for (int restarts = 0; restarts < 3; ++restarts) {
      for (int i = static_cast<int>(random.uniform() * 60.0); i >= 0; --i) radio.exchange();
      const auto uav = static_cast<std::size_t>(random.uniform() * static_cast<double>(config.uavs));
      radio.restart(uav);
      draw_space(*radio[uav].map, random, {0.0, 0.0, 10.0}, 40.0, 50);
    }
    EXPECT_LT(radio.exchanges_to_agree(kMost), kMost) << seed;
    EXPECT_LE(static_cast<double>(radio.most_bytes_in_a_second()), config.news.bytes_per_s) << seed;
  }
}

/// After two maps agree, the test restarts one of the UAVs: the one that sent its map, or the one that received it.
TEST(MapNews, ARestartedUavReceivesItsFormerMapAgain) {
  for (const std::size_t restarted : {0U, 1U}) {
    NewsRadio radio({}, 5);
    RandomStream random(5, "news_own", 0);
    draw_space(*radio[0].map, random, Vector3d::Zero(), 30.0, 1000);
    EXPECT_LT(radio.exchanges_to_agree(400), 400);
    const std::size_t known = radio.map(0).counts().occupied;
    radio.restart(restarted);
    EXPECT_FALSE(radio.agree());
    EXPECT_LT(radio.exchanges_to_agree(400), 400);
    EXPECT_EQ(radio.map(restarted).counts().occupied, known);
  }
}

/// UAV 2 knows the map of UAV 0, and would leave it to UAV 0 to send it to UAV 1. But UAV 0 was restarted before UAV 1
/// hears it, and has lost the map.
TEST(MapNews, NoUavLeavesNewsToASenderThatHasLostIt) {
  NewsRadio::Config config;
  config.uavs = 3;
  config.news.bytes_per_s = 2'000.0;
  NewsRadio radio(config, 9);
  RandomStream random(9, "news_left", 0);
  draw_space(*radio[0].map, random, Vector3d::Zero(), 20.0, 1000);
  radio.linked = [](std::size_t i, std::size_t j) { return i != 1 && j != 1; };
  for (int i = 0; i < 600; ++i) radio.exchange();
  ASSERT_TRUE(radio.knows_all_of(2, 0));
  radio.restart(0);
  radio.linked = [](std::size_t i, std::size_t j) { return i + j == 1; };
  for (int i = 0; i < 60; ++i) radio.exchange();
  radio.linked = [](std::size_t i, std::size_t j) { return i == 1 || j == 1; };
  EXPECT_LT(radio.exchanges_to_agree(400), 400);
}

/// The order in which listener 0 hears of the chunks of a map: the median rank of those within `near_m` of `places`, as
/// a share of all.
double median_rank(NewsRadio& radio, const std::vector<Vector3d>& places, double near_m) {
  std::vector<Eigen::Vector3i> left, order;
  visit_chunks(radio.map(1), [&](const Eigen::Vector3i& chunk) { left.push_back(chunk); });
  for (int i = 0; i < 2000 && !left.empty(); ++i) {
    radio.exchange();
    std::erase_if(left, [&](const Eigen::Vector3i& chunk) {
      const bool known = radio.map(0).changed_at(chunk) > 0;
      if (known) order.push_back(chunk);
      return known;
    });
  }
  EXPECT_TRUE(left.empty());
  std::vector<double> ranks;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const Vector3d middle_W = 4.0 * (order[rank].cast<double>() + Vector3d::Constant(0.5));
    const bool near =
        std::ranges::any_of(places, [&](const Vector3d& p_W) { return (middle_W - p_W).norm() < near_m; });
    if (near) ranks.push_back(static_cast<double>(rank) / static_cast<double>(order.size()));
  }
  EXPECT_GT(ranks.size(), 8U);
  if (ranks.empty()) return 1.0;
  std::ranges::nth_element(ranks, ranks.begin() + static_cast<std::ptrdiff_t>(ranks.size() / 2));
  return ranks[ranks.size() / 2];
}

TEST(MapNews, NewsNearTheListenerOrItsWayComesFirst) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomStream random(seed, "news_order", 0);
    for (const bool goes : {false, true}) {
      NewsRadio::Config config;
      config.news.bytes_per_s = 4'000.0;
      NewsRadio radio(config, seed);
      draw_space(*radio[1].map, random, Vector3d::Zero(), 50.0, 6000);
      const Vector3d here_W(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-40, 40));
      const Vector3d there_W(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-40, 40));
      radio[0].p_W = here_W;
      if (goes) radio[0].going_to_W = there_W;
      const std::vector<Vector3d> all = {here_W, 0.5 * (here_W + there_W), there_W};
      const double rank = median_rank(radio, {all.begin(), all.begin() + (goes ? 3 : 1)}, 12.0);
      EXPECT_LT(rank, goes ? 0.06 : 0.02) << seed;
    }
  }
}

TEST(MapNews, NewsOfUnknownSpaceComesBeforeNewsOfPartlyKnownSpace) {
  NewsRadio::Config config;
  config.news.bytes_per_s = 2'000.0;
  NewsRadio radio(config, 1);
  RandomStream random(1, "news_part", 0);
  draw_space(*radio[1].map, random, Vector3d::Zero(), 8.0, 300);
  EXPECT_LT(radio.exchanges_to_agree(400), 400);
  draw_space(*radio[1].map, random, Vector3d::Zero(), 8.0, 600);
  const Eigen::Vector3i unknown(28, 0, 0);  // 14 m away
  radio[1].map->hear(unknown, 0, Space::free, kOwn);
  int exchanges = 0;
  for (; radio.map(0).known(unknown).space == Space::unknown && exchanges < 400; ++exchanges) radio.exchange();
  EXPECT_LT(exchanges, 25);
  EXPECT_FALSE(radio.knows_all_of(0, 1)) << "the test has a backlog";
}

TEST(MapNews, NewsIsSentOnceAndPassedOnOnlyToUavsThatDoNotHearTheSender) {
  for (const bool row : {false, true}) {
    NewsRadio::Config config;
    config.uavs = 4;
    NewsRadio radio(config, 3);
    if (row) radio.linked = [](std::size_t i, std::size_t j) { return i + 1 == j || j + 1 == i; };
    for (int i = 0; i < 40; ++i) radio.exchange();  // they hear of each other
    std::size_t before[4];
    for (std::size_t uav = 0; uav < 4; ++uav) before[uav] = radio[uav].bytes_sent();
    RandomStream random(3, "news_relay", 0);
    draw_space(*radio[0].map, random, Vector3d::Zero(), 30.0, 4000);
    const int exchanges = radio.exchanges_to_agree(400);
    ASSERT_LT(exchanges, 400);
    const double receipts = 160.0 * 5.0 * kTickS * test::kNewsExchange * exchanges;
    const double news = static_cast<double>(radio[0].bytes_sent() - before[0]);
    EXPECT_GT(news, 8.0 * receipts) << "the test has something to send";
    for (std::size_t uav = 1; uav < 4; ++uav) {
      const double sent = static_cast<double>(radio[uav].bytes_sent() - before[uav]);
      EXPECT_EQ(sent > receipts, row && uav < 3) << row << " " << uav << ": " << sent;
      EXPECT_LT(sent, 1.3 * news + receipts);
    }
  }
}

TEST(MapNews, AUavThatHasNoNewsIsNearlySilent) {
  NewsRadio radio({}, 4);
  RandomStream random(4, "news_idle", 0);
  draw_space(*radio[0].map, random, Vector3d::Zero(), 30.0, 1000);
  ASSERT_LT(radio.exchanges_to_agree(400), 400);
  for (int i = 0; i < 100; ++i) radio.exchange();
  const std::size_t before = radio[0].bytes_sent() + radio[1].bytes_sent();
  for (int i = 0; i < 200; ++i) radio.exchange();
  EXPECT_LE(radio[0].bytes_sent() + radio[1].bytes_sent() - before, 10U * 2U * 90U);
  NewsRadio alone({}, 4);
  alone.linked = [](std::size_t, std::size_t) { return false; };
  for (int i = 0; i < 100; ++i) alone.exchange();
  EXPECT_EQ(alone[0].bytes_sent(), 0U) << "no other UAV is in sight";
}

TEST(MapNews, AChunkThatChangesAllTheTimeIsSentOnceASecond) {
  NewsRadio radio({}, 8);
  for (int i = 0; i < 40; ++i) radio.exchange();
  const std::size_t before = radio[0].sent.size();
  for (int i = 0; i < 200; ++i) {
    radio[0].map->hear({i % 6, i / 6 % 6, i / 36}, 0, Space::free, kOwn);
    radio.exchange();
  }
  EXPECT_LE(radio[0].sent.size() - before, 11U);
  EXPECT_GE(radio[0].sent.size() - before, 9U);
}

TEST(MapNews, ACubeThatTheSenderVacatesStaysOccupiedForItsListener) {
  NewsRadio radio({}, 6);
  const Vector3d p_W(3.1, 0.1, 0.1);
  radio[0].map->hear(radio.map(0).cube_of(p_W), 0, Space::occupied, kOwn);
  for (int i = 0; i < 40; ++i) radio.exchange();
  EXPECT_EQ(radio.map(1).at(p_W), Space::occupied);
  radio[0].map->vacate(p_W, 0.1);
  for (int i = 0; i < 100; ++i) radio.exchange();
  EXPECT_EQ(radio.map(0).at(p_W), Space::unknown) << "its listener does not send the cube back";
  EXPECT_EQ(radio.map(1).at(p_W), Space::occupied);
}

TEST(MapNews, DamagedOrForeignMessagesLeaveTheMapUnchanged) {
  NewsRadio radio({}, 7);
  RandomStream random(7, "news_damage", 0);
  draw_space(*radio[0].map, random, Vector3d::Zero(), 20.0, 500);
  std::vector<std::uint8_t> whole;
  radio.damage = [&](std::size_t sender, std::vector<std::uint8_t>& bytes) {
    if (sender == 0 && bytes.size() > whole.size()) whole = bytes;
  };
  for (int i = 0; i < 40; ++i) radio.exchange();
  ASSERT_GT(whole.size(), 200U);
  WorldMap map(WorldMap::Config{});
  MapNews news(UavIndex(1), 2);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    PayloadReader cut(std::span<const std::uint8_t>(whole).first(length));
    EXPECT_FALSE(news.read(0, 1, map, cut)) << length;
  }
  WorldMap::Config larger;
  larger.cell_m = 0.75;
  WorldMap other(larger);
  PayloadReader of_other(whole), of_self(whole), of_none(whole), right(whole);
  EXPECT_FALSE(news.read(0, 1, other, of_other)) << "cubes of another size";
  EXPECT_FALSE(news.read(1, 1, map, of_self));
  EXPECT_FALSE(news.read(2, 1, map, of_none));
  EXPECT_TRUE(map.regions().empty() && other.regions().empty());
  EXPECT_TRUE(news.read(0, 1, map, right));
  EXPECT_TRUE(right.at_end());
  EXPECT_FALSE(map.regions().empty());
}

/// A damaged message that still reads as a message may make the map wrong. It does no other harm, and later messages
/// correct the map.
TEST(MapNews, DamagedMessagesNeitherBreakAnythingNorStopTheNews) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    NewsRadio radio({}, seed);
    RandomStream random(seed, "news_flips", 0);
    draw_space(*radio[0].map, random, Vector3d::Zero(), 30.0, 1500);
    radio.damage = [&](std::size_t sender, std::vector<std::uint8_t>& bytes) {
      if (sender != 0 || random.uniform() < 0.2) return;
      for (int flips = 0; flips < 3; ++flips) {
        const bool in_head = random.uniform() < 0.5;
        const double at =
            random.uniform() * static_cast<double>(in_head ? std::min<std::size_t>(24, bytes.size()) : bytes.size());
        std::uint8_t& byte = bytes[static_cast<std::size_t>(at)];
        byte = static_cast<std::uint8_t>(byte ^ 1U << static_cast<int>(random.uniform() * 8.0));
      }
    };
    for (int i = 0; i < 200; ++i) radio.exchange();
    radio.damage = nullptr;
    for (const Eigen::Vector3i& region : radio.map(1).regions()) EXPECT_LE(region.cwiseAbs().maxCoeff(), 1024);
    int exchanges = 0;
    while (exchanges < 600 && !radio.knows_all_of(1, 0)) {
      radio.exchange();
      ++exchanges;
    }
    EXPECT_LT(exchanges, 600) << seed;
  }
}

TEST(MapNews, ADamagedNumberDoesNotMakeTheSenderRepeatItsNewsForEver) {
  NewsRadio radio({}, 10);
  for (int i = 0; i < 40; ++i) radio.exchange();
  radio.damage = [&](std::size_t sender, std::vector<std::uint8_t>& bytes) {
    if (sender == 0) bytes.at(9) ^= 0x40U;  // the highest byte of the number
  };
  RandomStream random(10, "news_number", 0);
  draw_space(*radio[0].map, random, Vector3d::Zero(), 10.0, 300);
  for (int i = 0; i < 20; ++i) radio.exchange();
  EXPECT_TRUE(radio.knows_all_of(1, 0)) << "the damaged messages were accepted";
  radio.damage = nullptr;
  for (int i = 0; i < 100; ++i) radio.exchange();
  const std::size_t before = radio[0].bytes_sent();
  for (int i = 0; i < 200; ++i) radio.exchange();
  EXPECT_LE(radio[0].bytes_sent() - before, 11U * 90U);
}

TEST(MapNews, UavsOfALargeFleetShareTheirMaps) {
  NewsRadio radio({.uavs = 300}, 12);
  RandomStream random(12, "large_fleet", 0);
  const std::vector<std::size_t> chain = {299, 3, 260, 128};  // each hears the next one only
  const auto place = [&](std::size_t uav) { return std::ranges::find(chain, uav) - chain.begin(); };
  radio.linked = [&](std::size_t from, std::size_t to) {
    const auto last = static_cast<std::ptrdiff_t>(chain.size());
    return place(from) < last && place(to) < last && std::abs(place(from) - place(to)) == 1;
  };
  for (const std::size_t uav : chain) draw_space(*radio[uav].map, random, Vector3d::Zero(), 20.0, 300);
  for (int i = 0; i < 400; ++i) radio.exchange();
  for (const std::size_t a : chain) {
    for (const std::size_t b : chain) EXPECT_TRUE(radio.knows_all_of(a, b)) << a << " of " << b;
  }
  radio.restart(260);
  for (int i = 0; i < 400; ++i) radio.exchange();
  EXPECT_TRUE(radio.knows_all_of(260, 299)) << "it receives the map again after its restart";
}

TEST(MapNews, AUavHearsTheFirst127UavsThatItMeets) {
  constexpr std::size_t kUavs = 200, kHub = 7;
  NewsRadio radio({.uavs = kUavs}, 13);
  radio.linked = [](std::size_t from, std::size_t to) { return from == kHub || to == kHub; };
  const auto cube_of = [](std::size_t uav) { return Eigen::Vector3i(static_cast<int>(uav), 4, 4); };
  for (std::size_t uav = 0; uav < kUavs; ++uav) radio[uav].map->hear(cube_of(uav), 0, Space::occupied, kOwn);
  for (int i = 0; i < 200; ++i) radio.exchange();
  std::size_t known = 0;
  for (std::size_t uav = 0; uav < kUavs; ++uav) {
    known += radio.map(kHub).known(cube_of(uav)).space == Space::occupied;
    EXPECT_EQ(radio.map(uav).known(cube_of(kHub)).space, Space::occupied) << uav;
  }
  EXPECT_EQ(known, Acquaintances::kMostSlots + 1) << "the cubes of those UAVs, and its own";
}

}  // namespace
}  // namespace skein::agent
