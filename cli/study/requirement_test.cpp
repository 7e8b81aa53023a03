// Requirements of a study: what they say, and which flights keep them.
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

TEST(Requirement, IsNotKeptByAFlightWithoutTheFigure) {
  EXPECT_FALSE(parse_requirement("collisions==0").holds(std::nullopt));
  EXPECT_FALSE(parse_requirement("frozen_uavs==0").holds(figures(5.0, 0)));
}

TEST(Requirement, WhatMakesNoSenseIsRefused) {
  for (const char* text :
       {"", "collisions", "collision==0", "==0", "collisions==", "collisions==none", "collisions=0"}) {
    EXPECT_THROW(parse_requirement(text), InputError) << text;
  }
}

}  // namespace
}  // namespace skein::cli
