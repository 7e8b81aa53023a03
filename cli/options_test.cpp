#include "cli/options.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"

namespace skein::cli {
namespace {

template <class Options>
Options parse(const std::vector<std::string>& arguments) {
  return std::get<Options>(parse_command_line(arguments));
}

TEST(Options, RunHasDefaults) {
  const auto run = parse<RunOptions>({"run"});
  EXPECT_EQ(run.scenario, "towers");
  EXPECT_EQ(run.planner, "patrol");
  EXPECT_EQ(run.seed, 0u);
  EXPECT_EQ(run.dds, "cyclonedds");
  EXPECT_EQ(run.clock, "lockstep");
  EXPECT_FALSE(run.scene_seed || run.assets || run.duration_s || run.domain || run.stop_at_s || run.out ||
               run.debug_uav);
  EXPECT_FALSE(run.force || run.native);
}

TEST(Options, RunReadsAll) {
  const auto run = parse<RunOptions>({"run",      "mbs",       "--planner",    "jurong=hover,raffles=patrol",
                                      "--seed",   "7",         "--scene-seed", "3",
                                      "--assets", "data",      "--duration",   "90.5",
                                      "--dds",    "mixed",     "--clock",      "realtime:2.5",
                                      "--debug",  "jurong",    "--native",     "--domain",
                                      "20",       "--stop-at", "12",           "--out",
                                      "o",        "--force"});
  EXPECT_EQ(run.scenario, "mbs");
  EXPECT_EQ(run.planner, "jurong=hover,raffles=patrol");
  EXPECT_EQ(run.seed, 7u);
  EXPECT_EQ(run.scene_seed, 3u);
  EXPECT_EQ(run.assets, "data");
  EXPECT_EQ(run.duration_s, 90.5);
  EXPECT_EQ(run.dds, "mixed");
  EXPECT_EQ(run.clock, "realtime:2.5");
  EXPECT_EQ(run.debug_uav, "jurong");
  EXPECT_EQ(run.domain, 20);
  EXPECT_EQ(run.stop_at_s, 12.0);
  EXPECT_EQ(run.out, "o");
  EXPECT_TRUE(run.force && run.native);
}

TEST(Options, OtherCommands) {
  EXPECT_TRUE(parse<TestOptions>({"test", "--long"}).long_tests);
  EXPECT_EQ(parse<CheckOptions>({"check", "a.yaml", "b.yaml"}).files, (std::vector<std::string>{"a.yaml", "b.yaml"}));
  EXPECT_EQ(parse<CheckOptions>({"check", "--golden", "a.csv", "b.csv"}).golden,
            (std::vector<std::string>{"a.csv", "b.csv"}));
  EXPECT_EQ(parse<DiffOptions>({"diff", "x", "y"}).run_b, "y");
  EXPECT_NE(parse<HelpText>({"--help"}).text.find("diff"), std::string::npos);
  EXPECT_NE(parse<HelpText>({"run", "--help"}).text.find("--stop-at"), std::string::npos);
  EXPECT_EQ(parse<HelpText>({"--version"}).text.find("skein "), 0u);
}

TEST(Options, WhatDoesNotFitIsRefused) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"fly"},
      {"run", "a", "b"},
      {"run", "--seed", "-1"},
      {"run", "--seed", "x"},
      {"run", "--dds", "opendds"},
      {"run", "--duration", "0"},
      {"run", "--duration", "nan"},
      {"run", "--stop-at", "inf"},
      {"run", "--scene-seed", "1.5"},
      {"run", "--clock", "realtime:inf"},
      {"run", "--clock", "realtime:0"},
      {"run", "--clock", "realtime:fast"},
      {"run", "--clock", "fast"},
      {"run", "--no-such-option"},
      {"check"},
      {"diff", "x"},
  };
  for (const auto& arguments : wrong) {
    EXPECT_THROW(parse_command_line(arguments), InputError) << (arguments.empty() ? "" : arguments.back());
  }
}

}  // namespace
}  // namespace skein::cli
