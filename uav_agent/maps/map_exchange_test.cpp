#include "uav_agent/maps/map_exchange.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace skein::agent {
namespace {

constexpr std::size_t kFleet = 3;

AgentConfig config_of(std::size_t self) {
  AgentConfig config;
  config.self = UavIndex(self);
  config.fleet.resize(kFleet);
  return config;
}

VoxelGrid empty_grid() { return {Isometry3d::Identity(), {40, 40, 20}, 2.0, 100}; }

struct MapKeeper {
  explicit MapKeeper(std::size_t uav) : peers(config_of(uav)) {}
  VoxelGrid grid = empty_grid();
  MapExchange exchange;
  Peers peers;
};

/// UAVs in a line: 0 hears 1, 1 hears both, 2 hears 1.
class Fleet {
 public:
  /// @param lose  each lose-th message is lost; 0: none.
  void round(int lose = 0) {
    now_ += 200;
    for (std::size_t i = 0; i < kFleet; ++i) {
      std::vector<Neighbour> neighbours;
      for (std::size_t j = 0; j < kFleet; ++j) {
        if (linked(i, j)) neighbours.push_back({node_of_uav(UavIndex(j)), Vector3d::Zero()});
      }
      nodes_[i].peers.update(now_, neighbours);
      PayloadWriter writer;
      nodes_[i].exchange.write(nodes_[i].grid, nodes_[i].peers, now_, writer);
      EXPECT_LE(writer.size(), kMaxPayloadBytes);
      bytes_ += writer.size();
      for (std::size_t j = 0; j < kFleet; ++j) {
        if (!linked(i, j) || (lose > 0 && ++messages_ % lose == 0)) continue;
        PayloadReader reader(writer.data());
        EXPECT_TRUE(nodes_[j].exchange.read(i, now_, nodes_[j].grid, reader));
        EXPECT_TRUE(reader.at_end());
      }
    }
  }
  bool agree() const {
    for (std::size_t chunk = 0; chunk < nodes_[0].grid.chunks(); ++chunk) {
      for (const MapKeeper& node : nodes_) {
        if (node.grid.chunk_hash(chunk) != nodes_[0].grid.chunk_hash(chunk)) return false;
      }
    }
    return true;
  }
  MapKeeper& operator[](std::size_t i) { return nodes_[i]; }
  std::size_t take_bytes() { return std::exchange(bytes_, 0); }

 private:
  static bool linked(std::size_t i, std::size_t j) { return i + 1 == j || j + 1 == i; }
  std::vector<MapKeeper> nodes_ = {MapKeeper(0), MapKeeper(1), MapKeeper(2)};
  Tick now_ = 0;
  int messages_ = 0;
  std::size_t bytes_ = 0;
};

void learn(Fleet& fleet) {
  for (VoxelGrid::Id id = 0; id < 4000; id += 7) fleet[0].grid.raise(id, VoxelState::free);
  for (VoxelGrid::Id id = 0; id < 4000; id += 11) fleet[2].grid.raise(id, VoxelState::occupied);
  for (VoxelGrid::Id id = 0; id < 4000; id += 13) fleet[1].grid.mark(id, 3);
}

TEST(MapExchange, AllUavsGetTheSameMapEvenThroughOthers) {
  Fleet fleet;
  learn(fleet);
  int rounds = 0;
  while (!fleet.agree() && rounds < 100) {
    fleet.round();
    ++rounds;
  }
  EXPECT_LE(rounds, 40) << "40 chunks, 4 a message";
  EXPECT_EQ(fleet[0].grid.state(11), VoxelState::occupied);
  EXPECT_TRUE(fleet[2].grid.marked(13, 3));
}

TEST(MapExchange, WithLostMessagesTheExchangeOnlyTakesLonger) {
  Fleet fleet;
  learn(fleet);
  int rounds = 0;
  while (!fleet.agree() && rounds < 200) {
    fleet.round(3);
    ++rounds;
  }
  EXPECT_LT(rounds, 80);
}

TEST(MapExchange, UavsWithEqualGridsSendNoChunks) {
  Fleet fleet;
  learn(fleet);
  for (int i = 0; i < 60; ++i) fleet.round();
  fleet.take_bytes();
  fleet.round();
  EXPECT_EQ(fleet.take_bytes(), 3 * (4 + 2 * fleet[0].grid.chunks() + 1)) << "they send hashes alone";
}

/// Also for the finest grid of the largest site. The rest of a payload is for the planner's other messages.
TEST(MapExchange, AMessageFitsIntoAPayloadWithAnyNumberOfCubes) {
  constexpr std::size_t kOfThePlanner = 200;
  for (const double edge_m : {20.0, 100.0, 250.0}) {
    VoxelGrid ours(Isometry3d::Identity(), Vector3d::Constant(edge_m), 1.0), theirs = ours;
    for (VoxelGrid::Id id = 0; id < 8000; ++id) {
      ours.raise(id, id % 2 == 0 ? VoxelState::free : VoxelState::occupied);  // the longest encoding
    }
    const auto peers_of = [](std::size_t uav, std::size_t other) {
      Peers peers(config_of(uav));
      const Neighbour neighbour{node_of_uav(UavIndex(other)), Vector3d::Zero()};
      peers.update(0, std::vector<Neighbour>(1, neighbour));
      return peers;
    };
    MapExchange we, they;
    PayloadWriter request, reply;
    they.write(theirs, peers_of(1, 0), 0, request);
    PayloadReader asked(request.data());
    ASSERT_TRUE(we.read(1, 0, ours, asked));
    we.write(ours, peers_of(0, 1), 0, reply);
    EXPECT_LE(reply.size() + kOfThePlanner, kMaxPayloadBytes) << ours.count() << " cubes";
    PayloadReader told(reply.data());
    ASSERT_TRUE(they.read(0, 0, theirs, told));
    EXPECT_EQ(theirs.state(1), VoxelState::occupied);
  }
}

TEST(MapExchange, MessagesOfAnotherGridAndDamagedOnesAreRefused) {
  Fleet fleet;
  learn(fleet);
  fleet.round();
  fleet.round();
  PayloadWriter writer;
  fleet[0].exchange.write(fleet[0].grid, fleet[0].peers, 1000, writer);
  VoxelGrid other(Isometry3d::Identity(), {40, 40, 22}, 2.0, 100), same = empty_grid();
  MapExchange exchange;
  PayloadReader whole(writer.data());
  EXPECT_FALSE(exchange.read(0, 1000, other, whole));
  for (std::size_t length = 0; length < writer.size(); ++length) {
    PayloadReader cut(std::span(writer.data()).first(length));
    EXPECT_FALSE(exchange.read(0, 1000, same, cut)) << length;
  }
}

}  // namespace
}  // namespace skein::agent
