// An explorer has flown for a minute, and then comes into line of sight of a photographer with an empty map. Checks how
// much of the space that the explorer knows to be free the photographer knows ten seconds later.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "tests/sensing/sensed_space.hpp"
#include "uav_agent/testing/news_radio.hpp"

namespace skein::sensing {
namespace {

using agent::test::NewsRadio;

constexpr double kHoverS = 8.0, kFlyS = 60.0, kSpeedMps = 2.0;

/// Flights that begin with a hover for one sweep of the LiDAR; the UAV faces its direction of flight.
std::vector<Flight> explorers() {
  const auto way_m = [](double t) { return kSpeedMps * std::max(0.0, t - kHoverS); };
  return {
      {"AlongALine", kHoverS + kFlyS, [=](double t) { return Isometry3d(Eigen::Translation3d(way_m(t), 0.0, 10.0)); }},
      {"InACircle", kHoverS + kFlyS, [=](double t) {
         const double a = way_m(t) / 15.0, yaw = a + 0.5 * std::numbers::pi;
         return Eigen::Translation3d(15.0 * std::cos(a), 15.0 * std::sin(a), 10.0 + 0.05 * way_m(t)) *
                Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
       }}};
}

struct Link {
  std::string name;
  double bytes_per_s = 20'000.0, loss = 0.0;
  std::optional<double> restart_s = {};  ///< time at which the photographer's program restarts [s]
};
const std::vector<Link> kLinks = {{"Whole", 20'000.0, 0.0, {}},
                                  {"HalfOfWhichSomeIsLost", 10'000.0, 0.3, {}},
                                  {"HalfOfWhichSomeIsLostAndARestart", 10'000.0, 0.3, 3.0}};

/// Cubes within 30 m of the explorer's route that are free in its map.
std::vector<Eigen::Vector3i> free_about_the_route(const SensedSpace& space) {
  std::vector<Eigen::Vector3i> cubes;
  agent::WorldMap::Chunk known;
  agent::test::visit_chunks(space.map(), [&](const Eigen::Vector3i& chunk) {
    space.map().read(chunk, known);
    for (int i = 0; i < static_cast<int>(known.size()); ++i) {
      const Eigen::Vector3i cube = 8 * chunk + Eigen::Vector3i(i % 8, i / 8 % 8, i / 64);
      const Vector3d p_W = (cube.cast<double>() + Vector3d::Constant(0.5)) * space.map().config().cell_m;
      if (known[static_cast<std::size_t>(i)].space != agent::Space::free) continue;
      if (space.distance_to_route_m(p_W) <= 30.0) cubes.push_back(cube);
    }
  });
  return cubes;
}

double known_share(const agent::WorldMap& map, const std::vector<Eigen::Vector3i>& cubes) {
  const auto known = std::ranges::count_if(
      cubes, [&](const Eigen::Vector3i& cube) { return map.known(cube).space == agent::Space::free; });
  return static_cast<double>(known) / static_cast<double>(cubes.size());
}

class ToldSpace : public testing::TestWithParam<std::size_t> {};

TEST_P(ToldSpace, APhotographerKnowsWhatItsExplorerKnowsAfterTenSeconds) {
  const Flight flight = explorers()[GetParam()];
  SensedSpace space(flight, 3.0, {});
  const std::vector<Eigen::Vector3i> cubes = free_about_the_route(space);
  ASSERT_GT(cubes.size(), 100'000U) << "the explorer has mapped too little";
  for (const Link& link : kLinks) {
    NewsRadio radio({.uavs = 2, .loss = link.loss, .news = {.bytes_per_s = link.bytes_per_s}}, 1);
    radio[0].map = &space.map();
    radio[0].p_W = space.scans().back().translation();
    radio[1].p_W = radio[0].p_W + Vector3d(0.0, 25.0, -5.0);
    radio[1].going_to_W = space.scans().front().translation();
    radio.linked = [](std::size_t, std::size_t) { return false; };
    while (radio.now() < ticks(2.0)) radio.exchange();
    radio.linked = [](std::size_t, std::size_t) { return true; };
    const Tick begin = radio.now();
    double needed_s = -1.0;
    while (radio.now() < begin + ticks(10.0)) {
      radio.exchange();
      const double t = seconds(radio.now() - begin);
      const bool restarts = link.restart_s && radio.now() == begin + ticks(*link.restart_s);
      if (restarts) radio.restart(1);
      if (restarts) needed_s = -1.0;
      if (needed_s < 0.0 && known_share(radio.map(1), cubes) >= 0.95) needed_s = t;
    }
    const double share = known_share(radio.map(1), cubes);
    std::cout << flight.name << ", " << link.name << ": " << share << " of " << cubes.size() << " cubes, 0.95 after "
              << needed_s << " s; " << radio[0].bytes_sent() << " bytes there, " << radio[1].bytes_sent() << " back\n";
    EXPECT_GE(share, 0.95) << link.name;
    EXPECT_LE(static_cast<double>(radio.most_bytes_in_a_second()), link.bytes_per_s) << link.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Flights, ToldSpace, testing::Range<std::size_t>(0, explorers().size()),
                         [](const auto& flight) { return explorers()[flight.param].name; });

}  // namespace
}  // namespace skein::sensing
