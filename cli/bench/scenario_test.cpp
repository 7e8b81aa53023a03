#include "cli/bench/scenario.hpp"

#include <gtest/gtest.h>

#include "core/scenario/scenario_reader.hpp"
#include "host/testing/fake_programs.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

Scenario written_and_read(const BenchFleet& fleet) {
  const ScratchDir scratch;
  write_text(scratch.path() / "bench.yaml", bench_scenario(fleet));
  return load_scenario(scratch.path() / "bench.yaml", {.config_dir = source_path("config")});
}

TEST(BenchScenario, EverySizeIsAValidScenario) {
  for (const std::size_t uavs : {1, 2, 5, 10, 20, 50, 100, 128}) {
    const Scenario scenario = written_and_read({.uavs = uavs});
    ASSERT_EQ(scenario.fleet.size(), uavs);
    for (std::size_t i = 0; i < uavs; ++i) {
      EXPECT_EQ(scenario.fleet[i].vehicle.role, i % 5 < 2 ? Role::explorer : Role::photographer);
      EXPECT_LT(scenario.fleet[i].start.x(), -5.0);  // the towers and the station have greater x
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE((scenario.fleet[i].start - scenario.fleet[j].start).norm(), 5.0);
      }
    }
  }
}

TEST(BenchScenario, TimesAreThoseAskedFor) {
  const Scenario scenario = written_and_read({.uavs = 3, .duration_s = 12.5, .exchange_period_s = 0.0025});
  EXPECT_EQ(scenario.duration_s, 12.5);
  EXPECT_EQ(scenario.exchange_ticks(), 1);
}

}  // namespace
}  // namespace skein::cli
