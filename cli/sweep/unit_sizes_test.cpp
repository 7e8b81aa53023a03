#include "cli/sweep/unit_sizes.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"

namespace skein::cli {
namespace {

TEST(UnitSizes, FillTheRequestedTimeButLeaveSeveralUnitsForEachSlot) {
  EXPECT_EQ(unit_sizes(100'000, 15.0, 300.0, 64).size, 20U);
  EXPECT_EQ(unit_sizes(105, 15.0, 300.0, 2).size, 6U) << "there are eight units for each slot";
  EXPECT_EQ(unit_sizes(4, 15.0, 300.0, 2).size, 1U);
  EXPECT_EQ(unit_sizes(100'000, 1000.0, 300.0, 2).size, 1U);
  EXPECT_EQ(unit_sizes(1'000'000, 0.0, 300.0, 1).size, 125'000U);
}

TEST(UnitSizes, TheLastUnitsAreSmaller) {
  const UnitSizes sizes = unit_sizes(110, 9.0, 60.0, 2);
  EXPECT_EQ(sizes.size, 6U);
  EXPECT_EQ(sizes.tail, 14U) << "the tail replaces the last unit of each of two slots, and the remainder";
  EXPECT_EQ(sizes.tail_size, 2U);
  EXPECT_EQ(sizes.units(), 16U + 7U);
  EXPECT_EQ(unit_sizes(10, 9.0, 60.0, 2).tail, 0U) << "units of one flight need no smaller ones";
}

TEST(UnitSizes, EachFlightIsInOneUnit) {
  RandomStream draw(1, "unit sizes", 0);
  const auto up_to = [&draw](double most) { return static_cast<std::size_t>(most * draw.uniform()); };
  for (int drawn = 0; drawn < 2000; ++drawn) {
    const UnitSizes sizes = unit_sizes(1 + up_to(500.0), 20.0 * draw.uniform(), 600.0 * draw.uniform(), up_to(9.0));
    SCOPED_TRACE(std::to_string(sizes.flights) + " flights, " + std::to_string(sizes.size) + " a unit, tail of " +
                 std::to_string(sizes.tail));
    ASSERT_EQ(sizes.first(0), 0U);
    ASSERT_EQ(sizes.first(sizes.units()), sizes.flights);
    for (std::size_t unit = 0; unit < sizes.units(); ++unit) {
      const std::size_t first = sizes.first(unit), end = sizes.first(unit + 1);
      ASSERT_LT(first, end) << "unit " << unit << " is empty";
      ASSERT_LE(end - first, sizes.size);
      for (std::size_t flight = first; flight < end; ++flight) ASSERT_EQ(sizes.unit_of(flight), unit) << flight;
    }
  }
}

}  // namespace
}  // namespace skein::cli
