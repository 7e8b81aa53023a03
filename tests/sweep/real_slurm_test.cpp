// Studies with the real daemons of Slurm (real_slurm.sh), in the long suite.
#include "sweep_fixture.hpp"

namespace skein::test {
namespace {

class RealSlurm : public SweepTest {
 protected:
  void SetUp() override {
    if (!long_tests()) GTEST_SKIP() << "only the long suite runs this: SKEIN_LONG=1";
    fs::create_directories(dir_);
    daemons_ = &start_program("daemons", {source_path("tests/sweep/real_slurm.sh"), dir_});
    ASSERT_TRUE(eventually([&] { return fs::exists(dir_ / "ready") || daemons_->ended(); })) << daemons_->out();
    if (const auto ended = daemons_->ended(); ended && ended->code == 77) GTEST_SKIP() << daemons_->out();
    ASSERT_FALSE(daemons_->ended()) << daemons_->out() << daemons_->err();
  }
  void TearDown() override {
    if (daemons_ != nullptr) {
      daemons_->signal(SIGTERM);
      daemons_->wait();
    }
    SweepTest::TearDown();
  }

  /// Kills a daemon whose process id is in a file of the script.
  bool kill_daemon(const std::string& name) const {
    return ::kill(std::stoi("0" + text_of(dir_ / (name + ".pid"))), SIGKILL) == 0;
  }

  const fs::path dir_ = folder() / "real";
  const Environment slurm_ = {{"SLURM_CONF", dir_ / "slurm.conf"}};
  ChildProcess* daemons_ = nullptr;
};

TEST_F(RealSlurm, GivesTheResultsOfThePlainStudy) {
  ChildProcess& study = fly("slurm", {"--executor", "slurm", "--slurm", "partition=debug"}, slurm_);
  EXPECT_EQ(study.wait().code, 0) << study.err() << text_of(folder() / "slurm/sweep/log/slurm.log");
  expect_as_plain("slurm");
  EXPECT_NE(study.err().find("2 nodes; 1 flight flown again elsewhere, each with the same digest"), std::string::npos)
      << study.err();

  // If the sweep's controller is killed during the sweep, a job of Slurm merges the results.
  ChildProcess& killed = fly("killed", {"--executor", "slurm"}, slurm_);
  EXPECT_TRUE(eventually([&] { return flown("killed") >= 2; })) << killed.err();
  killed.signal(SIGKILL);
  killed.wait();
  EXPECT_TRUE(eventually([&] { return fs::exists(folder() / "killed/report.html"); }))
      << text_of(folder() / "killed/sweep/log/slurm.log");
  expect_as_plain("killed");
}

// Slurm moves the tasks of a lost node to another node, and keeps its jobs in files.
TEST_F(RealSlurm, CompletesAStudyAlthoughANodeAndTheControllerDie) {
  ChildProcess& study = fly("deaths", {"--executor", "slurm"}, slurm_);
  ASSERT_TRUE(eventually([&] { return flown("deaths") >= 2; })) << study.err();
  ASSERT_TRUE(kill_daemon("slurmctld"));
  ASSERT_TRUE(kill_daemon("node-n2"));
  EXPECT_LT(flown("deaths"), flights()) << "the study ended before the node and the controller were killed";
  // Slurm may need four minutes: if its controller died just after a task had ended, the new controller considers the
  // task running until it queries the node.
  EXPECT_TRUE(eventually([&] { return study.ended().has_value(); }, std::chrono::minutes(10))) << study.err();
  EXPECT_EQ(study.wait().code, 0) << study.err() << logs("deaths");
  expect_as_plain("deaths");
}

// The limit is one minute. Every half a minute, Slurm signals the jobs that reach their limit within a minute, so all
// jobs that run then end.
TEST_F(RealSlurm, KeepsCompleteFlightsWhenJobsReachTheirTimeLimit) {
  tests_ = 40;
  ChildProcess& study =
      fly("cut", {"--executor", "slurm", "--jobs", "1", "--unit-minutes", "100", "--slurm", "time=1"}, slurm_);
  EXPECT_EQ(study.wait().code, 0) << study.err() << logs("cut");
  EXPECT_NE(logs("cut").find("ended by a signal; the study keeps the flights completed so far"), std::string::npos)
      << logs("cut");
  expect_as_plain("cut");
}

// `skein run --place slurm`: the launcher is on one node of the allocation, the UAVs are on the other one.
TEST_F(RealSlurm, FliesAFleetOverTheNodesOfAnAllocation) {
  const Arguments flight = {"towers", "--planner", "patrol", "--duration", "10", "--no-oracle", "--no-report"};
  run("one", flight);
  std::string script = "#!/bin/sh\nexec " + program("skein") + " run";
  for (const std::string& word : flight) script += " " + word;
  const fs::path job = write("job.sh", script + " --place slurm --out " + (folder() / "placed").string() + "\n");
  ChildProcess& batch = start_program("sbatch",
                                      {"/usr/bin/env", "sbatch", "--wait", "--nodes=2", "--ntasks=2",
                                       "--output=" + (folder() / "job.out").string(), job},
                                      slurm_);
  EXPECT_EQ(batch.wait().code, 0) << batch.err() << text_of(folder() / "job.out");
  EXPECT_NE(text_of(folder() / "job.out").find("nanyang on n2"), std::string::npos) << text_of(folder() / "job.out");
  const auto digest_of = [&](const char* name) {
    return Json::parse(text_of(folder() / name / "result.json"), nullptr, false)["digest"];
  };
  EXPECT_EQ(digest_of("placed"), digest_of("one"));
}

}  // namespace
}  // namespace skein::test
