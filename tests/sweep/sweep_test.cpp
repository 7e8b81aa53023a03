// Studies with `--executor`, with short flights of real fleets: with each engine, and even if programs are killed
// meanwhile, digests, scores and tables are those of the command without an engine.
#include "sweep_fixture.hpp"
#include "tests/fleet/small_disk.hpp"

namespace skein::test {
namespace {

class Sweep : public SweepTest {
 protected:
  /// Sets up the stand-in for Slurm. @returns the variables that it needs, with PATH.
  Environment slurm(const std::string& nodes, const std::string& limits = "1001") {
    fs::create_directories(folder() / "slurm");
    write("slurm/nodes", nodes);
    write("slurm/limits", limits);
    for (const char* name : {"sbatch", "squeue", "scancel", "scontrol"}) {
      const fs::path link = folder() / "slurm" / name;
      if (!fs::exists(link)) fs::create_symlink(source_path("tests/sweep/stand_in_slurm.py"), link);
    }
    return {{"STAND_IN_SLURM", folder() / "slurm"},
            {"PATH", (folder() / "slurm").string() + ":" + std::getenv("PATH")}};
  }
  /// All jobs of the stand-in.
  Json slurm_jobs() const { return Json::parse(text_of(folder() / "slurm" / "jobs.json"), nullptr, false); }
  bool slurm_is_idle() const {
    const Json jobs = slurm_jobs();
    if (!jobs.is_object() || jobs.empty()) return false;
    return std::ranges::all_of(jobs, [](const Json& job) {
      return std::ranges::all_of(job["tasks"],
                                 [](const Json& state) { return state == "DONE" || state == "CANCELLED"; });
    });
  }
};

TEST_F(Sweep, LocalUnitsGiveTheResultsOfThePlainStudy) {
  ChildProcess& local = fly("local", {"--executor", "local", "--jobs", "2"});
  ASSERT_EQ(local.wait().code, 0) << local.err();
  expect_as_plain("local");
  ChildProcess& again = fly("local", {"--executor", "local"});
  ASSERT_EQ(again.wait().code, 0) << again.err();
  EXPECT_EQ(again.err().find("units are over"), std::string::npos)
      << "a complete study flew units again: " << again.err();
  expect_as_plain("local");
}

TEST_F(Sweep, GnuParallelGivesTheResultsOfThePlainStudy) {
  if (!is_installed("parallel")) GTEST_SKIP() << "there is no GNU parallel: apt-get install parallel";
  ChildProcess& parallel = fly("parallel", {"--executor", "parallel", "--jobs", "2"});
  ASSERT_EQ(parallel.wait().code, 0) << parallel.err();
  expect_as_plain("parallel");
}

TEST_F(Sweep, AControllerThatIsKilledDoesNotChangeTheResults) {
  ChildProcess& first = fly("killed", {"--executor", "local", "--jobs", "2"});
  ASSERT_TRUE(eventually([&] { return flown("killed") >= 2; })) << first.err();
  first.signal(SIGKILL);
  first.wait();
  const std::size_t before = flown("killed");
  EXPECT_LT(before, flights()) << "the study ended before its controller was killed";
  ChildProcess& second = fly("killed", {"--executor", "local", "--jobs", "2"});
  ASSERT_EQ(second.wait().code, 0) << second.err();
  expect_as_plain("killed");
}

TEST_F(Sweep, UnitsThatAreFlownTwiceCountOnce) {
  ChildProcess& study = fly("twice", {"--executor", "local", "--jobs", "1"});
  ASSERT_TRUE(eventually([&] { return fs::exists(folder() / "twice/sweep/sweep.json") || study.ended(); }));
  for (std::size_t unit = flights(); unit-- > 0;) {
    ChildProcess& again =
        start_program("again", {program("skein"), "--unit", folder() / "twice", std::to_string(unit)});
    EXPECT_EQ(again.wait().code, 0) << again.err();
  }
  EXPECT_EQ(study.wait().code, 0) << study.err();
  expect_as_plain("twice");
}

TEST_F(Sweep, AFullDiskDoesNotChangeTheResults) {
  const SmallDisk disk(folder() / "full", 1200);
  if (!disk.mounted()) GTEST_SKIP() << "a disk can be mounted by root only";
  const Arguments how = {"--executor", "local", "--jobs", "2"};
  ChildProcess& first = fly("full", how);
  EXPECT_NE(first.wait().code, 0);
  EXPECT_LT(flown("full"), flights()) << "the disk had room for all flights, so this tests nothing";
  ASSERT_TRUE(disk.grow(100'000));
  ChildProcess& second = fly("full", how);
  EXPECT_EQ(second.wait().code, 0) << second.err() << logs("full");
  expect_as_plain("full");
}

TEST_F(Sweep, SlurmGetsItsOptionsAndGivesTheResultsOfThePlainStudy) {
  const Environment with = slurm("n1\nn2\n", "5");
  ChildProcess& study =
      fly("by_slurm", {"--executor", "slurm", "--jobs", "2", "--slurm", "partition=debug,account=mine,yours"}, with);
  ASSERT_EQ(study.wait().code, 0) << study.err();
  expect_as_plain("by_slurm");
  ASSERT_TRUE(eventually([&] { return slurm_is_idle(); }));
  const std::string calls = text_of(folder() / "slurm" / "calls");
  EXPECT_NE(calls.find("--array=0-4%2"), std::string::npos) << "the array must have MaxArraySize tasks: " << calls;
  EXPECT_NE(calls.find("--account=mine,yours"), std::string::npos) << calls;
  EXPECT_NE(calls.find("-merge --dependency=afterany:"), std::string::npos) << calls;
  EXPECT_NE(study.err().find("2 nodes; 1 flight flown again elsewhere, each with the same digest"), std::string::npos)
      << study.err();
}

TEST_F(Sweep, AJobMergesADetachedStudyAlthoughTasksAreKilled) {
  const Environment with = slurm("n1\nn2\n");
  ChildProcess& study = fly("detached", {"--executor", "slurm", "--detach"}, with);
  ASSERT_EQ(study.wait().code, 0) << study.err();
  EXPECT_FALSE(fs::exists(folder() / "detached" / "report.html"));
  // A node dies twice. Each time, Slurm gives its unit to another node.
  for (std::size_t after = 1; after <= 3; after += 2) {
    ASSERT_TRUE(eventually([&] { return flown("detached") >= after; }));
    for (const Json& pid : slurm_jobs()["1"]["pids"]) ::kill(-pid.get<pid_t>(), SIGKILL);
  }
  ChildProcess& status =
      start_program("status", {program("skein"), "contest", "--status", folder() / "detached"}, with);
  ASSERT_NE(status.wait().code, 2) << status.err();
  EXPECT_NE(status.out().find(" of 12 flights are complete; "), std::string::npos) << status.out();
  ASSERT_TRUE(eventually([&] { return slurm_is_idle(); })) << slurm_jobs();
  expect_as_plain("detached");
}

TEST_F(Sweep, ATimeLimitKeepsCompleteFlights) {
  const Environment with = slurm("n1\nn2\n");
  tests_ = 8;  // units of two flights
  ChildProcess& study =
      fly("cut", {"--executor", "slurm", "--unit-minutes", "100", "--jobs", "1", "--slurm", "time=10:00"}, with);
  ASSERT_TRUE(eventually([&] { return flown("cut") >= 1; })) << study.err();
  write("slurm/time is over", "");
  ASSERT_EQ(study.wait().code, 0) << study.err() << logs("cut");
  EXPECT_NE(logs("cut").find("ended by a signal; the study keeps the flights completed so far"), std::string::npos)
      << logs("cut");
  expect_as_plain("cut");
  EXPECT_TRUE(fs::is_empty(folder() / "cut/sweep/air"));
}

TEST_F(Sweep, AUnitWithAnotherBuildIsRefused) {
  // In this build, `station` is another file with the same behaviour.
  const fs::path bin = folder() / "bin";
  fs::create_directories(bin);
  for (const auto& entry : fs::directory_iterator(fs::path(program("skein")).parent_path())) {
    if (entry.path().filename() != "station") fs::create_symlink(entry.path(), bin / entry.path().filename());
  }
  fs::copy_file(program("station"), bin / "station");
  std::ofstream(bin / "station", std::ios::app) << "x";
  ChildProcess& planned = fly("builds", {"--executor", "local", "--jobs", "2"});
  ASSERT_EQ(planned.wait().code, 0) << planned.err();
  const std::string sweep = text_of(folder() / "builds/sweep/sweep.json");
  ++tests_;
  ChildProcess& more = fly("builds", {"--executor", "local", "--jobs", "2"}, {{"SKEIN_BIN_DIR", bin}});
  --tests_;
  EXPECT_EQ(more.wait().code, 2);
  for (const char* part : {"the programs were built anew", "Nothing was changed."}) {
    EXPECT_NE(more.err().find(part), std::string::npos) << more.err();
  }
  EXPECT_EQ(text_of(folder() / "builds/sweep/sweep.json"), sweep);
  EXPECT_EQ(flown("builds"), flights()) << "flights of the earlier build are lost";
  fs::remove_all(folder() / "builds/flights");
  ChildProcess& unit =
      start_program("unit", {program("skein"), "--unit", folder() / "builds", "0"}, {{"SKEIN_BIN_DIR", bin}});
  EXPECT_EQ(unit.wait().code, 3);
  EXPECT_NE(unit.err().find("the programs here are not of the build that flies the study"), std::string::npos)
      << unit.err();
  EXPECT_EQ(flown("builds"), 0U);
}

TEST_F(Sweep, AHuntFliesTheSameCases) {
  const auto hunt = [&](const std::string& out, const Arguments& how) -> ChildProcess& {
    return start_program(out, joined({program("skein"), "hunt", scene_, "--planner", "patrol", "--runs", "20",
                                      "--duration", "90", "--shrink", "0", "--out", folder() / out},
                                     how));
  };
  ChildProcess& plain = hunt("plain hunt", {"--jobs", "2"});
  const int code = plain.wait().code;
  ASSERT_LE(code, 1) << plain.err();
  ChildProcess& swept = hunt("swept hunt", {"--executor", "local", "--jobs", "2"});
  EXPECT_EQ(swept.wait().code, code) << swept.err();
  const auto lines = [&](const std::string& out) {
    std::vector<std::string> sorted;
    std::ifstream in(folder() / out / "log.jsonl");
    for (std::string line; std::getline(in, line);) sorted.push_back(line);
    std::ranges::sort(sorted);
    return sorted;
  };
  EXPECT_EQ(lines("plain hunt").size(), 20U);
  EXPECT_EQ(lines("plain hunt"), lines("swept hunt"));
  const fs::directory_iterator cases(folder() / "swept hunt/sweep/cases");
  EXPECT_LE(std::distance(cases, {}), 4) << "only the fault files of the last round, which has four cases, may remain";
}

/// Flies with the archive alone, in a root folder that contains nothing else.
TEST_F(Sweep, APackFliesWhereNothingIsInstalled) {
  if (::getuid() != 0 || !is_installed("unshare")) GTEST_SKIP() << "only root may fly in another root folder";
  ChildProcess& pack = start_program("pack", {program("skein"), "pack", folder() / "skein.tar.gz"});
  ASSERT_EQ(pack.wait().code, 0) << pack.err();
  const std::string root = folder() / "root";
  const std::string script = R"sh(
set -e
root=$1
mkdir -p "$root/proc" "$root/dev" "$root/tmp" "$root/opt"
tar -xzf "$2" -C "$root/opt"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
cp "$3" "$root/scenario.yaml"
cp -r "$(dirname "$3")/scene" "$root/scene"  # its files
loader=$(cd "$root/opt/skein/lib" && ls ld-linux*)
lib=/opt/skein/lib
export SKEIN_LAUNCHER=/opt/skein/skein SKEIN_LOADER=$lib/$loader SKEIN_BIN_DIR=/opt/skein/bin
export SKEIN_CONFIG_DIR=/opt/skein/share/skein/config
unset TMPDIR
exec chroot "$root" "$SKEIN_LOADER" --library-path $lib --argv0 skein /opt/skein/bin/skein \
  run /scenario.yaml --planner patrol --duration 20 --seed 3 --out /result $4
)sh";
  write("fly.sh", script);
  for (const std::string how : {"--one-process", "--dds=cyclonedds"}) {
    ChildProcess& packed = start_program("packed", {"/usr/bin/unshare", "--mount", "--pid", "--fork", "/bin/sh",
                                                    folder() / "fly.sh", root, folder() / "skein.tar.gz", scene_, how});
    ASSERT_EQ(packed.wait().code, 0) << packed.err() << packed.out();
    const Json result = Json::parse(text_of(folder() / "root/result/result.json"));
    SkeinRun& here = run("here" + how, {scene_, "--planner", "patrol", "--duration", "20", "--seed", "3", how});
    EXPECT_EQ(result["digest"], here.digest());
    fs::remove_all(root + "/result");
    fs::remove_all(root + "/opt");
  }
}

/// Planners and programs in Python, with this machine's interpreter and the files of the archive.
TEST_F(Sweep, APackFliesPython) {
  if (!fs::exists(program("libskein_python.so"))) GTEST_SKIP() << "this build has no Python";
  ChildProcess& pack = start_program("pack", {program("skein"), "pack", folder() / "skein.tar.gz"});
  ASSERT_EQ(pack.wait().code, 0) << pack.err();
  EXPECT_NE(pack.out().find("the package for Python"), std::string::npos) << pack.out();
  ASSERT_EQ(
      start_program("tar", {"/usr/bin/env", "tar", "-xzf", folder() / "skein.tar.gz", "-C", folder()}).wait().code, 0);
  write("up.py",
        "from skein.planner import *\nclass Up(Planner):\n    def plan(self, inputs):\n"
        "        return PlannerOutput(Hold())\n");
  write("mine.py",
        "import skein\nfrom skein.client import Client\nwith Client() as uav:\n    for step in uav:\n"
        "        uav.fly_to(step.state.p_WB + [0, 0, 1])\nprint('flown by', skein.__file__)\n");
  const std::string planner = "py:up.py,raffles=exec:exec " + python_program() + " -B mine.py";
  ChildProcess& packed = start_program("packed", installed({folder() / "skein/skein", "run", "towers", "--planner",
                                                            planner, "--duration", "2", "--out", "flown"}));
  ASSERT_EQ(packed.wait().code, 0) << packed.err() << text_of(folder() / "flown/uav_agent-raffles.log");
  const std::string said = text_of(folder() / "flown/uav_agent-raffles.log");
  EXPECT_NE(said.find("flown by " + (folder() / "skein/share/skein/python/skein").string()), std::string::npos) << said;
}

}  // namespace
}  // namespace skein::test
