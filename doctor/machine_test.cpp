// Tests that the doctor reads the facts of a machine from made-up cgroups and real folders, and judges random machines.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "doctor/machine_judges.hpp"
#include "process/program.hpp"

namespace skein::doctor {
namespace {

namespace fs = std::filesystem;
using Random = std::mt19937_64;

/// A random limit of at least `least`, or no limit.
Limit ample(Random& random, std::uint64_t least) {
  return random() % 4 == 0 ? Limit() : Limit(least + random() % (3 * least + 1));
}

/// The facts of a random machine that has enough of everything for the fleet.
MachineFacts drawn_machine(Random& random, const FleetNeeds& needs) {
  MachineFacts machine;
  machine.container = random() % 2 == 0 ? "" : "/.dockerenv";
  machine.cpus = 1 + static_cast<int>(random() % 16);
  if (random() % 2 == 0) machine.cgroup.cpus = 1.0 + static_cast<double>(random() % 16);
  machine.open_files = ample(random, needs.open_files());
  machine.most_open_files = ample(random, needs.open_files());
  machine.processes = ample(random, needs.threads());
  machine.kernel_processes = ample(random, needs.threads());
  machine.cgroup.processes = ample(random, needs.threads());
  machine.receive_buffer = ample(random, kSocketBuffer);
  machine.send_buffer = ample(random, kSocketBuffer);
  machine.memory = ample(random, 2 * needs.memory_bytes());
  machine.cgroup.memory_left = ample(random, 2 * needs.memory_bytes());
  return machine;
}

Findings judge(const MachineFacts& machine, const FleetNeeds& needs) {
  return {judge_container(machine), judge_open_files(machine, needs), judge_processes(machine, needs),
          judge_buffers(machine),   judge_memory(machine, needs),     judge_cpus(machine)};
}

std::vector<std::string> complaints(const Findings& findings) {
  std::vector<std::string> names;
  for (const Finding& finding : findings) {
    if (finding.verdict != Verdict::ok) names.push_back(finding.what);
    EXPECT_EQ(finding.verdict == Verdict::ok, finding.fix.empty()) << finding.what;
    EXPECT_EQ((finding.found + finding.fix).find('\n'), std::string::npos);
  }
  return names;
}

/// A resource of which a machine can have too little.
struct Shortage {
  std::string what;                                                      ///< the finding that reports it
  std::function<void(MachineFacts&, Random&, const FleetNeeds&)> cause;  ///< lowers the resource below the need
};

const std::vector<Shortage>& shortages() {
  static const std::vector<Shortage> kAll = {
      {"open files",
       [](auto& m, auto& random, const auto& n) { m.open_files = m.most_open_files = random() % n.open_files(); }},
      {"processes", [](auto& m, auto& random, const auto& n) { m.processes = random() % n.threads(); }},
      {"processes", [](auto& m, auto& random, const auto& n) { m.kernel_processes = random() % n.threads(); }},
      {"processes", [](auto& m, auto& random, const auto& n) { m.cgroup.processes = random() % n.threads(); }},
      {"socket buffers",
       [](auto& m, auto& random, const auto&) {
         m.receive_buffer = random() % kSocketBuffer;
         m.send_buffer = random();
       }},
      {"socket buffers",
       [](auto& m, auto& random, const auto&) {
         m.receive_buffer = random() % (8 * kSocketBuffer);
         m.send_buffer = random() % kSocketBuffer;
       }},
      {"memory", [](auto& m, auto& random, const auto& n) { m.memory = random() % (2 * n.memory_bytes()); }},
      {"memory",
       [](auto& m, auto& random, const auto& n) { m.cgroup.memory_left = random() % (2 * n.memory_bytes()); }},
      {"processors",
       [](auto& m, auto& random, const auto&) { m.cgroup.cpus = 0.01 * static_cast<double>(1 + random() % 99); }}};
  return kAll;
}

TEST(MachineJudges, ReportEachShortageAndNothingElse) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const FleetNeeds needs{1 + random() % 100};
    const MachineFacts machine = drawn_machine(random, needs);
    EXPECT_TRUE(complaints(judge(machine, needs)).empty());
    const Shortage& shortage = shortages()[random() % shortages().size()];
    MachineFacts poor = machine;
    shortage.cause(poor, random, needs);
    EXPECT_EQ(complaints(judge(poor, needs)), std::vector{shortage.what});
  }
}

TEST(MachineJudges, TheFixNamesTheLowestProcessLimit) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const FleetNeeds needs{1 + random() % 100};
    MachineFacts machine = drawn_machine(random, needs);
    const std::vector<std::pair<Limit*, std::string>> limits = {{&machine.processes, "ulimit -u"},
                                                                {&machine.kernel_processes, "kernel.threads-max"},
                                                                {&machine.cgroup.processes, "pids.max"}};
    const std::uint64_t least = random() % (needs.threads() - 1);
    const auto& [lowest, name] = limits[random() % limits.size()];
    for (const auto& [limit, other] : limits) {
      if (random() % 2 == 0) *limit = least + 1 + random() % needs.threads();
    }
    *lowest = least;
    const Finding finding = judge_processes(machine, needs);
    EXPECT_EQ(finding.verdict, Verdict::fail);
    for (const auto& [limit, other] : limits) {
      EXPECT_EQ(finding.fix.find(other) != std::string::npos, limit == lowest) << finding.fix;
    }
  }
}

TEST(MachineJudges, MoreUavsNeedMoreOfEverything) {
  for (std::size_t uavs = 1; uavs < 200; ++uavs) {
    const FleetNeeds less{uavs}, more{uavs + 1};
    EXPECT_LT(less.open_files(), more.open_files());
    EXPECT_LT(less.threads(), more.threads());
    EXPECT_LT(less.memory_bytes(), more.memory_bytes());
  }
  // Measured: over Fast DDS, the server of a fleet of 5 UAVs has 74 open files; the programs of a fleet of 100 UAVs
  // use 909 MB.
  EXPECT_GE(FleetNeeds{5}.open_files(), 74u);
  EXPECT_GE(FleetNeeds{100}.memory_bytes(), 909'000'000u);
}

TEST(MachineJudges, AFullDiskFailsAndANearlyFullOneWarns) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    DiskFacts disk{.folder = "/results", .free = kAmpleDisk + random() % kAmpleDisk};
    EXPECT_EQ(judge_disk(disk).verdict, Verdict::ok);
    disk.free = kLeastDisk + random() % (kAmpleDisk - kLeastDisk);
    EXPECT_EQ(judge_disk(disk).verdict, Verdict::warn);
    disk.free = random() % kLeastDisk;
    EXPECT_EQ(judge_disk(disk).verdict, Verdict::fail);
  }
  DiskFacts disk{.folder = "/results", .free = kAmpleDisk};
  disk.create_error = "Read-only file system";
  EXPECT_EQ(judge_disk(disk).verdict, Verdict::fail);
}

TEST(MachineJudges, StoppedWrongAndSlowClocksAreReported) {
  ClockFacts clocks{.monotonic_s = 0.02, .realtime_s = 0.02, .date_s = 1.7e9, .source = "tsc"};
  EXPECT_TRUE(complaints(judge_clocks(clocks)).empty());
  clocks.realtime_s = -3600.0;
  EXPECT_EQ(complaints(judge_clocks(clocks)), std::vector<std::string>{"time of day"});
  EXPECT_EQ(exit_code(judge_clocks(clocks)), kExitDone) << "only a warning: no result depends on the time of day";
  clocks.realtime_s = 0.02;
  clocks.date_s = 86400.0;
  EXPECT_EQ(complaints(judge_clocks(clocks)), std::vector<std::string>{"time of day"});
  clocks.date_s = 1.7e9;
  clocks.source = "hpet";
  EXPECT_EQ(complaints(judge_clocks(clocks)), std::vector<std::string>{"monotonic clock"});
  clocks.monotonic_s = 0.0;
  clocks.realtime_s = 0.0;
  EXPECT_EQ(exit_code(judge_clocks(clocks)), kExitCheckFailed);
}

class MadeUpMachine : public testing::Test {
 protected:
  MadeUpMachine() {
    std::string pattern = fs::temp_directory_path() / "skein-doctor-facts-XXXXXX";
    root_ = ::mkdtemp(pattern.data());
  }
  ~MadeUpMachine() override { fs::remove_all(root_); }

  void write_file(const std::string& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }

  fs::path root_;
};

TEST_F(MadeUpMachine, TheLowestLimitOfACgroupAndItsAncestorsCounts) {
  write_file("proc/self/cgroup", "0::/a/b\n");
  write_file("sys/fs/cgroup/a/b/memory.max", "max\n");
  write_file("sys/fs/cgroup/a/memory.max", "1000\n");
  write_file("sys/fs/cgroup/a/memory.current", "900\n");
  write_file("sys/fs/cgroup/a/memory.stat", "anon 700\ninactive_file 150\n");
  write_file("sys/fs/cgroup/a/b/pids.max", "70\n");
  write_file("sys/fs/cgroup/a/pids.max", "90\n");
  write_file("sys/fs/cgroup/a/b/cpu.max", "max 100000\n");
  write_file("sys/fs/cgroup/cpu.max", "150000 100000\n");
  const CgroupFacts facts = read_cgroup(root_);
  EXPECT_EQ(facts.memory_left, 250u);
  EXPECT_EQ(facts.processes, 70u);
  EXPECT_EQ(facts.cpus, 1.5);
}

TEST_F(MadeUpMachine, CgroupsOfVersion1CountToo) {
  write_file("proc/self/cgroup", "4:memory:/docker/x\n3:cpu,cpuacct:/docker/x\n2:pids:/docker/x\n1:name=systemd:/\n");
  write_file("sys/fs/cgroup/memory/memory.limit_in_bytes", "1000\n");  // a container sees its own cgroup as the root
  write_file("sys/fs/cgroup/memory/memory.usage_in_bytes", "400\n");
  write_file("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "50000\n");
  write_file("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
  write_file("sys/fs/cgroup/pids/pids.max", "max\n");
  const CgroupFacts facts = read_cgroup(root_);
  EXPECT_EQ(facts.memory_left, 600u);
  EXPECT_EQ(facts.cpus, 0.5);
  EXPECT_FALSE(facts.processes);
}

TEST_F(MadeUpMachine, MissingLimitsAreReadAsNoLimit) {
  write_file("proc/self/cgroup", "4:memory:/\n3:cpu:/\n");
  write_file("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  write_file("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
  write_file("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
  for (const fs::path& root : {root_, root_ / "nowhere"}) {
    const CgroupFacts facts = read_cgroup(root);
    EXPECT_FALSE(facts.memory_left || facts.cpus || facts.processes);
  }
}

TEST_F(MadeUpMachine, ReadDiskTriesToCreateAFileAndLeavesNone) {
  const DiskFacts disk = read_disk(root_ / "runs" / "not" / "yet");
  EXPECT_EQ(disk.folder, root_);
  EXPECT_TRUE(disk.free);
  EXPECT_TRUE(disk.create_error.empty()) << disk.create_error;
  EXPECT_TRUE(fs::is_empty(root_));
  EXPECT_FALSE(read_disk("/proc").create_error.empty());
}

TEST(MachineFacts, CanBeReadOnThisMachine) {
  EXPECT_GE(read_machine().cpus, 1);
  const ClockFacts clocks = read_clocks();
  EXPECT_GT(clocks.monotonic_s, 0.0);
  EXPECT_GT(clocks.date_s, 0.0);
}

}  // namespace
}  // namespace skein::doctor
