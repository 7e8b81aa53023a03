// Messages about a UAV's status (core/messages/uav_status.hpp): what was encoded decodes again.
#include <gtest/gtest.h>

#include <limits>

#include "idl/conversions.hpp"

namespace skein {
namespace {

TEST(StatusConversions, TheOdometryCarriesItsUncertainty) {
  const PoseUncertainty told{{0.1, 0.2, 0.3}, 0.05, 0.02};
  const msg::Odometry odometry = to_odometry(40, "a", RigidBodyState{}, told);
  EXPECT_DOUBLE_EQ(odometry.pose().covariance()[7], 0.04);
  EXPECT_DOUBLE_EQ(odometry.pose().covariance()[35], 0.0025);
  const PoseUncertainty read = uncertainty_from_odometry(odometry);
  EXPECT_LT((read.position_m - told.position_m).norm(), 1e-12);
  EXPECT_NEAR(read.yaw, told.yaw, 1e-12);
  EXPECT_NEAR(read.velocity_mps, told.velocity_mps, 1e-12);
  EXPECT_TRUE(uncertainty_from_odometry(to_odometry(40, "a", RigidBodyState{})).exact());
  msg::Odometry odd = odometry;
  odd.pose().covariance()[0] = -1.0;
  odd.pose().covariance()[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(uncertainty_from_odometry(odd).position_m.head<2>().norm(), 0.0);
}

TEST(StatusConversions, ABatteryMessageFollowsRos2sConventions) {
  const msg::BatteryState message = to_battery(40, {0.5, 4.0, 22.2, 11.0}, 6);
  EXPECT_FLOAT_EQ(message.charge(), 2.0F);
  EXPECT_FLOAT_EQ(message.current(), -11.0F) << "negative while it discharges";
  ASSERT_EQ(message.cell_voltage().size(), 6U);
  EXPECT_FLOAT_EQ(message.cell_voltage()[5], 3.7F);
  const auto battery = from_battery(message);
  ASSERT_TRUE(battery);
  EXPECT_NEAR(battery->charge, 0.5, 1e-6);
  EXPECT_NEAR(battery->current_a, 11.0, 1e-5);
  msg::BatteryState odd = message;
  odd.percentage(std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(from_battery(odd));
}

TEST(StatusConversions, WindIsAVectorOfFiniteNumbers) {
  EXPECT_EQ(from_wind(to_wind(40, {1.0, -2.0, 0.5})), Vector3d(1.0, -2.0, 0.5));
  EXPECT_FALSE(from_wind(to_wind(40, {std::numeric_limits<double>::infinity(), 0.0, 0.0})));
}

TEST(StatusConversions, LinksComeBackExceptThoseWithANumberThatIsNotFinite) {
  const LinkQualities links = {{kStationNode, {-61.5, 1.5e6}}, {Node{3}, {-80.25, 162500.0}}};
  EXPECT_EQ(from_radio_links(to_radio_links(40, links)), links);
  EXPECT_TRUE(from_radio_links(to_radio_links(40, {})).empty());
  msg::RadioLinks odd = to_radio_links(40, links);
  odd.links()[0].received_dbm(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(from_radio_links(odd), (LinkQualities{links[1]}));
  odd.links()[1].rate(std::numeric_limits<float>::infinity());
  EXPECT_TRUE(from_radio_links(odd).empty());
}

}  // namespace
}  // namespace skein
