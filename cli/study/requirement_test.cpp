// Requirements of a study: their syntax, and the flights that meet them.
#include "cli/study/requirement.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"

namespace skein::cli {
namespace {

FlightFigures figures(double percent, int collisions) {
  FlightFigures flight;
  flight.attainable_percent = percent;
  flight.collisions = collisions;
  return flight;
}

TEST(Requirement, ComparesAFigure) {
  EXPECT_TRUE(parse_requirement("collisions==0").holds(figures(5.0, 0)));
  EXPECT_FALSE(parse_requirement("collisions==0").holds(figures(5.0, 2)));
  EXPECT_TRUE(parse_requirement(" attainable_percent >= 5 ").holds(figures(5.0, 0)));
  EXPECT_FALSE(parse_requirement("attainable_percent > 5").holds(figures(5.0, 0)));
  EXPECT_TRUE(parse_requirement("attainable_percent<=5").holds(figures(5.0, 0)));
  EXPECT_FALSE(parse_requirement("attainable_percent<5").holds(figures(5.0, 0)));
  EXPECT_TRUE(parse_requirement("collisions != 1").holds(figures(5.0, 0)));
}

TEST(Requirement, MayJoinSeveralFigures) {
  const Requirement requirement = parse_requirement("collisions == 0 and 2 * attainable_percent > 9 or frozen_s < 1");
  EXPECT_TRUE(requirement.holds(figures(5.0, 0)));
  EXPECT_FALSE(requirement.holds(figures(4.0, 0)));
  EXPECT_FALSE(requirement.holds(figures(5.0, 1)));
  EXPECT_EQ(requirement.seen(figures(5.0, 1)), "collisions 1 and attainable_percent 5 and frozen_s no figure");
  EXPECT_EQ(parse_requirement("collisions==0").seen(figures(5.0, 2)), "2");
}

TEST(Requirement, IsNotMetByAFlightWithoutTheFigure) {
  EXPECT_FALSE(parse_requirement("collisions==0").holds(std::nullopt));
  EXPECT_FALSE(parse_requirement("frozen_uavs==0").holds(figures(5.0, 0)));
}

TEST(Requirement, AMalformedRequirementIsRefused) {
  for (const char* text : {"", "collisions", "collision==0", "==0", "collisions==", "collisions==none", "collisions=0",
                           "gain(collisions)==0", "collisions==0 and", "frozen_s<80 s", "separation > 1 m"}) {
    EXPECT_THROW(parse_requirement(text), InputError) << text;
  }
  try {
    parse_requirement("collision==0");
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--require collision==0: there is no figure 'collision'; did you mean 'collisions'?");
  }
}

}  // namespace
}  // namespace skein::cli
