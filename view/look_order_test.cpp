#include "view/look_order.hpp"

#include <gtest/gtest.h>

#include "view/order.hpp"

namespace skein::view {
namespace {

TEST(LookOrders, AreReadAsTheyAreWritten) {
  for (const LookOrder& order : {LookOrder{}, LookOrder{{"jurong"}, ""}, LookOrder{{}, "changi"},
                                 LookOrder{{"jurong", "raffles"}, "jurong"}, LookOrder{{"a \"b\" \\"}, "ü"}}) {
    EXPECT_EQ(read_look_order(text_of(order)), order) << text_of(order);
    const auto any = read_order(text_of(order));
    ASSERT_TRUE(any && std::holds_alternative<LookOrder>(*any)) << text_of(order);
    EXPECT_EQ(text_of(*any), text_of(order));
  }
  EXPECT_EQ(read_look_order(R"({"do":"look","lidar":["a"],"map":"b"})"), (LookOrder{{"a"}, "b"}));
  EXPECT_EQ(read_look_order(R"({"do":"look","lidar":[]})"), LookOrder{});
}

TEST(LookOrders, InvalidOrdersAreRefused) {
  for (const char* text :
       {"", "{}", "[]", R"({"do":"see"})", R"({"do":["look"]})", R"({"lidar":["a"]})", R"({"do":"look","lidar":"a"})",
        R"({"do":"look","lidar":[1]})", R"({"do":"look","lidar":[""]})", R"({"do":"look","map":""})",
        R"({"do":"look","map":["a"]})", R"({"do":"look","map":null})", R"({"do":"look","what":1})",
        R"({"do":"pause","lidar":["a"]})", R"({"do":"look","lidar":[["a"]]})"}) {
    EXPECT_EQ(read_look_order(text), std::nullopt) << text;
    EXPECT_FALSE(read_order(text).has_value()) << text;
  }
  EXPECT_TRUE(read_look_order(text_of(LookOrder{std::vector<std::string>(kMostUavs, std::string(64, 'a')), ""})));
  EXPECT_FALSE(read_look_order(text_of(LookOrder{std::vector<std::string>(kMostUavs + 1, "a"), ""})))
      << "too many names";
  EXPECT_FALSE(read_look_order(text_of(LookOrder{{}, std::string(65, 'a')}))) << "longer than any name";
  EXPECT_FALSE(read_look_order(R"({"do":"look")" + std::string(kLongestLook, ' ') + "}")) << "longer than any order";
}

// The budget is 300 kB a second. At 8 times real time, each viewer gets about 12 kB of it for each UAV, in addition to
// clouds (tests/view/figures.mjs).
TEST(LookBudget, LeavesRoomForTheFleet) {
  for (std::size_t uavs = 1; uavs <= 20; ++uavs) {
    const LookBudget budget = look_budget(uavs);
    const std::size_t points_per_s = budget.points * (std::chrono::seconds(1) / LookBudget::kPointsPeriod);
    EXPECT_LE(8 * points_per_s + budget.map_bytes_per_s + 12'000 * uavs, 300'000U) << uavs;
    EXPECT_GE(budget.points, 500U);
  }
  EXPECT_GT(look_budget(100).points, 100U);
}

TEST(LookOrders, NameTheCloudsForWhichTheyAsk) {
  EXPECT_EQ(clouds_of({{"a", "b"}, "c"}), (std::vector<std::string>{"lidar a", "lidar b", "map c"}));
  EXPECT_TRUE(clouds_of({}).empty());
}

}  // namespace
}  // namespace skein::view
