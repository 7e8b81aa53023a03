#include "idl/activity_conversions.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "idl/cdr.hpp"

namespace skein {
namespace {

Activity travelled(const Activity& activity) {
  msg::Activity received;
  EXPECT_TRUE(decode(encode(to_activity(41, activity)), received));
  return from_activity(received);
}

TEST(ActivityConversions, KeepTheirValues) {
  const Activity flies{.mode = "flies to a goal",
                       .goal_W = Vector3d(1.0, -2.5, 3.25),
                       .waits_for = "changi",
                       .no_way = "not proved to be free",
                       .speed_mps = 4.5,
                       .undelivered = 7,
                       .cpu_s = 1.25};
  EXPECT_EQ(travelled(flies), flies);
  const Activity stands{.mode = "on the ground"};
  EXPECT_EQ(travelled(stands), stands);
}

TEST(ActivityConversions, AnActivityOfAnyProgramFitsIntoATable) {
  Activity odd{.mode = "a,b\nc\x7F\"", .waits_for = std::string(500, 'x'), .no_way = std::string(159, 'y') + "éé"};
  odd.goal_W = Vector3d(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  odd.speed_mps = odd.cpu_s = std::numeric_limits<double>::infinity();
  const Activity read = travelled(odd);
  EXPECT_EQ(read.mode, "a;b c \"");
  EXPECT_EQ(read.waits_for, std::string(160, 'x'));
  EXPECT_EQ(read.no_way, std::string(159, 'y')) << "a character must not be cut in two";
  EXPECT_FALSE(read.goal_W);
  EXPECT_EQ(read.speed_mps, 0.0);
  EXPECT_EQ(read.cpu_s, 0.0);
}

TEST(ActivityConversions, AnActivityOfAnyProgramBecomesUtf8) {
  const Activity odd{.mode = "caf\xe9", .waits_for = "caf\xc3\xa9", .no_way = std::string(400, '\xc3')};
  const Activity read = travelled(odd);
  EXPECT_EQ(read.mode, "caf?");
  EXPECT_EQ(read.waits_for, "caf\xc3\xa9");
  EXPECT_EQ(read.no_way, std::string(160, '?'));
}

}  // namespace
}  // namespace skein
