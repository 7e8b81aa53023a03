// The launcher's side of a process that contains a fleet. A shell script replaces that process.
#include "host/shared_process.hpp"

#include <gtest/gtest.h>

#include <csignal>

#include "host/preflight.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/host/environment.hpp"
#include "process/json_text.hpp"
#include "tests/support/eventually.hpp"

namespace skein::cli {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kMostLog = 2 << 20;

class SharedProcessTest : public testing::Test {
 protected:
  /// Starts the process. @param script  its shell script: descriptor 3 is the status pipe, 4 the control pipe
  void home(const std::string& script) {
    host_.emplace(ProgramSpec{"home", {"/bin/sh", "-c", script}, environment_with({}), folder_.path() / "home.log"});
    for (const char* program : {"a", "b"}) {
      ProgramSpec spec{program, {"prog", "--out", "x y"}, {}, log_of(program)};
      spec.most_log_bytes = kMostLog;
      host_->start(spec);
    }
  }
  std::filesystem::path log_of(const std::string& program) const { return folder_.path() / (program + ".log"); }
  /// Collects events until no program runs, or until there is one of the program `end`.
  std::vector<Event> hear(const std::string& end = "") {
    std::vector<Event> all;
    eventually([&] {
      for (Event& event : host_->wait(1000ms)) all.push_back(std::move(event));
      return host_->running().empty() || (!all.empty() && all.back().program == end);
    });
    return all;
  }
  static std::vector<Event> ends_in(const std::vector<Event>& events) {
    std::vector<Event> ends;
    for (const Event& event : events) {
      if (event.kind == Event::Kind::exited) ends.push_back(event);
    }
    return ends;
  }

  const ScratchDir folder_;
  std::optional<SharedProcess> host_;
};

const std::string kReadTwo = "read a <&4; read b <&4; ";
const std::string kRest = "cat <&4 >/dev/null";

TEST_F(SharedProcessTest, ProgramsAreStartedAndHeardByTheirNames) {
  home(kReadTwo + R"(echo "{\"said_by\": \"a\", \"line\": $b}" >&3; )" + kRest);
  const auto events = hear("a");
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].program, "a");
  const Json echoed = parse_json(events[0].line);
  EXPECT_EQ(echoed["start"], "b");
  EXPECT_EQ(echoed["argv"], (Json{"prog", "--out", "x y"}));
  EXPECT_EQ(echoed["log"], (folder_.path() / "b.log").string());
  EXPECT_EQ(host_->running(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(host_->processes(), (std::vector<std::string>{"home"}));
}

TEST_F(SharedProcessTest, TheProcessGoesOnWhenItsProgramsHaveEnded) {
  home(kReadTwo + R"(echo '{"ended": "a", "code": 3, "signal": 0}' >&3; echo '{"ended": "nobody", "code": 3}' >&3
echo '{"ended": "b", "code": 0, "signal": 9}' >&3; )" +
       kRest);
  const auto ends = ends_in(hear());
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_EQ(ends[0].exit.code, 3);
  EXPECT_EQ(ends[1].exit.signal, 9);
  for (const Event& end : ends) EXPECT_TRUE(end.exit.shared && !end.exit.dragged) << end.program;
  const auto last = ends_in(host_->end_all(5000ms));
  ASSERT_EQ(last.size(), 1U);
  EXPECT_EQ(last[0].program, "home");
  EXPECT_TRUE(last[0].exit.ok()) << last[0].exit.text()
                                 << ": the process must end when the launcher closes the control pipe";
  EXPECT_FALSE(last[0].exit.shared);
}

TEST_F(SharedProcessTest, OnlyTheProgramThatCrashedTheProcessIsToBlame) {
  home(kReadTwo + R"(echo '{"ended": "b", "code": 0, "signal": 11, "fatal": true}' >&3; kill -SEGV $$)");
  const auto ends = ends_in(hear());
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_EQ(ends[0].program, "b");
  EXPECT_EQ(ends[0].exit.signal, 11);
  EXPECT_FALSE(ends[0].exit.dragged);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_TRUE(ends[i].exit.dragged && !ends[i].exit.ok()) << ends[i].program;
  }
}

TEST_F(SharedProcessTest, AnEndlessLogKeepsItsBeginningAndItsEnd) {
  const std::string log = log_of("a");
  home(kReadTwo + "echo first >>" + log + "; head -c 30000000 /dev/zero | tr '\\0' x >>" + log + "; echo >>" + log +
       R"(; echo '{"said_by": "a", "line": {}}' >&3; read line <&4; echo last >>)" + log + "; kill -KILL $$");
  hear("a");
  host_->wait(0ms);
  EXPECT_LE(std::filesystem::file_size(log), kMostLog) << "the limit also applies while the program runs";
  host_->send("a", "go");
  hear();
  EXPECT_EQ(last_lines(log, 1), std::vector<std::string>{"last"});
  const std::string text = read_text(log);
  EXPECT_LE(text.size(), kMostLog);
  EXPECT_TRUE(text.starts_with("first\n"));
  EXPECT_NE(text.find("\n[skein] the middle of this log was removed, because it has more than 2 MiB\n"),
            std::string::npos);
}

TEST_F(SharedProcessTest, ADeathThatNoProgramCausedIsReportedForTheProcess) {
  home(kReadTwo + "kill -KILL $$");
  const auto ends = ends_in(hear());
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_EQ(ends[0].program, "home");
  EXPECT_EQ(ends[0].exit.signal, 9);
  EXPECT_FALSE(ends[0].exit.dragged);
  for (const std::size_t i : {1U, 2U}) EXPECT_TRUE(ends[i].exit.dragged && !ends[i].exit.ok());
}

TEST_F(SharedProcessTest, SignalsAndLinesGoToOneProgram) {
  home(kReadTwo + R"(read s <&4; read t <&4
echo "{\"said_by\": \"a\", \"line\": $s}" >&3; echo "{\"said_by\": \"b\", \"line\": $t}" >&3
echo '{"stopped": "a"}' >&3; )" +
       kRest);
  host_->signal("a", SIGCONT);
  host_->send("b", "lost jurong");
  host_->send("nobody", "x");
  const auto events = hear("b");
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(parse_json(events[0].line), (Json{{"signal_to", "a"}, {"signal", SIGCONT}}));
  EXPECT_EQ(parse_json(events[1].line), (Json{{"tell", "b"}, {"line", "lost jurong"}}));
  for (int i = 0; i < 20 && !host_->has_stopped("a"); ++i) {
    host_->wait(50ms);
    if (i == 19) ADD_FAILURE() << "the stop of program a was not reported";
  }
  EXPECT_FALSE(host_->has_stopped("a")) << "each stop is reported once";
}

}  // namespace
}  // namespace skein::cli
