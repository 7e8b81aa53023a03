// Orders about faults: each is read back as it was written, and no other text is accepted.
#include "view/fault_order.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/faults/fault_writer.hpp"
#include "process/json_text.hpp"
#include "view/order.hpp"

namespace skein::view {
namespace {

const std::vector<std::string> kOrders = {
    R"({"do":"fault","kind":"link","from":"changi","to":"gcs"})",
    R"({"do":"fault","kind":"link","from":"gcs","to":"changi","for_s":5.0})",
    R"({"do":"fault","kind":"blackout","of":"changi"})",
    R"({"do":"fault","kind":"station_outage"})",
    R"({"do":"fault","kind":"kill","of":"station","for_s":2.5})",
    R"({"do":"fault","kind":"pause","of":"comm_router"})",
    R"({"do":"fault","kind":"lidar_failure","of":"jurong"})",
    R"({"do":"fault","kind":"camera_failure","of":"changi"})",
    R"({"do":"fault","kind":"stuck_gimbal","of":"changi"})",
    R"({"do":"fault","kind":"odometry_freeze","of":"changi"})",
    R"({"do":"fault","kind":"motor_failure","of":"changi","rotor":5,"thrust":0.25})",
    R"({"do":"fault","kind":"command_delay","of":"changi","exchanges":4})",
    R"({"do":"end_fault","fault":17})"};

TEST(FaultOrder, EachOrderIsReadBackUnchanged) {
  for (const std::string& text : kOrders) {
    const auto order = read_fault_order(text);
    ASSERT_TRUE(order) << text;
    EXPECT_EQ(text_of(*order), text);
    const auto one_of_all = read_order(text);
    ASSERT_TRUE(one_of_all) << text;
    EXPECT_EQ(text_of(*one_of_all), text);
  }
}

TEST(FaultOrder, ALinkIsCutAsAFaultFileCutsIt) {
  const auto order = read_fault_order(kOrders.front());
  const Fault fault{.at_s = 1.0, .until_s = {}, .action = *order->begins};
  EXPECT_EQ(fault_line(fault), "{at_s: 1, link: {from: changi, to: gcs, range_m: 0.001}}");
}

TEST(FaultOrder, OrdersThatLackAKeyOrHaveAnExtraOneAreNotRead) {
  for (const std::string& text : kOrders) {
    const Json whole = parse_json(text);
    for (const auto& [key, value] : whole.items()) {
      Json less = whole;
      less.erase(key);
      EXPECT_EQ(read_fault_order(less.dump()).has_value(), key == "for_s") << less;
      Json other = whole;
      other[key] = value.is_string() ? Json(7) : Json("text");
      EXPECT_FALSE(read_fault_order(other.dump())) << other;
    }
    Json more = whole;
    more["more"] = 1;
    EXPECT_FALSE(read_fault_order(more.dump())) << more;
  }
}

TEST(FaultOrder, NumbersAndNamesHaveBounds) {
  const auto with = [](const std::string& keys) { return read_fault_order(R"({"do":"fault",)" + keys + "}"); };
  const std::string motor = R"("kind":"motor_failure","of":"changi",)", delay = R"("kind":"command_delay","of":"a",)";
  EXPECT_TRUE(with(motor + R"("rotor":0,"thrust":0)"));
  EXPECT_FALSE(with(motor + R"("rotor":6,"thrust":0)"));
  EXPECT_FALSE(with(motor + R"("rotor":-1,"thrust":0)"));
  EXPECT_FALSE(with(motor + R"("rotor":1.5,"thrust":0)"));
  EXPECT_FALSE(with(motor + R"("rotor":1,"thrust":1)"));
  EXPECT_FALSE(with(delay + R"("exchanges":0)"));
  EXPECT_FALSE(with(delay + R"("exchanges":18446744073709551615)"));
  EXPECT_FALSE(with(R"("kind":"blackout","of":"changi","for_s":0)"));
  EXPECT_FALSE(with(R"("kind":"blackout","of":"changi","for_s":1e300)"));
  EXPECT_FALSE(with(R"("kind":"blackout","of":")" + std::string(101, 'a') + "\""));
  EXPECT_FALSE(with(R"("kind":"partition","of":"changi")")) << "a viewer cannot order a partition";
  EXPECT_FALSE(with(R"("kind":"odometry_jump","of":"changi")")) << "a viewer cannot order a jump of the odometry";
  EXPECT_FALSE(read_fault_order(R"({"do":"end_fault","fault":-1})"));
  EXPECT_FALSE(read_fault_order(R"({"do":"end_fault","fault":1e30})"));
}

TEST(FaultOrder, DamagedOrdersDoNoHarm) {
  std::mt19937 random(7);
  for (int round = 0; round < 20000; ++round) {
    std::string text = kOrders[random() % kOrders.size()];
    for (unsigned hits = 1 + random() % 4; hits > 0; --hits) text[random() % text.size()] = static_cast<char>(random());
    const auto order = read_fault_order(text);
    EXPECT_TRUE(!order || read_fault_order(text_of(*order))) << text;
  }
}

}  // namespace
}  // namespace skein::view
