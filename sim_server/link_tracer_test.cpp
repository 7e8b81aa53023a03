// The quality of links with path loss, from exchange to exchange.
#include "sim_server/link_tracer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/math/random_stream.hpp"
#include "sim_server/fleet_bodies.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

/// The tracer keeps the shadowing values of nodes that stand still. For any other node, it computes them once for all
/// links of the node.
TEST(LinkTracer, EachLinkHasThePowerThatThePathLossModelGives) {
  constexpr std::uint64_t kSeed = 3;
  Scenario scenario;
  scenario.conditions.radio = conditions_preset("harsh").radio;
  scenario.station_position = {-5.0, 2.0, 1.0};
  for (const char* name : {"a", "b", "c", "d"}) scenario.fleet.emplace_back().name = name;
  const FaultPlan no_faults;
  LinkTracer tracer(scenario, no_faults, kSeed);
  const PathLoss path_loss(scenario.conditions.radio, kSeed);
  const RayScene rays(TriangleMesh{}, body_shapes(scenario));
  RandomStream draw(2, "link_tracer_test", 0);
  std::vector<LinkTracer::Place> uavs(scenario.fleet.size());
  std::size_t linked = 0, silent = 0;
  for (Tick tick = 0; tick < 200; ++tick) {
    for (LinkTracer::Place& uav : uavs) {
      if (tick == 0 || draw.uniform() < 0.5) uav.p_WB = test::random_in_box(draw, {-150, -150, 5}, {150, 150, 40});
    }
    uavs.back().alive = tick < 150;
    const Links links = tracer.trace(tick, rays, uavs);
    const auto place = [&](Node node) {
      return node == kStationNode ? scenario.station_position : uavs[node - 1].p_WB;
    };
    for (const Node from : scenario.nodes()) {
      for (const Node to : scenario.nodes()) {
        if (from == to) continue;
        const bool dead = tick >= 150 && (from == scenario.fleet.size() || to == scenario.fleet.size());
        const double power_dbm = path_loss.received_dbm(place(from), place(to));
        ASSERT_EQ(links.at(from, to), dead ? 0 : PathLoss::level(power_dbm)) << tick;
        const auto quality = tracer.quality(links.at(from, to), from, to);
        ASSERT_EQ(quality.has_value(), links.at(from, to) != 0);
        ASSERT_EQ(quality ? quality->received_dbm : power_dbm, power_dbm) << tick;
        ++(quality ? linked : silent);
      }
    }
  }
  EXPECT_GT(linked, 500U);
  EXPECT_GT(silent, 500U);
}

/// With a common range, the tracer looks only at pairs of UAVs in adjacent squares.
TEST(LinkTracer, TracingNearPairsOnlyGivesTheSameLinksAsTracingAllPairs) {
  RandomStream draw(4, "link_tracer_test", 1);
  const FaultPlan no_faults;
  for (int i = 0; i < 40; ++i) {
    Scenario scenario;
    scenario.station_position = test::random_in_box(draw, {-60, -60, 0}, {60, 60, 60});
    const int uavs = 2 + static_cast<int>(draw.uniform() * 40.0);
    for (int uav = 0; uav < uavs; ++uav) scenario.fleet.emplace_back().name = "u" + std::to_string(uav);
    const double range_m = draw.uniform(0.5, 80.0);
    const bool station_too = draw.uniform() < 0.5;
    const std::vector<std::string> nodes = {station_too ? "all" : "uavs"};
    LinkEffect& of_all = scenario.links.emplace_back();
    of_all.from = of_all.to = nodes;
    of_all.range_m = range_m;
    LinkEffect& of_one = scenario.links.emplace_back();
    of_one.from = {"u1"};
    of_one.range_m = draw.uniform(0.5, 80.0);
    LinkTracer tracer(scenario, no_faults);
    Scenario pairwise = scenario;  // the same ranges, as effects of which none limits all pairs
    pairwise.links[0].from = pairwise.links[0].to = {station_too ? "all" : "uavs", "u0"};
    LinkTracer plain(pairwise, no_faults);
    const RayScene rays(TriangleMesh{}, body_shapes(scenario));
    for (Tick tick = 0; tick < 5; ++tick) {
      std::vector<LinkTracer::Place> places(scenario.fleet.size());
      for (LinkTracer::Place& place : places) {
        place.p_WB = test::random_in_box(draw, {-60, -60, 1}, {60, 60, 30});
        if (draw.uniform() < 0.3) place.p_WB.x() = range_m * std::round(place.p_WB.x() / range_m);
      }
      EXPECT_EQ(tracer.trace(tick, rays, places), plain.trace(tick, rays, places)) << i << ", range " << range_m;
    }
  }
}

}  // namespace
}  // namespace skein::sim
