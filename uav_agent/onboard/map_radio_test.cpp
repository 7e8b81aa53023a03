// Maps that agents send each other by themselves. Their planners only state that they want them.
#include "uav_agent/onboard/map_radio.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/vehicle/lidar_geometry.hpp"
#include "uav_agent/onboard/agent.hpp"
#include "uav_agent/testing/news_radio.hpp"

namespace skein::agent {
namespace {

constexpr Tick kExchangeTicks = 20;

/// Keeps its inputs, sends a message in each exchange, and may report where it goes.
struct MapLooker final : Planner {
  explicit MapLooker(bool wants) : wants(wants) {}
  PlannerOutput plan(const PlannerInput& in) override {
    map = in.world_map;
    heard.insert(heard.end(), in.radio.begin(), in.radio.end());
    return {.motion = motion,
            .radio = {{.topic = "/plan", .text = "looker/1 hello", .source = {}}},
            .going_to_W = going_to_W};
  }
  bool wants_world_map() const override { return wants; }

  const bool wants;
  const WorldMap* map = nullptr;
  std::vector<RadioMessage> heard;
  Motion motion = {};
  std::optional<Vector3d> going_to_W;
};

/// The fleet of a test: UAV 0 has a LiDAR in empty space, the others have none; they hover and hear each other.
class Talkers {
 public:
  Talkers(std::size_t uavs, std::uint64_t seed, double loss) : random_(seed, "talkers", 0), loss_(loss), uavs_(uavs) {
    for (std::size_t uav = 0; uav < uavs; ++uav) restart(uav);
  }

  void restart(std::size_t uav, bool wants = true) {
    AgentConfig config;
    config.self = UavIndex(uav);
    config.fleet.resize(uavs_.size());
    config.vehicle.lidar.reset();
    if (uav == 0) config.vehicle.lidar.emplace();
    auto planner = std::make_unique<MapLooker>(wants);
    uavs_[uav].planner = planner.get();
    uavs_[uav].agent = std::make_unique<Agent>(config, std::move(planner));
  }

  void exchange(bool scans) {
    tick_ += kExchangeTicks;
    std::vector<std::vector<RadioMessage>> arriving(uavs_.size());
    for (std::size_t uav = 0; uav < uavs_.size(); ++uav) {
      for (const RadioMessage& message : uavs_[uav].sent) {
        if (MapRadio::is_of_maps(message)) ++uavs_[uav].told;
        for (std::size_t other = 0; other < uavs_.size(); ++other) {
          if (linked(uav, other) && random_.uniform() >= loss_) arriving[other].push_back(message);
        }
      }
    }
    for (std::size_t uav = 0; uav < uavs_.size(); ++uav) {
      AgentInput input;
      input.tick = tick_;
      input.state.p_WB = place_W(uav);
      for (std::size_t other = 0; other < uavs_.size(); ++other) {
        if (linked(uav, other)) input.neighbours.push_back({node_of_uav(UavIndex(other)), place_W(other)});
      }
      input.radio = arriving[uav];
      if (uav == 0 && scans && tick_ % (2 * kExchangeTicks) == 0) {
        const double way = static_cast<double>(tick_ / 40 % 80);  // from side to side, without an end
        input.servos = {{tick_, 0.08 * (std::min(way, 80.0 - way) - 20.0), way < 40.0 ? 0.8 : -0.8}};
        input.scans = {{.tick = tick_, .points_W = met(lidar_pose(input.state.X_WB(), input.servos[0].angle))}};
      }
      uavs_[uav].sent = uavs_[uav].agent->step(input).radio;
    }
  }

  /// @returns number of exchanges, without scans, until the listener knows all of the teller's map; at most `most`.
  int exchanges_to_know(std::size_t listener, std::size_t teller, int most) {
    for (int count = 0; count < most; ++count) {
      if (count % 10 == 0 && test::knows_all_of(map(listener), map(teller))) return count;
      exchange(false);
    }
    return most;
  }

  /// From now on this UAV neither sends nor receives messages.
  void hide(std::size_t uav) { hidden_ = uav; }
  void show() { hidden_.reset(); }
  /// A thing of half a metre, which the LiDAR sees.
  void place(const std::optional<Vector3d>& thing_W) { thing_W_ = thing_W; }
  std::size_t doubts(std::size_t uav) const {
    std::size_t doubts = 0;
    test::visit_chunks(map(uav), [&](const Eigen::Vector3i& chunk) {
      for (std::size_t at = 0; at < MapLevel::kCells; ++at) {
        doubts += map(uav).doubted(chunk * WorldMap::kChunk + MapLevel::in_block(at));
      }
    });
    return doubts;
  }

  const WorldMap& map(std::size_t uav) const { return *uavs_[uav].planner->map; }
  MapLooker& planner(std::size_t uav) { return *uavs_[uav].planner; }
  int told(std::size_t uav) const { return uavs_[uav].told; }

 private:
  bool linked(std::size_t uav, std::size_t other) const { return uav != other && hidden_ != uav && hidden_ != other; }
  std::vector<Eigen::Vector3f> met(const Isometry3d& X_WL) const {
    std::vector<Eigen::Vector3f> points_W;
    if (!thing_W_) return points_W;
    const LidarConfig lidar;
    const Vector3d p_L = X_WL.inverse() * *thing_W_;
    for (int beam = 0; beam < lidar.rings * lidar.columns; ++beam) {
      const Vector3d direction_L = lidar_direction_L(lidar, beam / lidar.columns, beam % lidar.columns);
      const Vector3d point_L = p_L.dot(direction_L) * direction_L;
      if (p_L.dot(direction_L) > 0.0 && (point_L - p_L).norm() < 0.25) {
        points_W.push_back((X_WL * point_L).cast<float>());
      }
    }
    return points_W;
  }
  static Vector3d place_W(std::size_t uav) { return {0.0, 8.0 * static_cast<double>(uav), 10.0}; }

  struct Uav {
    std::unique_ptr<Agent> agent;
    MapLooker* planner = nullptr;
    std::vector<RadioMessage> sent;
    int told = 0;
  };
  RandomStream random_;
  const double loss_;
  std::optional<std::size_t> hidden_;
  std::optional<Vector3d> thing_W_;
  std::vector<Uav> uavs_;
  Tick tick_ = 0;
};

constexpr int kMostExchanges = 1000;

TEST(MapRadio, AllUavsGetAnExplorersMapWithoutCallsOfTheirPlanners) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Talkers talkers(3, seed, 0.3);
    for (int i = 0; i < 200; ++i) talkers.exchange(true);
    EXPECT_GT(talkers.map(0).counts().free[0], 1'000U) << "there is something to send";
    EXPECT_LT(talkers.exchanges_to_know(1, 0, kMostExchanges), kMostExchanges) << seed;
    EXPECT_LT(talkers.exchanges_to_know(2, 0, kMostExchanges), kMostExchanges) << seed;
    for (std::size_t uav = 0; uav < 3; ++uav) {
      EXPECT_GT(talkers.planner(uav).heard.size(), 200U);
      EXPECT_TRUE(std::ranges::all_of(talkers.planner(uav).heard, [](const RadioMessage& message) {
        return message.topic == "/plan" && message.text == "looker/1 hello";
      })) << "planners receive messages of planners, and nothing else";
    }
  }
}

TEST(MapRadio, ARestartedUavReceivesTheMapAgain) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (const std::size_t restarted : {0U, 1U}) {
      Talkers talkers(2, seed, 0.3);
      for (int i = 0; i < 200; ++i) talkers.exchange(true);
      ASSERT_LT(talkers.exchanges_to_know(1, 0, kMostExchanges), kMostExchanges);
      const std::size_t other = 1 - restarted;
      talkers.restart(restarted);
      talkers.exchange(false);
      EXPECT_FALSE(test::knows_all_of(talkers.map(restarted), talkers.map(other)));
      EXPECT_LT(talkers.exchanges_to_know(restarted, other, kMostExchanges), kMostExchanges) << seed;
    }
  }
}

TEST(MapRadio, AnAgentWhosePlannerWantsNoMapSendsNone) {
  Talkers talkers(3, 1, 0.0);
  talkers.restart(2, false);
  for (int i = 0; i < 200; ++i) talkers.exchange(true);
  EXPECT_GT(talkers.told(0), 10);
  EXPECT_GT(talkers.told(1), 10);
  EXPECT_EQ(talkers.told(2), 0);
  EXPECT_EQ(talkers.planner(2).map, nullptr);
  EXPECT_EQ(talkers.planner(2).heard.size(), 2 * 199U) << "its planner receives messages of planners only";
}

TEST(MapRadio, OnlyMessagesOfMapsAreKeptFromPlanners) {
  for (const char* text : {"map/1", "map/12 x", "map x", "amap/1 x", ""}) {
    EXPECT_FALSE(MapRadio::is_of_maps({.topic = "/plan", .text = text, .source = {}})) << text;
  }
  EXPECT_TRUE(MapRadio::is_of_maps({.topic = "/plan", .text = "map/1 x", .source = {}}));
  EXPECT_FALSE(MapRadio::is_of_maps({.topic = "/broadcast", .text = "map/1 x", .source = {}}));
}

/// The LiDAR sees a thing while UAV 2 is out of sight, and never again.
TEST(MapRadio, AHitThatMayBeAnUnheardUavIsDoubtedWhenTheUavIsHeardAgain) {
  Talkers talkers(3, 1, 0.0);
  const Vector3d thing_W(5.0, 12.0, 10.0);
  for (int i = 0; i < 120; ++i) talkers.exchange(true);
  talkers.hide(2);
  for (int i = 0; i < 40; ++i) talkers.exchange(true);
  talkers.place(thing_W);
  for (int i = 0; i < 200; ++i) talkers.exchange(true);
  talkers.place(std::nullopt);
  for (int i = 0; i < 40; ++i) talkers.exchange(true);
  for (const std::size_t uav : {0U, 1U}) {
    EXPECT_GT(talkers.map(uav).counts().occupied, 0U) << uav;
    EXPECT_EQ(talkers.doubts(uav), 0U) << uav;
  }
  talkers.show();
  for (int i = 0; i < 80; ++i) talkers.exchange(false);
  for (const std::size_t uav : {0U, 1U}) EXPECT_EQ(talkers.doubts(uav), talkers.map(uav).counts().occupied) << uav;
}

/// A UAV receives the map on its left and on its right, equally far, from a UAV with little capacity to send. The test
/// finds out of which side it knows more first.
double share_of_right(const std::function<void(MapLooker&)>& tell_way, std::uint64_t seed) {
  AgentConfig config;
  config.fleet.resize(2);
  config.vehicle.lidar.reset();
  auto owned = std::make_unique<MapLooker>(true);
  MapLooker& planner = *owned;
  Agent agent(config, std::move(owned));
  WorldMap map{WorldMap::Config()};
  RandomStream random(seed, "map_ways", 0);
  for (const double y : {-40.0, 40.0}) test::draw_space(map, random, {0.0, y, 10.0}, 20.0, 3000);
  MapNews teller(UavIndex{1}, 2, {.bytes_per_s = 2'000.0});
  const Vector3d there_W(-5.0, 0.0, 10.0);
  AgentInput input;
  input.state.p_WB = {0.0, 0.0, 10.0};
  Peers seen_by_teller([] {
    AgentConfig of_teller;
    of_teller.self = UavIndex{1};
    of_teller.fleet.resize(2);
    return of_teller;
  }());
  tell_way(planner);
  for (int i = 0; i < 100; ++i) {
    input.tick += kExchangeTicks;
    input.neighbours = {{node_of_uav(UavIndex{1}), there_W}};
    seen_by_teller.update(input.tick, {{node_of_uav(UavIndex{0}), input.state.p_WB}});
    const std::vector<RadioMessage> sent = agent.step(input).radio;
    PayloadWriter writer;
    for (const RadioMessage& message : sent) {
      const auto payload = open_payload(message, kMapMessages, 2);
      if (!payload) continue;
      PayloadReader reader(payload->bytes);
      teller.read(payload->sender, input.tick, map, reader);
    }
    input.radio.clear();
    if (i < 40 || !teller.write(map, seen_by_teller, std::nullopt, input.tick, writer)) continue;
    input.radio = {send_payload(kMapMessages, 1, writer)};
  }
  double left = 0.0, right = 0.0;
  test::visit_chunks(*planner.map, [&](const Eigen::Vector3i& chunk) { (chunk.y() < 0 ? right : left) += 1.0; });
  EXPECT_GT(left + right, 20.0);
  return right / (left + right);
}

TEST(MapRadio, SpaceOnTheWayThatAPlannerStatesComesFirst) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto side = [](double y) { return [y](MapLooker& planner) { planner.going_to_W = Vector3d(0.0, y, 10.0); }; };
    EXPECT_GT(share_of_right(side(-60.0), seed), 0.95);
    EXPECT_LT(share_of_right(side(60.0), seed), 0.05);
    const double unsaid = share_of_right([](MapLooker&) {}, seed);
    EXPECT_GT(unsaid, 0.2);
    EXPECT_LT(unsaid, 0.8);
  }
}

TEST(MapRadio, SpaceOnTheTrackersWayComesFirstIfThePlannerStatesNone) {
  const auto flies = [](MapLooker& planner) { planner.motion = Setpoint{.p_WB = {0.0, -60.0, 10.0}}; };
  EXPECT_GT(share_of_right(flies, 1), 0.95);
  const auto says = [](MapLooker& planner) {
    planner.motion = Setpoint{.p_WB = {0.0, -60.0, 10.0}};
    planner.going_to_W = Vector3d(0.0, 60.0, 10.0);
  };
  EXPECT_LT(share_of_right(says, 1), 0.05);
}

}  // namespace
}  // namespace skein::agent
