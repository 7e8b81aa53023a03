// The orders that a learner obeys and the observations that it writes, in the block that it shares with Python. Orders
// and the UAV's knowledge are random.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "core/math/random_stream.hpp"
#include "uav_agent/api/learner.hpp"
#include "uav_agent/planners/learner/observation.hpp"
#include "uav_agent/planners/learner/orders.hpp"
#include "uav_agent/testing/flown_uav.hpp"
#include "uav_agent/testing/guarded_uav.hpp"

namespace skein::agent {
namespace {

constexpr int kDraws = 200;

/// The other program's side of a block: fields by name.
class Block {
 public:
  explicit Block(const BlockLayout& layout) : bytes_(layout.bytes()) {
    for (const BlockField& field : layout.fields()) fields_[field.name] = field;
  }
  std::byte* data() { return bytes_.data(); }

  /// @param row  of a table, or the number of an array
  template <class T>
  T& at(const std::string& name, std::size_t row = 0, std::size_t column = 0) {
    const BlockField& field = fields_.at(name);
    EXPECT_EQ(field.type.back() - '0', static_cast<int>(sizeof(T))) << name << ' ' << field.type;
    const std::size_t columns = field.shape.size() > 1 ? field.shape[1] : 1;
    return reinterpret_cast<T*>(bytes_.data() + field.offset)[row * columns + column];
  }
  Vector3d vector(const std::string& name, std::size_t row = 0) {
    const bool table = fields_.at(name).shape.size() > 1;
    const auto number = [&](std::size_t i) { return table ? at<double>(name, row, i) : at<double>(name, i); };
    return {number(0), number(1), number(2)};
  }

 private:
  std::map<std::string, BlockField> fields_;
  std::vector<std::byte> bytes_;
};

std::size_t drawn_count(RandomStream& random, std::size_t most) {
  return static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(most) + 0.999));
}

Vector3d drawn(RandomStream& random) { return drawn_within(random, 50.0); }

// ---- orders -----------------------------------------------------------------------------------------------------

class LearnerOrders : public testing::Test {
 protected:
  LearnerOrders() { orders_.use(block_.data()); }

  static BlockLayout lay_out(Orders& orders) {
    BlockLayout layout;
    orders.lay_out(layout, "");
    return layout;
  }

  RandomStream random_{7, "learner_test", "orders"};
  Orders orders_;
  Block block_{lay_out(orders_)};
};

TEST_F(LearnerOrders, TheUavIsToStayUntilTheFirstOrder) {
  EXPECT_FALSE(orders_.is_news(0));
  EXPECT_EQ(orders_.velocity(), HandCommand{});
  EXPECT_TRUE(orders_.way().empty());
  EXPECT_FALSE(orders_.yaw() || orders_.trigger());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(orders_.gimbal()));
}

TEST_F(LearnerOrders, AreReadAsTheyWereWritten) {
  for (int i = 1; i <= kDraws; ++i) {
    const Vector3d velocity = drawn(random_), wanted = drawn(random_);
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::size_t>(axis);
      block_.at<double>("velocity", at) = velocity[axis];
      block_.at<double>("gimbal", at) = wanted[axis];
    }
    block_.at<double>("yaw_rate") = velocity.x() / 7.0;
    block_.at<double>("yaw") = velocity.y() / 7.0;
    block_.at<std::int8_t>("turns") = static_cast<std::int8_t>(i % 2);
    block_.at<std::int8_t>("trigger") = static_cast<std::int8_t>(i / 2 % 2);
    block_.at<std::int8_t>("gimbal_kind") = static_cast<std::int8_t>(i % 4);
    block_.at<std::int64_t>("serial") = i;
    std::vector<Vector3d> way(drawn_count(random_, kMostWaypoints));
    for (std::size_t k = 0; k < way.size(); ++k) {
      way[k] = drawn(random_);
      for (int axis = 0; axis < 3; ++axis) block_.at<double>("way", k, static_cast<std::size_t>(axis)) = way[k][axis];
      block_.at<double>("way", k, 3) = static_cast<double>(k) + 0.5;
    }
    block_.at<std::int64_t>("waypoints") = static_cast<std::int64_t>(way.size());

    EXPECT_TRUE(orders_.is_news(i - 1) && !orders_.is_news(i));
    EXPECT_EQ(orders_.velocity(), (HandCommand{.velocity = velocity, .yaw_rate = velocity.x() / 7.0}));
    EXPECT_EQ(orders_.yaw(), i % 2 == 0 ? std::nullopt : std::optional(velocity.y() / 7.0));
    EXPECT_EQ(orders_.trigger(), i / 2 % 2 == 1);
    const std::vector<Waypoint> read = orders_.way();
    ASSERT_EQ(read.size(), way.size());
    for (std::size_t k = 0; k < way.size(); ++k) {
      EXPECT_EQ(read[k].p_WB, way[k]);
      EXPECT_EQ(read[k].speed_mps, static_cast<double>(k) + 0.5);
    }
    const GimbalAim aim = orders_.gimbal();
    EXPECT_EQ(aim.index(), std::vector<std::size_t>({0, 2, 2, 1})[static_cast<std::size_t>(i % 4)]);
    if (const auto* command = std::get_if<GimbalCommand>(&aim)) {
      EXPECT_EQ(command->mode, i % 4 == 1 ? GimbalMode::rate : GimbalMode::angle);
      EXPECT_EQ(command->pitch, wanted.x());
      EXPECT_EQ(command->yaw, wanted.y());
    }
    if (const auto* point_W = std::get_if<Vector3d>(&aim)) {
      EXPECT_EQ(*point_W, wanted);
    }
  }
}

// Another program may write any bytes into the block, so no number in it may lead beyond its tables.
TEST_F(LearnerOrders, AnyBytesAreReadWithinTheTables) {
  for (int i = 0; i < kDraws; ++i) {
    block_.at<std::int64_t>("waypoints") = static_cast<std::int64_t>(random_.bits());
    block_.at<std::int8_t>("gimbal_kind") = static_cast<std::int8_t>(random_.bits());
    EXPECT_LE(orders_.way().size(), kMostWaypoints);
    const auto kind = block_.at<std::int8_t>("gimbal_kind");
    EXPECT_EQ(std::holds_alternative<std::monostate>(orders_.gimbal()), kind < 1 || kind > 3);
  }
}

// ---- outputs of the planner ----------------------------------------------------------------------------------------

TEST(Learner, ObeysEachOrderOnce) {
  FlownUav uav(fleet_of(3, Role::explorer, 1), {0.0, 0.0, 20.0});
  const auto planner = make_planner("learner:flies=way", uav.agent);
  BlockLayout layout;
  planner->learner()->lay_out(layout, "");
  Block block(layout);
  planner->learner()->use(block.data());
  EXPECT_FALSE(planner->plan(uav.input()).goals) << "there is no order yet";
  for (int order = 1; order <= 3; ++order) {
    block.at<std::int8_t>("does.trigger") = 1;
    block.at<std::int64_t>("does.waypoints") = order - 1;
    ++block.at<std::int64_t>("does.serial");
    for (int step = 0; step < 3; ++step) {
      ++uav.k;
      const PlannerOutput out = planner->plan(uav.input());
      EXPECT_EQ(out.trigger, step == 0);
      ASSERT_EQ(out.goals.has_value(), step == 0);
      if (step == 0) {
        EXPECT_EQ(out.goals->size(), order == 1 ? 0U : 1U) << "an empty way means to stay";
      }
    }
  }
}

// ---- observations --------------------------------------------------------------------------------------------------

class LearnerObservation : public testing::Test {
 protected:
  LearnerObservation() {
    config_.detections = 8;
    config_.scans = true;
    observation_.lay_out(layout_, "");
    block_.emplace(layout_);
    observation_.use(block_->data());
  }
  Block& block() { return *block_; }
  void show(const PlannerInput& in) {
    observation_.note(in);
    observation_.write(in);
  }

  RandomStream random_{7, "learner_test", "observation"};
  FlownUav uav_{explorers(), {0.0, 0.0, 20.0}};
  LearnerConfig config_;
  Observation observation_{config_, uav_.agent};
  BlockLayout layout_;
  std::optional<Block> block_;

 private:
  static AgentConfig explorers() {
    AgentConfig agent = fleet_of(4, Role::explorer, 2);
    agent.vehicle.lidar.emplace();
    return agent;
  }
};

TEST_F(LearnerObservation, HoldsTheInputsOfItsUav) {
  for (int i = 0; i < kDraws; ++i) {
    ++uav_.k;
    uav_.state.p_WB = drawn(random_) + Vector3d(0.0, 0.0, 60.0);
    uav_.state.v_WB = drawn(random_);
    uav_.undelivered = drawn_count(random_, 9);
    uav_.linked = i % 3 == 0;
    uav_.remaining_s = i % 4 == 0 ? std::nullopt : std::optional(random_.uniform(0.0, 600.0));
    std::vector<Neighbour> seen;
    for (const std::size_t mate : {0U, 1U, 3U}) {
      if (drawn_count(random_, 1) == 1) {
        seen.push_back({node_of_uav(UavIndex(mate)), drawn(random_), drawn(random_)});
      }
    }
    const PlannerInput in = uav_.input();
    uav_.peers.update(in.tick, seen);
    show(in);
    EXPECT_EQ(block().vector("position"), in.state.p_WB);
    EXPECT_EQ(block().vector("velocity"), in.state.v_WB);
    EXPECT_EQ(block().at<double>("time_s"), seconds(in.tick));
    EXPECT_EQ(block().at<double>("time_left_s"), in.mission_remaining_s.value_or(uav_.agent.duration_s));
    EXPECT_EQ(block().at<std::int64_t>("undelivered"), static_cast<std::int64_t>(uav_.undelivered));
    EXPECT_EQ(block().at<std::int8_t>("linked"), uav_.linked ? 1 : 0);
    EXPECT_EQ(block().at<double>("scan_age_s"), -1.0) << "there was no scan yet";
    for (std::size_t row = 0; row < 3; ++row) {
      const Peer& peer = uav_.peers.all()[row];
      EXPECT_EQ(block().vector("peers", row), peer.p_W);
      EXPECT_EQ(block().vector("peer_velocities", row), peer.v_W);
      EXPECT_EQ(block().at<double>("peer_ages_s", row), peer.seen ? seconds(in.tick - *peer.seen) : -1.0);
      EXPECT_EQ(block().at<std::int8_t>("peers_linked", row), peer.visible ? 1 : 0);
    }
  }
}

TEST_F(LearnerObservation, HasTheNewestDetectionsAndCountsAll) {
  std::uint32_t order = 0;
  for (int i = 0; i < kDraws; ++i) {
    std::vector<DetectedPoint> all;
    const std::size_t exchanges = 1 + drawn_count(random_, 3);
    for (std::size_t k = 0; k < exchanges; ++k) {
      std::vector<DetectedPoint> now(drawn_count(random_, 5));
      for (DetectedPoint& point : now) point = {.p_W = drawn(random_).cast<float>(), .score = 0.5, .order = order++};
      all.insert(all.end(), now.begin(), now.end());
      ++uav_.k;
      PlannerInput in = uav_.input();
      in.detected = now;
      observation_.note(in);
    }
    observation_.write(uav_.input());
    EXPECT_EQ(block().at<std::int64_t>("detection_count"), static_cast<std::int64_t>(all.size()));
    const std::size_t shown = std::min<std::size_t>(all.size(), 8);
    for (std::size_t row = 0; row < 8; ++row) {
      const DetectedPoint expected = row < shown ? all[all.size() - shown + row] : DetectedPoint{};
      EXPECT_EQ(block().vector("detections", row), expected.p_W.cast<double>());
      EXPECT_EQ(block().at<double>("detections", row, 4), expected.order);
    }
  }
}

TEST_F(LearnerObservation, ShowsNoMoreBoxesThanItHasRowsFor) {
  for (int i = 0; i < 40; ++i) {
    uav_.boxes.push_back({.name = {}, .center = drawn(random_), .size = Vector3d(1.0, 2.0, i)});
  }
  show(uav_.input());
  EXPECT_EQ(block().at<std::int64_t>("box_count"), static_cast<std::int64_t>(kMostBoxes));
  for (std::size_t row = 0; row < kMostBoxes; ++row) EXPECT_EQ(block().vector("boxes", row), uav_.boxes[row].center);
}

TEST_F(LearnerObservation, KeepsTheLatestScanAndItsAge) {
  for (int i = 0; i < 20; ++i) {
    uav_.k += 3;
    PlannerInput in = uav_.input();
    std::vector<Scan> scans(2);
    for (Scan& scan : scans) {
      scan.tick = in.tick;
      scan.points_W.resize(drawn_count(random_, 40));
      for (Eigen::Vector3f& p_W : scan.points_W) p_W = drawn(random_).cast<float>();
    }
    in.scans = scans;
    observation_.note(in);
    uav_.k += 2;
    observation_.write(uav_.input());
    const std::vector<Eigen::Vector3f>& points_W = scans.back().points_W;
    ASSERT_EQ(block().at<std::int64_t>("scan_points"), static_cast<std::int64_t>(points_W.size()));
    EXPECT_NEAR(block().at<double>("scan_age_s"), 2.0 * uav_.agent.exchange_period_s, 1e-9);
    for (std::size_t row = 0; row < 41; ++row) {
      const Eigen::Vector3f expected = row < points_W.size() ? points_W[row] : Eigen::Vector3f::Zero();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(block().at<float>("scan", row, axis), expected[static_cast<Eigen::Index>(axis)]);
      }
    }
  }
}

class LearnerWindow : public LearnerObservation, public testing::WithParamInterface<double> {
 protected:
  /// State of the cell with this corner as the block must have it, from all cubes that reach into the cell.
  int expected(const Vector3d& corner_W) const {
    constexpr double kEdgeM = 1e-6;  // a cube that only touches the cell is not in it
    const int steps = static_cast<int>(std::ceil(config_.map_cell_m / uav_.map.config().cell_m));
    const double step_m = (config_.map_cell_m - 2.0 * kEdgeM) / steps;
    bool free = true;
    for (int x = 0; x <= steps; ++x) {
      for (int y = 0; y <= steps; ++y) {
        for (int z = 0; z <= steps; ++z) {
          const Space space = uav_.map.at((corner_W + Vector3d(x, y, z) * step_m).array() + kEdgeM);
          if (space == Space::occupied) return 1;
          free = free && space == Space::free;
        }
      }
    }
    return free ? 0 : -1;
  }
};

// The window must be right after each step, whether the map has changed, the UAV has moved, or neither.
TEST_P(LearnerWindow, IsTheMapAboutTheUav) {
  config_.map_cell_m = GetParam();
  for (int i = 0; i < 60; ++i) {
    ++uav_.k;
    if (i % 3 == 0) uav_.state.p_WB = drawn_within(random_, 12.0) + Vector3d(0.0, 0.0, 20.0);
    if (i % 2 == 0) {
      const Vector3d low = drawn_within(random_, 14.0) + Vector3d(0.0, 0.0, 20.0);
      i % 4 == 0 ? uav_.clear(low, low + Vector3d::Constant(6.0)) : uav_.build(low, low + Vector3d(0.5, 3.0, 2.0));
    }
    show(uav_.input());
    const Vector3d from_W = block().vector("map_origin");
    const Vector3d middle = (uav_.state.p_WB - from_W) / config_.map_cell_m;
    EXPECT_EQ(middle.array().floor().matrix(), Vector3d(config_.map_x / 2, config_.map_y / 2, config_.map_z / 2));
    for (int x = 0, at = 0; x < config_.map_x; ++x) {
      for (int y = 0; y < config_.map_y; ++y) {
        for (int z = 0; z < config_.map_z; ++z, ++at) {
          ASSERT_EQ(
              block().at<std::int8_t>("map", static_cast<std::size_t>(at) / 16, static_cast<std::size_t>(at) % 16),
              expected(from_W + Vector3d(x, y, z) * config_.map_cell_m))
              << i << ": " << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
}

/// Edges of cells [m]: multiples of a cube's edge, others, and some that are drawn.
std::vector<double> cell_edges() {
  std::vector<double> edges = {0.5, 0.7, 0.75, 1.0, 1.2};
  RandomStream random(7, "learner_test", "cells");
  for (int i = 0; i < 3; ++i) edges.push_back(random.uniform(0.5, 2.5));
  return edges;
}

INSTANTIATE_TEST_SUITE_P(Cells, LearnerWindow, testing::ValuesIn(cell_edges()));

}  // namespace
}  // namespace skein::agent
