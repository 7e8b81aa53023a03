// What is passed on to Slurm.
#include "cli/sweep/slurm.hpp"

#include <gtest/gtest.h>

#include "cli/options.hpp"
#include "cli/sweep/engines.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

using Words = std::vector<std::string>;

std::string refusal(const Words& words) try {
  parse_command_line(words);
  return "";
} catch (const InputError& error) {
  return error.what();
}

TEST(SbatchOptions, ArePassedOnWithTheirValuesAsTheyAre) {
  EXPECT_EQ(sbatch_options(""), Words{});
  EXPECT_EQ(sbatch_options("partition=debug,time=1-10:00,account=mine"),
            (Words{"--partition=debug", "--time=1-10:00", "--account=mine"}));
  EXPECT_EQ(sbatch_options("exclude=a,b,mem-per-cpu=2G"), (Words{"--exclude=a,b", "--mem-per-cpu=2G"}));
  EXPECT_EQ(sbatch_options("comment=a=b"), Words{"--comment=a=b"});
}

TEST(SbatchOptions, WhatSkeinSetsItselfAndWhatIsNoneIsRefused) {
  for (const char* text : {"array=0-3", "time=10,job-name=x", "dependency=afterok:1", "wrap=true", "exclusive",
                           "--time=10", "=3", "time=1, account=x", "$(reboot)=1"}) {
    EXPECT_THROW(sbatch_options(text), InputError) << text;
  }
}

TEST(SweepOptions, NeedTheirExecutor) {
  EXPECT_NE(refusal({"compare", "--sshlogin", "a"}).find("--executor parallel"), std::string::npos);
  EXPECT_NE(refusal({"contest", "--slurm", "time=1"}).find("--executor slurm"), std::string::npos);
  EXPECT_NE(refusal({"contest", "--executor", "local", "--detach"}).find("--executor slurm"), std::string::npos);
  EXPECT_NE(refusal({"hunt", "--executor", "slurm", "--detach"}).find("of studies"), std::string::npos);
  EXPECT_NE(refusal({"compare", "--executor", "condor"}).find("slurm"), std::string::npos);
  EXPECT_NE(refusal({"--unit", "folder", "x"}).find("--unit STUDY N"), std::string::npos);
  const Command command = parse_command_line(
      {"compare", "--executor", "parallel", "--sshlogin", "4/a,b", "--sshlogin", ":", "--unit-minutes", "2"});
  const SweepOptions& sweep = std::get<StudyOptions>(command).sweep;
  EXPECT_EQ(sweep.logins, (Words{"4/a", "b", ":"}));
  EXPECT_EQ(sweep.unit_minutes, 2.0);
  EXPECT_EQ(sweep.command.front(), "compare");
}

}  // namespace
}  // namespace skein::cli
