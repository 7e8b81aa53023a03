#include "view/fly_order.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "view/order.hpp"

namespace skein::view {
namespace {

TEST(FlyOrders, AreReadBackBitForBit) {
  RandomStream random(3, "fly orders", 0);
  for (int i = 0; i < 200; ++i) {
    const auto rate = [&] { return random.uniform(-kMostHandRate, kMostHandRate); };
    const auto speed = [&] { return random.uniform(-kMostHandMps, kMostHandMps); };
    const FlyOrder order{"jurong", {{speed(), speed(), speed()}, rate(), rate(), rate()}};
    EXPECT_EQ(read_fly_order(text_of(order)), order) << text_of(order);
    const auto any = read_order(text_of(Order(order)));
    ASSERT_TRUE(any && std::holds_alternative<FlyOrder>(*any));
    EXPECT_EQ(std::get<FlyOrder>(*any), order);
  }
  EXPECT_EQ(read_fly_order(text_of(FlyOrder{"jurong", {}})), (FlyOrder{"jurong", {}}))
      << "letting go of a UAV is an order, too";
}

TEST(FlyOrders, AnyOtherTextIsRefused) {
  const std::string uav = R"("uav":"jurong",)", velocity = R"("velocity":[1,0,0],)", yaw = R"("yaw_rate":0,)",
                    gimbal = R"("gimbal":[0,0])", begin = R"({"do":"fly",)";
  ASSERT_TRUE(read_fly_order(begin + uav + velocity + yaw + gimbal + "}"));
  for (const std::string& text : {std::string(),
                                  std::string("{}"),
                                  std::string("[]"),
                                  std::string("null"),
                                  std::string(R"({"do":"fly"})"),
                                  begin + velocity + yaw + gimbal + "}",
                                  begin + uav + yaw + gimbal + "}",
                                  begin + uav + velocity + gimbal + "}",
                                  begin + uav + velocity + yaw.substr(0, yaw.size() - 1) + "}",
                                  begin + uav + velocity + yaw + gimbal + R"(,"now":true})",
                                  R"({"do":"crash",)" + uav + velocity + yaw + gimbal + "}",
                                  R"({"do":1,)" + uav + velocity + yaw + gimbal + "}",
                                  begin + R"("uav":7,)" + velocity + yaw + gimbal + "}",
                                  begin + R"("uav":"",)" + velocity + yaw + gimbal + "}",
                                  begin + "\"uav\":\"" + std::string(101, 'x') + "\"," + velocity + yaw + gimbal + "}",
                                  begin + uav + R"("velocity":[1,0],)" + yaw + gimbal + "}",
                                  begin + uav + R"("velocity":[1,0,0,0],)" + yaw + gimbal + "}",
                                  begin + uav + R"("velocity":[1,null,0],)" + yaw + gimbal + "}",
                                  begin + uav + R"("velocity":[20.5,0,0],)" + yaw + gimbal + "}",
                                  begin + uav + R"("velocity":[1e999,0,0],)" + yaw + gimbal + "}",
                                  begin + uav + velocity + R"("yaw_rate":"0",)" + gimbal + "}",
                                  begin + uav + velocity + R"("yaw_rate":-4.5,)" + gimbal + "}",
                                  begin + uav + velocity + yaw + R"("gimbal":[0]})",
                                  begin + uav + velocity + yaw + R"("gimbal":[0,9]})",
                                  begin + uav + velocity + yaw + R"("gimbal":{"0":0,"1":0}})",
                                  begin + uav + velocity + yaw + gimbal + std::string(1000, ' ') + "}"}) {
    EXPECT_EQ(read_fly_order(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace skein::view
