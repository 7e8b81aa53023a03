#include "sim_server/cpu_rate.hpp"

#include <gtest/gtest.h>

namespace skein::sim {
namespace {

TEST(CpuRate, TheRateIsMeasuredOverAtLeastASecond) {
  CpuRate rate;
  rate.add(400, 10.0);
  EXPECT_FALSE(rate.per_s());
  rate.add(600, 10.9);
  EXPECT_FALSE(rate.per_s()) << "half a second is too short";
  rate.add(800, 11.0);
  EXPECT_DOUBLE_EQ(*rate.per_s(), 1.0);
  rate.add(1600, 11.5);
  EXPECT_DOUBLE_EQ(*rate.per_s(), 0.25);
}

TEST(CpuRate, TheMeasurementBeginsAnewWhenTheProgramRestarts) {
  CpuRate rate;
  rate.add(0, 5.0);
  rate.add(400, 6.0);
  rate.add(800, 0.5);
  EXPECT_FALSE(rate.per_s()) << "the program has just been started again";
  rate.add(1200, 0.75);
  EXPECT_DOUBLE_EQ(*rate.per_s(), 0.25);
}

}  // namespace
}  // namespace skein::sim
