#include "view/time_order.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"

namespace skein::view {
namespace {

using OrderKind = TimeOrder::Kind;

TEST(TimeOrders, AreReadBackUnchanged) {
  for (const TimeOrder& order : {TimeOrder{OrderKind::pause}, TimeOrder{OrderKind::resume}, TimeOrder{OrderKind::step},
                                 TimeOrder{OrderKind::speed, 0.1}, TimeOrder{OrderKind::speed, 1000.0},
                                 TimeOrder{OrderKind::speed, std::nullopt}}) {
    EXPECT_EQ(read_time_order(text_of(order)), order) << text_of(order);
  }
}

TEST(TimeOrders, AnyOtherTextIsRefused) {
  for (const std::string text :
       {"", "pause", "{}", "[]", "null", "{\"do\":1}", "{\"do\":\"kill\"}", "{\"do\":\"pause\",\"speed\":1}",
        "{\"do\":\"speed\"}", "{\"do\":\"speed\",\"speed\":0.05}", "{\"do\":\"speed\",\"speed\":1001}",
        "{\"do\":\"speed\",\"speed\":\"fast\"}", "{\"do\":\"speed\",\"speed\":null}", "{\"do\":\"speed\",\"fast\":1}",
        "{\"do\":\"pause\"", "{\"do\":\"pause\"}{\"do\":\"pause\"}"}) {
    EXPECT_EQ(read_time_order(text), std::nullopt) << text;
  }
  EXPECT_EQ(read_time_order("{\"do\":\"pause\"" + std::string(1000, ' ') + "}"), std::nullopt) << "too long";
}

TEST(Speeds, AreNumbersWithinBoundsOrMax) {
  EXPECT_EQ(read_speed("8"), 8.0);
  EXPECT_EQ(read_speed("0.1"), 0.1);
  EXPECT_EQ(read_speed("max"), std::nullopt);
  for (const char* text : {"", "0", "-1", "nan", "inf", "1001", "8x", "fast"}) {
    EXPECT_THROW(read_speed(text), InputError) << text;
  }
  for (const char* text : {"8", "0.1", "max"}) EXPECT_EQ(speed_text(read_speed(text)), text);
}

}  // namespace
}  // namespace skein::view
