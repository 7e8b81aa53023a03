#include "host/supervisor.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "host/testing/ends.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/host/environment.hpp"

namespace skein::cli {
namespace {

constexpr std::chrono::milliseconds kNoLimit{-1};

class SupervisorTest : public ::testing::Test {
 protected:
  ProgramSpec shell(const std::string& name, const std::string& script) const {
    return {name, {"/bin/sh", "-c", script}, environment_with({}), scratch_.path() / (name + ".log")};
  }

  /// Collects all events until no program is left.
  std::vector<Event> run_out() {
    std::vector<Event> all;
    const auto none_is_left = [&] {
      for (int looks = 0; looks < 50 && !supervisor_.running().empty(); ++looks) {
        for (Event& event : supervisor_.wait(std::chrono::milliseconds(20))) all.push_back(std::move(event));
      }
      return supervisor_.running().empty();
    };
    EXPECT_TRUE(eventually(none_is_left, kUntilNoticed)) << "a program still runs";
    if (all.empty()) all.emplace_back();  // only in a failed test: callers read the last event
    return all;
  }
  /// Waits until a program is seen to have been stopped.
  bool stops(const std::string& program) {
    return eventually([&] { return supervisor_.has_stopped(program); }, kUntilNoticed);
  }
  /// Kills the programs of a failed test: the supervisor's destructor waits for them and their minders.
  void TearDown() override {
    if (HasFailure()) kill_own_children();
  }

  ScratchDir scratch_;
  Supervisor supervisor_;
};

TEST_F(SupervisorTest, ProcessorTimeIsReportedWhileAProgramRunsAndAtItsEnd) {
  supervisor_.start(shell("a", "i=0; while [ $i -lt 20000 ]; do i=$((i + 1)); done; echo >&3; read line <&4"));
  EXPECT_EQ(supervisor_.wait(kNoLimit).at(0).kind, Event::Kind::status_line);
  const double so_far_s = supervisor_.cpu_s("a");
  EXPECT_GT(so_far_s, 0.0);
  EXPECT_GT(supervisor_.memory_share_mb("a"), 0.0);
  supervisor_.send("a", "go");
  EXPECT_GT(run_out().back().exit.cpu_s, 0.9 * so_far_s);
  EXPECT_EQ(supervisor_.cpu_s("a"), 0.0);
}

TEST_F(SupervisorTest, StatusLinesComeBeforeTheExit) {
  supervisor_.start(shell("a", "echo one >&3; echo two >&3; exit 5"));
  const std::vector<Event> events = run_out();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].line, "one");
  EXPECT_EQ(events[1].line, "two");
  EXPECT_EQ(events[2].kind, Event::Kind::exited);
  EXPECT_EQ(events[2].program, "a");
  EXPECT_EQ(events[2].exit.code, 5);
  EXPECT_EQ(events[2].exit.text(), "exit code 5");
}

TEST_F(SupervisorTest, OutputGoesToTheLog) {
  supervisor_.start(shell("a", "echo out; echo err >&2; for i in 1 2 3; do echo $i; done"));
  run_out();
  EXPECT_EQ(last_lines(scratch_.path() / "a.log", 4), (std::vector<std::string>{"err", "1", "2", "3"}));
}

TEST_F(SupervisorTest, ASignalIsNamed) {
  supervisor_.start(shell("a", "kill -SEGV $$"));
  const std::vector<Event> events = run_out();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].exit.signal, SIGSEGV);
  EXPECT_EQ(events[0].exit.text(), "signal 11 (Segmentation fault)");
}

TEST_F(SupervisorTest, ControlLinesArrive) {
  supervisor_.start(shell("a", "read line <&4; echo got $line >&3"));
  supervisor_.send("a", "lost beta");
  supervisor_.send("nobody", "lost beta");
  const std::vector<Event> events = run_out();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].line, "got lost beta");
}

TEST_F(SupervisorTest, AFullControlPipeDoesNotBlock) {
  supervisor_.start(shell("a", "read line <&3"));  // reads nothing from 4
  for (int i = 0; i < 10000; ++i) supervisor_.send("a", std::string(100, 'x'));
  supervisor_.end_all(std::chrono::seconds(10));
  EXPECT_TRUE(supervisor_.running().empty());
}

TEST_F(SupervisorTest, EndAllSendsSigtermAndKillsProgramsThatIgnoreIt) {
  supervisor_.start(shell("polite", "trap 'exit 7' TERM; echo ready >&3; while :; do read line <&4; done"));
  supervisor_.start(shell("stubborn", "trap '' TERM; echo ready >&3; while :; do read line <&4; done"));
  for (std::size_t ready = 0; ready < 2;) ready += supervisor_.wait(kNoLimit).size();
  std::map<std::string, ExitStatus> exits;
  for (const Event& event : supervisor_.end_all(std::chrono::milliseconds(300))) exits[event.program] = event.exit;
  EXPECT_EQ(exits["polite"].code, 7);
  EXPECT_EQ(exits["stubborn"].signal, SIGKILL);
}

TEST_F(SupervisorTest, AStoppedProgramCanBeEnded) {
  supervisor_.start(shell("a", "echo ready >&3; kill -STOP $$; read line <&4"));
  while (supervisor_.wait(kNoLimit).empty()) {
  }
  supervisor_.end_all(std::chrono::milliseconds(300));
  EXPECT_TRUE(supervisor_.running().empty());
}

TEST_F(SupervisorTest, AProgramThatStopsItselfIsReportedOnceAndCanBeContinued) {
  supervisor_.start(shell("a", "echo stopping >&3; kill -STOP $$; echo going on >&3"));
  EXPECT_EQ(supervisor_.wait(kNoLimit).at(0).line, "stopping");
  ASSERT_TRUE(stops("a"));
  EXPECT_FALSE(supervisor_.has_stopped("a"));
  supervisor_.signal("a", SIGCONT);
  EXPECT_EQ(run_out().at(0).line, "going on");
  EXPECT_FALSE(supervisor_.has_stopped("a"));
}

TEST_F(SupervisorTest, ARestartedProgramCanAppendToItsLog) {
  ProgramSpec program = shell("a", "echo life");
  supervisor_.start(program);
  run_out();
  program.append_log = true;
  supervisor_.start(program);
  run_out();
  EXPECT_EQ(read_text(program.log), "life\nlife\n");
}

TEST_F(SupervisorTest, ChildrenOfAProgramEndWithIt) {
  OpenUntilAllEnded pipe;
  supervisor_.start(shell("a", "sleep 1000 & echo started >&3"));
  run_out();
  EXPECT_TRUE(pipe.all_ended());
}

TEST_F(SupervisorTest, TheProcessesThatAMindedProgramStartedEndWithIt) {
  OpenUntilAllEnded pipe;
  ProgramSpec program = shell("a", "setsid sleep 1000 & env -i sleep 1000 & echo started >&3; exit 5");
  program.minded = true;
  supervisor_.start(program);
  const std::vector<Event> events = run_out();
  EXPECT_EQ(events.back().exit.code, 5);
  EXPECT_TRUE(pipe.all_ended());
}

TEST_F(SupervisorTest, AMindedProgramBehavesLikeAnyOtherOne) {
  ProgramSpec program = shell("a", "echo stopping >&3; kill -STOP $$; read line <&4; kill -SEGV $$");
  program.minded = true;
  supervisor_.start(program);
  EXPECT_EQ(supervisor_.wait(kNoLimit).at(0).line, "stopping");
  ASSERT_TRUE(stops("a"));
  supervisor_.signal("a", SIGCONT);
  EXPECT_GT(supervisor_.memory_share_mb("a"), 0.0);
  supervisor_.send("a", "go");
  ASSERT_EQ(run_out().back().exit.signal, SIGSEGV);
  program.argv = {"/does/not/exist"};
  EXPECT_THROW(supervisor_.start(program), std::system_error);
  EXPECT_TRUE(supervisor_.running().empty());
}

TEST_F(SupervisorTest, AStoppedMindedProgramCanBeEnded) {
  OpenUntilAllEnded pipe;
  ProgramSpec program = shell("a", "setsid sleep 1000 & echo ready >&3; kill -STOP $$; read line <&4");
  program.minded = true;
  supervisor_.start(program);
  ASSERT_TRUE(stops("a"));
  supervisor_.end_all(std::chrono::milliseconds(300));
  EXPECT_TRUE(supervisor_.running().empty());
  EXPECT_TRUE(pipe.all_ended());
}

TEST_F(SupervisorTest, AStoppedMindedProgramCanBeKilled) {
  ProgramSpec program = shell("a", "kill -STOP $$");
  program.minded = true;
  supervisor_.start(program);
  ASSERT_TRUE(stops("a"));
  supervisor_.signal("a", SIGKILL);
  EXPECT_EQ(run_out().back().exit.signal, SIGKILL);
}

// A faulty destructor waits for ever, so another process calls it.
TEST(SupervisorsEnd, KillsAStoppedMindedProgram) {
  const pid_t launcher = ::fork();
  if (launcher == 0) {
    {
      Supervisor supervisor;
      ProgramSpec program{"a", {"/bin/sh", "-c", "kill -STOP $$"}, environment_with({}), {}};
      program.minded = true;
      supervisor.start(program);
      eventually([&] { return supervisor.has_stopped("a"); }, kUntilNoticed);
    }
    ::_exit(0);
  }
  const bool has_ended = eventually([&] { return ::waitpid(launcher, nullptr, WNOHANG) == launcher; }, kUntilNoticed);
  EXPECT_TRUE(has_ended);
  if (has_ended) return;
  ::kill(launcher, SIGKILL);
  ::waitpid(launcher, nullptr, 0);
}

TEST_F(SupervisorTest, TheTerminalsSignalsBecomeAnEventAndDoNotReachThePrograms) {
  supervisor_.start(shell("a", "read line <&4; exit 0"));
  ::kill(::getpid(), SIGINT);
  const std::vector<Event> events = supervisor_.wait(kNoLimit);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Event::Kind::interrupt);
  EXPECT_TRUE(supervisor_.running("a"));
  supervisor_.send("a", "go");
  EXPECT_TRUE(run_out().back().exit.ok());
}

TEST_F(SupervisorTest, WaitReturnsNothingAfterItsLimit) {
  supervisor_.start(shell("a", "read line <&4"));
  EXPECT_TRUE(supervisor_.wait(std::chrono::milliseconds(1)).empty());
}

TEST_F(SupervisorTest, AMissingBinaryIsAnErrorWithItsName) {
  try {
    supervisor_.start({"a", {"/does/not/exist"}, {}, scratch_.path() / "a.log"});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("/does/not/exist"), std::string::npos);
  }
  EXPECT_TRUE(supervisor_.running().empty());
}

class KilledLauncher : public ::testing::TestWithParam<bool> {};

TEST_P(KilledLauncher, IsOutlivedByNoProgram) {
  OpenUntilAllEnded pipe;
  const bool minded = GetParam();
  const pid_t launcher = ::fork();
  if (launcher == 0) {  // a launcher that is killed while its program runs
    Supervisor supervisor;
    const std::string script = minded ? "setsid sleep 1000 & " : "";
    ProgramSpec program{"a", {"/bin/sh", "-c", script + "echo ready >&3; read line <&3"}, environment_with({}), {}};
    program.minded = minded;
    supervisor.start(program);
    while (supervisor.wait(kNoLimit).empty()) {
    }
    ::kill(::getpid(), SIGKILL);
  }
  EXPECT_TRUE(pipe.all_ended());
  EXPECT_EQ(::waitpid(launcher, nullptr, 0), launcher);
}

INSTANTIATE_TEST_SUITE_P(Minded, KilledLauncher, ::testing::Bool());
TEST_F(SupervisorTest, AProgramThatWritesALineWithoutAnEndIsCutOffAndNamed) {
  supervisor_.start(shell("endless", "trap '' PIPE; echo first >&3; yes endless | tr -d '\\n' >&3; exit 7"));
  supervisor_.start(shell("other", "read line <&4; echo \"$line\" >&3"));
  std::vector<Event> events;
  while (supervisor_.running("endless")) {
    for (Event& event : supervisor_.wait(kNoLimit)) events.push_back(std::move(event));
  }
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].line, "first");
  EXPECT_EQ(events[1].kind, Event::Kind::cut_off);
  EXPECT_EQ(events[1].program, "endless");
  EXPECT_NE(events[1].line.find("too long a line"), std::string::npos) << events[1].line;
  EXPECT_EQ(events[2].exit.code, 7) << "the program goes on, although nobody reads its pipe";
  supervisor_.send("other", "still heard");
  EXPECT_EQ(run_out().at(0).line, "still heard");
}

TEST_F(SupervisorTest, AProgramThatWritesLinesWithoutAnEndIsCutOffToo) {
  ProgramSpec endless = shell("endless", "trap '' PIPE; yes >&3; exit 7");
  endless.most_status_bytes = 1 << 20;
  supervisor_.start(endless);
  std::size_t lines = 0, most_at_once = 0, cuts = 0;
  while (supervisor_.running("endless")) {
    const std::vector<Event> events = supervisor_.wait(kNoLimit);
    most_at_once = std::max(most_at_once, events.size());
    for (const Event& event : events) {
      lines += event.kind == Event::Kind::status_line;
      cuts += event.kind == Event::Kind::cut_off;
    }
  }
  EXPECT_EQ(cuts, 1U);
  EXPECT_GE(lines, std::size_t{1 << 19});
  EXPECT_LE(lines, std::size_t{1 << 19} + 4096);
  EXPECT_LE(most_at_once, std::size_t{40000})
      << "the supervisor must not buffer more: other programs wait for their turn";
}

TEST_F(SupervisorTest, ALongReportIsNotTakenForALineWithoutAnEnd) {
  supervisor_.start(shell("a", "head -c 15000000 /dev/zero | tr '\\0' x >&3; echo >&3"));
  const std::vector<Event> events = run_out();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].line.size(), 15000000U);
}

TEST_F(SupervisorTest, AnEndlessLogKeepsItsBeginningAndItsEnd) {
  EXPECT_LE(ProgramSpec().most_log_bytes, 64U << 20) << "the default limit of each program's log";
  ProgramSpec spec =
      shell("a", "echo first; head -c 30000000 /dev/zero | tr '\\0' x; echo >&3; read line <&4; echo; echo last");
  spec.most_log_bytes = 2 << 20;
  supervisor_.start(spec);
  EXPECT_EQ(supervisor_.wait(kNoLimit).at(0).kind, Event::Kind::status_line);
  supervisor_.wait(std::chrono::milliseconds(0));
  EXPECT_LE(std::filesystem::file_size(spec.log), std::uintmax_t{2 << 20})
      << "the limit also applies while the program runs";
  supervisor_.send("a", "go");
  run_out();
  std::ifstream in(spec.log);
  std::string first;
  std::getline(in, first);
  EXPECT_EQ(first, "first");
  EXPECT_EQ(last_lines(spec.log, 1), std::vector<std::string>{"last"});
  EXPECT_LE(std::filesystem::file_size(spec.log), std::uintmax_t{2 << 20});
  EXPECT_NE(read_text(spec.log).find("\n[skein] the middle of this log was removed, because it has more than 2 MiB\n"),
            std::string::npos);
}

TEST_F(SupervisorTest, TheLastLinesOfAHugeLogAreShort) {
  const auto log = scratch_.path() / "huge.log";
  std::ofstream(log) << std::string(300000, 'x');
  EXPECT_EQ(last_lines(log, 10).size(), 1U);
  EXPECT_LE(last_lines(log, 10)[0].size(), 1100U);
  std::ofstream(log, std::ios::app) << "yes\n";
  ASSERT_EQ(last_lines(log, 10).size(), 1U) << "the log has only one line";
  EXPECT_TRUE(last_lines(log, 10)[0].starts_with("... ") && last_lines(log, 10)[0].ends_with("xyes"));
  EXPECT_LE(last_lines(log, 10)[0].size(), 1100U);
  std::ofstream(log, std::ios::app) << "last words\n";
  EXPECT_EQ(last_lines(log, 10), std::vector<std::string>{"last words"});
  std::filesystem::resize_file(log, std::uintmax_t{1} << 40);  // a sparse file
  EXPECT_LE(last_lines(log, 10).size(), 1U);
  EXPECT_TRUE(last_lines(scratch_.path() / "none.log", 10).empty());
}

}  // namespace
}  // namespace skein::cli
