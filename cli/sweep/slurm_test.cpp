// The options that the engine passes to Slurm, and its reaction when Slurm rejects a job.
#include "cli/sweep/slurm.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "cli/command_line.hpp"
#include "cli/study_options.hpp"
#include "cli/sweep/engines.hpp"
#include "cli/sweep_options.hpp"
#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string refusal(const Words& words) try {
  parse_command_line(words);
  return "";
} catch (const InputError& error) {
  return error.what();
}

TEST(SbatchOptions, ArePassedOnUnchanged) {
  EXPECT_EQ(sbatch_options(""), Words{});
  EXPECT_EQ(sbatch_options("partition=debug,time=1-10:00,account=mine"),
            (Words{"--partition=debug", "--time=1-10:00", "--account=mine"}));
  EXPECT_EQ(sbatch_options("exclude=a,b,mem-per-cpu=2G"), (Words{"--exclude=a,b", "--mem-per-cpu=2G"}));
  EXPECT_EQ(sbatch_options("comment=a=b"), Words{"--comment=a=b"});
}

TEST(SbatchOptions, MalformedOptionsAndThoseThatSkeinSetsAreRefused) {
  for (const char* text : {"array=0-3", "time=10,job-name=x", "dependency=afterok:1", "wrap=true", "exclusive",
                           "--time=10", "=3", "time=1, account=x", "$(reboot)=1"}) {
    EXPECT_THROW(sbatch_options(text), InputError) << text;
  }
}

TEST(SweepOptions, AreRefusedWithoutTheirExecutor) {
  EXPECT_NE(refusal({"compare", "--sshlogin", "a"}).find("--executor parallel"), std::string::npos);
  EXPECT_NE(refusal({"contest", "--slurm", "time=1"}).find("--executor slurm"), std::string::npos);
  EXPECT_NE(refusal({"contest", "--executor", "local", "--detach"}).find("--executor slurm"), std::string::npos);
  EXPECT_NE(refusal({"hunt", "--executor", "slurm", "--detach"}).find("not expected: --detach"), std::string::npos);
  EXPECT_NE(refusal({"compare", "--executor", "condor"}).find("slurm"), std::string::npos);
  for (const char* unit : {"x", "1.5", "-1", ""}) {
    EXPECT_NE(refusal({"--unit", "folder", unit}).find("--unit STUDY N"), std::string::npos) << unit;
  }
  const Command command = parse_command_line(
      {"compare", "--executor", "parallel", "--sshlogin", "4/a,b", "--sshlogin", ":", "--unit-minutes", "2"});
  const SweepOptions sweep = command.get<StudyOptions>().sweep;
  EXPECT_EQ(sweep.logins, (Words{"4/a", "b", ":"}));
  EXPECT_EQ(sweep.unit_minutes, 2.0);
  EXPECT_EQ(sweep.command.front(), "compare");
}

/// A sweep whose units are single flights. Shell scripts replace Slurm's commands.
class StandInSlurm : public testing::Test {
 protected:
  StandInSlurm() {
    ::setenv("PATH", (bin().string() + ":" + path_).c_str(), 1);
    fs::create_directories(bin());
    write_script(bin() / "scontrol", "echo MaxArraySize = 2");
    write_script(bin() / "squeue", "");
    write_script(bin() / "scancel", "");
    SweepSettings settings;
    settings.token = "token";
    settings.sizes = {.flights = 8};
    settings.reference = flight(0);
    settings.command = {"compare"};
    settings.working_folder = scratch_.path();
    folder_.begin(settings, false, [this](std::size_t number) { return SweepUnit{{flight(number)}}; });
  }
  ~StandInSlurm() override { ::setenv("PATH", path_.c_str(), 1); }

  SweepFlight flight(std::size_t number) const {
    return {number, scratch_.path() / std::to_string(number), RunOptions{}, Json::object()};
  }
  fs::path bin() const { return scratch_.path() / "bin"; }
  fs::path file(const std::string& name) const { return scratch_.path() / name; }
  bool fly(const EngineWork& work, bool detach) {
    SweepOptions options;
    options.detach = detach;
    const auto engine = make_slurm_engine(options, {}, folder_, {said_, said_});
    return engine->fly(work, {[] {}, [] { return EngineWork{}; }});
  }

  const std::string path_ = std::getenv("PATH");
  const ScratchFolder scratch_;
  const SweepFolder folder_{scratch_.path()};
  std::ostringstream said_;
};

// Slurm limits how many jobs a user may have, so it may accept the first arrays of a sweep and reject the next one.
TEST_F(StandInSlurm, ASweepContinuesAfterTheArraysThatSlurmAccepted) {
  for (std::size_t taken = 0; taken < 4; ++taken) {
    fs::remove(file("calls"));
    write_script(bin() / "sbatch", "echo \"$*\" >>" + file("calls").string() +
                                       "\ncase \"$*\" in *merge*) echo 9; exit ;; esac\n"
                                       "n=$(wc -l <" +
                                       file("calls").string() + ")\nif [ $n -gt " + std::to_string(taken) +
                                       " ]; then echo too many jobs >&2; exit 1; fi\necho $n\n");
    try {
      fly({{0, 1, 2, 3, 4, 5, 6, 7}, {}}, true);
      ADD_FAILURE() << "one array was rejected";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("too many jobs"), std::string::npos) << error.what();
    }
    const std::string calls = read_text(file("calls"));
    std::string after;
    for (std::size_t id = 1; id <= taken; ++id) after += ":" + std::to_string(id);
    const bool merges = calls.find("merge --dependency=afterany" + after + " ") != std::string::npos;
    EXPECT_EQ(merges, taken > 0) << calls;
  }
}

// The engine queries Slurm twice: the second query asks why units wait. Either may fail when Slurm is busy.
TEST_F(StandInSlurm, AFailedQueryIsRepeated) {
  write_script(bin() / "sbatch", "echo 1");
  for (int failing = 2; failing <= 3; ++failing) {
    fs::remove(file("queries"));
    write_script(bin() / "squeue", "echo >>" + file("queries").string() + "\nn=$(wc -l <" + file("queries").string() +
                                       ")\n[ $n -ne " + std::to_string(failing) +
                                       " ] || exit 1\n"
                                       "if [ $n -gt 1 ] && [ $n -lt 4 ]; then\n"
                                       "  list=$(ls " +
                                       (folder_.dir() / "lists").string() +
                                       " | grep -v sh | sort -n | tail -1)\n"
                                       "  echo \"1|skein-token-$list|0|PENDING||ReqNodeNotAvail\"\nfi\n");
    EXPECT_NO_THROW(EXPECT_TRUE(fly({{0}, {"node1"}}, false))) << failing;
  }
}

}  // namespace
}  // namespace skein::cli
