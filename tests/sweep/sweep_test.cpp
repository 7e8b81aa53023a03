// Studies by `--executor`, with real fleets as short as they can be: whatever flies them, and whatever is killed
// meanwhile, digests, scores and tables are those of the plain command.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "tests/fleet/fleet_fixture.hpp"
#include "tests/fleet/small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

bool is_installed(const std::string& program) {
  const std::string command = "command -v " + program + " >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;
}

/// Columns that measure the machine.
bool is_of_the_machine(const std::string& column) {
  return column.starts_with("planner_cpu_ms") || column.starts_with("real_time_factor");
}

using Table = std::vector<std::map<std::string, std::string>>;

class SweepTest : public FleetTest {
 protected:
  static constexpr std::size_t kFlights = 12;
  const std::string scene_ = write_small_scene(folder());

  Arguments study(const std::string& out, const Arguments& how) const {
    return joined({"contest", "--planners", "hover:height_m=4,patrol", "--scenarios", scene_, "--tests", "6",
                   "--duration", "20", "--out", folder() / out},
                  how);
  }
  ChildProcess& fly(const std::string& out, const Arguments& how, const Environment& environment = {}) {
    return start_program(out, joined({program("skein")}, study(out, how)), environment);
  }
  Table table(const std::string& out, const std::string& name) const {
    Table rows = read_csv(folder() / out / name);
    for (auto& row : rows) std::erase_if(row, [](const auto& cell) { return is_of_the_machine(cell.first); });
    return rows;
  }
  void expect_as_plain(const std::string& out) {
    if (!fs::exists(folder() / "plain")) {
      ChildProcess& plain = fly("plain", {});
      ASSERT_EQ(plain.wait().code, 0) << plain.err();
    }
    ASSERT_EQ(table("plain", "flights.csv").size(), kFlights);
    for (const char* name : {"flights.csv", "summary.csv", "totals.csv", "pairs.csv"}) {
      EXPECT_EQ(table("plain", name), table(out, name)) << out << "/" << name;
    }
    EXPECT_EQ(text_of(folder() / "plain" / "table.tex"), text_of(folder() / out / "table.tex"));
    EXPECT_TRUE(fs::is_regular_file(folder() / out / "report.html"));
  }
  std::size_t flown(const std::string& out) const {
    std::size_t count = 0;
    std::error_code none;
    for (fs::recursive_directory_iterator it(folder() / out / "flights", none), end; it != end; it.increment(none)) {
      count += it->path().filename() == "flight.json" ? 1 : 0;
    }
    return count;
  }

  /// PATH and the rest of a stand-in for Slurm.
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
  /// Of the stand-in: all jobs.
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

TEST_F(SweepTest, LocalUnitsAreAsThePlainStudy) {
  ChildProcess& local = fly("local", {"--executor", "local", "--jobs", "2"});
  ASSERT_EQ(local.wait().code, 0) << local.err();
  expect_as_plain("local");
  ChildProcess& again = fly("local", {"--executor", "local"});
  ASSERT_EQ(again.wait().code, 0) << again.err();
  EXPECT_EQ(again.err().find("units are over"), std::string::npos) << "nothing flies: " << again.err();
  expect_as_plain("local");
}

TEST_F(SweepTest, ParallelIsAsThePlainStudy) {
  if (!is_installed("parallel")) GTEST_SKIP() << "there is no GNU parallel: apt-get install parallel";
  ChildProcess& parallel = fly("parallel", {"--executor", "parallel", "--jobs", "2"});
  ASSERT_EQ(parallel.wait().code, 0) << parallel.err();
  expect_as_plain("parallel");
}

TEST_F(SweepTest, AControllerThatIsKilledCostsNothingButTime) {
  ChildProcess& first = fly("killed", {"--executor", "local", "--jobs", "2"});
  ASSERT_TRUE(eventually([&] { return flown("killed") >= 2; })) << first.err();
  first.signal(SIGKILL);
  first.wait();
  const std::size_t before = flown("killed");
  EXPECT_LT(before, kFlights) << "it was to be killed in its midst";
  ChildProcess& second = fly("killed", {"--executor", "local", "--jobs", "2"});
  ASSERT_EQ(second.wait().code, 0) << second.err();
  expect_as_plain("killed");
}

TEST_F(SweepTest, SlurmIsAsThePlainStudyAndGetsWhatItWants) {
  const Environment with = slurm("n1\nn2\n", "5");
  ChildProcess& study =
      fly("slurm", {"--executor", "slurm", "--jobs", "2", "--slurm", "partition=debug,account=mine,yours"}, with);
  ASSERT_EQ(study.wait().code, 0) << study.err();
  expect_as_plain("slurm");
  ASSERT_TRUE(eventually([&] { return slurm_is_idle(); }));
  const std::string calls = text_of(folder() / "slurm" / "calls");
  EXPECT_NE(calls.find("--array=0-4%2"), std::string::npos) << "cut to MaxArraySize: " << calls;
  EXPECT_NE(calls.find("--account=mine,yours"), std::string::npos) << calls;
  EXPECT_NE(calls.find("-merge --dependency=afterany:"), std::string::npos) << calls;
  EXPECT_NE(study.err().find("2 nodes; 1 flight flown again elsewhere, each with the same digest"), std::string::npos)
      << study.err();
}

TEST_F(SweepTest, DetachedItIsMergedByAJobThoughTasksAreKilled) {
  const Environment with = slurm("n1\nn2\n");
  ChildProcess& study = fly("detached", {"--executor", "slurm", "--detach"}, with);
  ASSERT_EQ(study.wait().code, 0) << study.err();
  EXPECT_FALSE(fs::exists(folder() / "detached" / "report.html"));
  // A node dies, twice; Slurm gives its unit to another one.
  for (std::size_t after = 1; after <= 3; after += 2) {
    ASSERT_TRUE(eventually([&] { return flown("detached") >= after; }));
    for (const Json& pid : slurm_jobs()["1"]["pids"]) ::kill(-pid.get<pid_t>(), SIGKILL);
  }
  ChildProcess& status =
      start_program("status", {program("skein"), "contest", "--status", folder() / "detached"}, with);
  ASSERT_NE(status.wait().code, 2) << status.err();
  EXPECT_NE(status.out().find(" of 12 flights are there; "), std::string::npos) << status.out();
  ASSERT_TRUE(eventually([&] { return slurm_is_idle(); })) << slurm_jobs();
  expect_as_plain("detached");
}

TEST_F(SweepTest, ALimitOfTimeLeavesWholeFlights) {
  const Environment with = slurm("n1\nn2\n");
  ChildProcess& study =
      fly("cut", {"--executor", "slurm", "--unit-minutes", "100", "--jobs", "1", "--slurm", "time=0:02"}, with);
  ASSERT_EQ(study.wait().code, 0) << study.err() << text_of(folder() / "cut/sweep/log/000000.log");
  expect_as_plain("cut");
  EXPECT_TRUE(fs::is_empty(folder() / "cut/sweep/air"));
}

TEST_F(SweepTest, AnotherBuildOnANodeFliesNothing) {
  // Its station is another file, which says the same.
  const fs::path bin = folder() / "bin";
  fs::create_directories(bin);
  for (const auto& entry : fs::directory_iterator(fs::path(program("skein")).parent_path())) {
    if (entry.path().filename() != "station") fs::create_symlink(entry.path(), bin / entry.path().filename());
  }
  fs::copy_file(program("station"), bin / "station");
  std::ofstream(bin / "station", std::ios::app) << "x";
  ChildProcess& planned = fly("builds", {"--executor", "local", "--jobs", "2"});
  ASSERT_EQ(planned.wait().code, 0) << planned.err();
  fs::remove_all(folder() / "builds/flights");
  ChildProcess& unit =
      start_program("unit", {program("skein"), "--unit", folder() / "builds", "0"}, {{"SKEIN_BIN_DIR", bin}});
  EXPECT_EQ(unit.wait().code, 3);
  EXPECT_NE(unit.err().find("the programs are of another build"), std::string::npos) << unit.err();
  EXPECT_EQ(flown("builds"), 0U);
}

TEST_F(SweepTest, AHuntIsTheSameSearch) {
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
}

/// The archive alone, in a root folder that has nothing else.
TEST_F(SweepTest, APackFliesWhereNothingIsInstalled) {
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

/// Planners and programs in Python, with this machine's interpreter and what is in the archive.
TEST_F(SweepTest, APackFliesPython) {
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
  ChildProcess& packed = start_program(
      "packed", {"/usr/bin/env", "-C", folder(), "-u", "PYTHONPATH", "-u", "SKEIN_BIN_DIR", "-u", "SKEIN_CONFIG_DIR",
                 folder() / "skein/skein", "run", "towers", "--planner", planner, "--duration", "2", "--out", "flown"});
  ASSERT_EQ(packed.wait().code, 0) << packed.err() << text_of(folder() / "flown/uav_agent-raffles.log");
  const std::string said = text_of(folder() / "flown/uav_agent-raffles.log");
  EXPECT_NE(said.find("flown by " + (folder() / "skein/share/skein/python/skein").string()), std::string::npos) << said;
}

/// Slurm's own daemons, in the long suite.
TEST_F(SweepTest, ARealSlurmIsAsThePlainStudy) {
  if (!long_tests()) GTEST_SKIP() << "in the long suite";
  const fs::path dir = folder() / "real";
  fs::create_directories(dir);
  ChildProcess& daemons = start_program("daemons", {source_path("tests/sweep/real_slurm.sh"), dir});
  ASSERT_TRUE(eventually([&] { return fs::exists(dir / "ready") || daemons.ended(); })) << daemons.out();
  if (const auto ended = daemons.ended(); ended && ended->code == 77) GTEST_SKIP() << daemons.out();
  ASSERT_FALSE(daemons.ended()) << daemons.out() << daemons.err();
  const Environment with = {{"SLURM_CONF", dir / "slurm.conf"}};

  ChildProcess& study = fly("slurm", {"--executor", "slurm", "--slurm", "partition=debug"}, with);
  EXPECT_EQ(study.wait().code, 0) << study.err() << text_of(folder() / "slurm/sweep/log/slurm.log");
  expect_as_plain("slurm");
  EXPECT_NE(study.err().find("2 nodes; 1 flight flown again elsewhere, each with the same digest"), std::string::npos)
      << study.err();

  // The controller is killed in its midst: a job merges.
  ChildProcess& killed = fly("killed", {"--executor", "slurm"}, with);
  EXPECT_TRUE(eventually([&] { return flown("killed") >= 2; })) << killed.err();
  killed.signal(SIGKILL);
  killed.wait();
  EXPECT_TRUE(eventually([&] { return fs::exists(folder() / "killed/report.html"); }))
      << text_of(folder() / "killed/sweep/log/slurm.log");
  expect_as_plain("killed");
  daemons.signal(SIGTERM);
  daemons.wait();
}

// `skein run --place slurm`: the launcher is on one node of the allocation, the UAVs are on the other.
TEST_F(SweepTest, AFleetOverTheNodesOfAnAllocation) {
  if (!long_tests()) GTEST_SKIP() << "in the long suite";
  const fs::path dir = folder() / "real";
  fs::create_directories(dir);
  ChildProcess& daemons = start_program("daemons", {source_path("tests/sweep/real_slurm.sh"), dir});
  ASSERT_TRUE(eventually([&] { return fs::exists(dir / "ready") || daemons.ended(); })) << daemons.out();
  if (const auto ended = daemons.ended(); ended && ended->code == 77) GTEST_SKIP() << daemons.out();
  ASSERT_FALSE(daemons.ended()) << daemons.out() << daemons.err();
  const Arguments flight = {"towers", "--planner", "patrol", "--duration", "10", "--no-oracle", "--no-report"};
  run("one", flight);
  std::string script = "#!/bin/sh\nexec " + program("skein") + " run";
  for (const std::string& word : flight) script += " " + word;
  const fs::path job = write("job.sh", script + " --place slurm --out " + (folder() / "placed").string() + "\n");
  ChildProcess& batch = start_program("sbatch",
                                      {"/usr/bin/env", "sbatch", "--wait", "--nodes=2", "--ntasks=2",
                                       "--output=" + (folder() / "job.out").string(), job},
                                      {{"SLURM_CONF", dir / "slurm.conf"}});
  EXPECT_EQ(batch.wait().code, 0) << batch.err() << text_of(folder() / "job.out");
  EXPECT_NE(text_of(folder() / "job.out").find("nanyang on n2"), std::string::npos) << text_of(folder() / "job.out");
  const auto digest_of = [&](const char* name) {
    return Json::parse(text_of(folder() / name / "result.json"), nullptr, false)["digest"];
  };
  EXPECT_EQ(digest_of("placed"), digest_of("one"));
  daemons.signal(SIGTERM);
  daemons.wait();
}

}  // namespace
}  // namespace skein::test
