#include "idl/conversions.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "idl/cdr.hpp"

namespace skein {
namespace {

Vector3d random_vector(RandomStream& random, double bound) {
  return {random.uniform(-bound, bound), random.uniform(-bound, bound), random.uniform(-bound, bound)};
}

// Through the wire and back.
template <class Message>
Message travelled(const Message& message) {
  Message received;
  EXPECT_TRUE(decode(encode(message), received));
  return received;
}

TEST(Conversions, OdometryKeepsThePoseExactlyAndHasTheTwistInTheBodyFrame) {
  RandomStream random(1, "odometry", 0);
  for (int i = 0; i < 100; ++i) {
    RigidBodyState state;
    state.p_WB = random_vector(random, 100.0);
    state.q_WB = Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
    state.v_WB = random_vector(random, 8.0);
    state.w_WB_B = random_vector(random, 3.0);
    const msg::Odometry odometry = travelled(to_odometry(i, "jurong", state));
    const RigidBodyState back = from_odometry(odometry);
    EXPECT_EQ(back.p_WB, state.p_WB);
    EXPECT_EQ(back.q_WB.coeffs(), state.q_WB.coeffs());
    EXPECT_EQ(back.w_WB_B, state.w_WB_B);
    EXPECT_LT((back.v_WB - state.v_WB).norm(), 1e-12);
    const auto& linear = odometry.twist().twist().linear();
    EXPECT_LT((Vector3d(linear.x(), linear.y(), linear.z()) - state.q_WB.conjugate() * state.v_WB).norm(), 1e-12);
  }
}

TEST(Conversions, StampsCountNanosecondsExactly) {
  EXPECT_EQ(to_time(1).nanosec(), 2'500'000U);
  EXPECT_EQ(to_time(400 * 600 + 1).sec(), 600);
  EXPECT_EQ(to_time(400 * 600 + 1).nanosec(), 2'500'000U);
  EXPECT_DOUBLE_EQ(from_duration(to_duration(599.95)), 599.95);
  for (const Tick tick : {0, 1, 41, 399, 400, 401, 400 * 3600 + 7}) EXPECT_EQ(from_time(to_time(tick)), tick);
}

TEST(Conversions, ATrajectoryCommandComesBack) {
  RandomStream random(2, "trajectory", 0);
  for (int i = 0; i < 100; ++i) {
    const TrajectoryCommand command{random_vector(random, 100.0), random_vector(random, 5.0),
                                    random_vector(random, 2.0), random.uniform(-3.1, 3.1), random.uniform(-2.0, 2.0)};
    const auto back = from_trajectory(travelled(to_trajectory(7, command)));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->p_WB, command.p_WB);
    EXPECT_EQ(back->v_WB, command.v_WB);
    EXPECT_EQ(back->a_WB, command.a_WB);
    EXPECT_NEAR(back->yaw, command.yaw, 1e-12);
    EXPECT_EQ(back->yaw_rate, command.yaw_rate);
  }
  EXPECT_FALSE(from_trajectory(msg::MultiDOFJointTrajectory{}));
}

TEST(Conversions, OnlyTheJointOfTheLidarServoIsRead) {
  const msg::JointState joints = travelled(to_lidar_servo({1240, -0.7, 0.785}));
  EXPECT_EQ(joints.name(), std::vector<std::string>{"lidar_servo"});
  EXPECT_TRUE(joints.effort().empty());
  const auto servo = from_lidar_servo(joints);
  ASSERT_TRUE(servo);
  EXPECT_EQ(servo->tick, 1240);
  EXPECT_EQ(servo->angle, -0.7);
  EXPECT_EQ(servo->rate, 0.785);

  msg::JointState two = joints;
  two.name({"rotor", "lidar_servo"});
  EXPECT_FALSE(from_lidar_servo(two)) << "the second has no position";
  two.position({9.0, 0.5});
  two.velocity({8.0, 0.25});
  EXPECT_EQ(from_lidar_servo(two)->angle, 0.5);
  EXPECT_EQ(from_lidar_servo(two)->rate, 0.25);
  two.velocity({8.0});
  EXPECT_FALSE(from_lidar_servo(two));
  two.velocity({8.0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_FALSE(from_lidar_servo(two));
  EXPECT_FALSE(from_lidar_servo({}));
}

TEST(Conversions, GimbalModesAreSignsOfLinearX) {
  for (const GimbalMode mode : {GimbalMode::angle, GimbalMode::rate}) {
    const GimbalCommand back = from_gimbal_command(travelled(to_gimbal_command({mode, 0.3, -0.7})));
    EXPECT_EQ(back.mode, mode);
    EXPECT_EQ(back.pitch, 0.3);
    EXPECT_EQ(back.yaw, -0.7);
  }
  EXPECT_EQ(from_gimbal_command(to_gimbal_command({GimbalMode::freeze, 1.0, 1.0})).mode, GimbalMode::freeze);
  msg::Twist hardly_negative;
  hardly_negative.linear().x(-1e-8);
  EXPECT_EQ(from_gimbal_command(hardly_negative).mode, GimbalMode::freeze);
}

TEST(Conversions, BoxesComeBackFromTheirVertices) {
  RandomStream random(3, "boxes", 0);
  std::vector<OrientedBox> boxes;
  for (int i = 0; i < 15; ++i) {
    OrientedBox box;
    box.center = random_vector(random, 60.0);
    box.size = random_vector(random, 20.0).cwiseAbs() + Vector3d::Constant(1.0);
    box.R_WO =
        Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized().toRotationMatrix();
    boxes.push_back(box);
  }
  const auto back = from_box_vertices(travelled(to_box_vertices(0, boxes)));
  ASSERT_EQ(back.size(), boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_LT((back[i].center - boxes[i].center).norm(), 1e-4);
    EXPECT_LT((back[i].size - boxes[i].size).norm(), 1e-4);
    EXPECT_LT((back[i].R_WO - boxes[i].R_WO).norm(), 1e-4);
    EXPECT_LT((back[i].R_WO * back[i].R_WO.transpose() - Matrix3d::Identity()).norm(), 1e-12);
  }
}

TEST(Conversions, CloudsComeBackAndOtherLayoutsAreRefused) {
  const std::vector<NeighbourPoint> neighbours = {{.x = 1, .y = 2, .z = 3, .node = 4, .t = 5.5, .vx = 6}};
  const msg::PointCloud2 cloud = travelled(to_cloud(9, neighbours));
  const auto back = from_cloud<NeighbourPoint>(cloud);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].node, 4.0F);
  EXPECT_EQ(back[0].t, 5.5);
  EXPECT_EQ(back[0].vx, 6.0F);
  EXPECT_TRUE(from_cloud<ScanPoint>(cloud).empty());
  EXPECT_TRUE(from_cloud<ScanPoint>(msg::PointCloud2{}).empty());
}

// Names, order and meaning of the channels are CARIC's: programs that show a score find them by name.
TEST(Conversions, TheScoreCloudHasFourChannelsAndOnRequestTheIndices) {
  RandomStream random(4, "score", 0);
  std::vector<ScoredPoint> points;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Eigen::Vector3f p = random_vector(random, 80.0).cast<float>();
    points.push_back({{p, random_vector(random, 1.0).cast<float>().normalized()},
                      static_cast<float>(random.uniform(0.2, 1.0)),
                      3 * i + 7});
  }
  for (const bool with_indices : {false, true}) {
    const msg::PointCloud cloud = travelled(to_score_cloud(41, points, with_indices));
    EXPECT_EQ(cloud.header().frame_id(), "world");
    EXPECT_EQ(cloud.header().stamp().nanosec(), 102'500'000U);
    std::vector<std::string> names;
    for (const auto& channel : cloud.channels()) {
      names.push_back(channel.name());
      ASSERT_EQ(channel.values().size(), points.size()) << channel.name();
    }
    std::vector<std::string> expected = {"normal_x", "normal_y", "normal_z", "score"};
    if (with_indices) expected.push_back("global_index");
    ASSERT_EQ(names, expected);
    ASSERT_EQ(cloud.points().size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& at = cloud.points()[i];
      EXPECT_EQ(Eigen::Vector3f(at.x(), at.y(), at.z()), points[i].point.p_W);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(cloud.channels()[axis].values()[i], points[i].point.n_W[static_cast<Eigen::Index>(axis)]);
      }
      EXPECT_EQ(cloud.channels()[3].values()[i], points[i].score);
      if (with_indices) {
        EXPECT_EQ(cloud.channels()[4].values()[i], static_cast<float>(points[i].index));
      }
    }
  }
}

TEST(Conversions, InterestPointsReachTheStationAsTheyAre) {
  const InterestPoint point{{1.5F, -2.25F, 1e-7F}, {0.0F, 0.6F, -0.8F}};
  const InterestPoint back = from_message(travelled(to_message(point)));
  EXPECT_EQ(back.p_W, point.p_W);
  EXPECT_EQ(back.n_W, point.n_W);
}

TEST(Conversions, LedgerEntriesComeBackByName) {
  const std::vector<std::string> fleet = {"jurong", "raffles"};
  LedgerEntry entry{.index = 3,
                    .tick = 41,
                    .uav = UavIndex{1},
                    .collision = false,
                    .capture = {UavIndex{1}, 2, 41, 77, {{5, 0.5F, 0.5F, 0.25F}}}};
  const auto back = from_message(travelled(to_message(entry, fleet)), fleet);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, entry);
  const LedgerEntry collision{.index = 4, .tick = 50, .uav = UavIndex{0}, .collision = true, .capture = {}};
  EXPECT_EQ(from_message(to_message(collision, fleet), fleet), collision);
  EXPECT_FALSE(from_message(to_message(entry, fleet), std::vector<std::string>{"jurong"}));
}

TEST(Conversions, ACorruptedAcknowledgementAcknowledgesNothing) {
  RandomStream random(1, "acks", 0);
  for (int round = 0; round < 20; ++round) {
    std::vector<std::uint64_t> captures(1 + random.bits() % 6);
    for (std::uint64_t& capture : captures) capture = random.bits() % 1000;
    const std::vector<std::uint8_t> whole = encode(to_capture_ack("changi", captures));
    msg::CaptureAck ack;
    ASSERT_TRUE(decode(whole, ack));
    EXPECT_EQ(from_capture_ack(ack, "changi"), captures);
    EXPECT_TRUE(from_capture_ack(ack, "jurong").empty()) << "the acknowledgement is for another UAV";
    int read = 0;
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      std::vector<std::uint8_t> hit = whole;
      hit[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      msg::CaptureAck damaged;
      if (!decode(hit, damaged)) continue;
      ++read;
      const std::vector<std::uint64_t> taken = from_capture_ack(damaged, "changi");
      EXPECT_TRUE(taken.empty() || taken == captures) << "bit " << bit;  // bits of the padding have no meaning
    }
    EXPECT_GT(read, 64) << "else the checksum is hardly tested, because most messages are unreadable";
  }
}

}  // namespace
}  // namespace skein
