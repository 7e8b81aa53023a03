// At a terminal: the debugger gets the input, Ctrl-C stops only the debugged program, Ctrl-Z stops debugger and fleet.
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include "debug_fixture.hpp"

namespace skein::test {
namespace {

/// A shell with its own terminal.
class Terminal {
 public:
  Terminal() {
    pid_ = ::forkpty(&fd_, nullptr, nullptr, nullptr);
    if (pid_ == 0) {
      ::execl("/bin/bash", "bash", "--norc", "--noprofile", "-i", nullptr);
      ::_exit(127);
    }
  }
  ~Terminal() {
    ::close(fd_);  // sends SIGHUP to the remaining processes
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void type(const std::string& text) {
    ASSERT_EQ(::write(fd_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  /// Waits until the terminal shows `part`, after the part that the call before found. @returns whether it does
  bool shows(const std::string& part) {
    return eventually([&] {
      pollfd polled{fd_, POLLIN, 0};
      char buffer[4096];
      if (::poll(&polled, 1, 20) > 0) {
        const ssize_t size = ::read(fd_, buffer, sizeof buffer);
        if (size > 0) text_.append(buffer, static_cast<std::size_t>(size));
      }
      const std::size_t at = text_.find(part, seen_);
      if (at != std::string::npos) seen_ = at + part.size();
      return at != std::string::npos;
    });
  }
  const std::string& text() const { return text_; }

 private:
  int fd_ = -1;
  pid_t pid_ = -1;
  std::string text_;
  std::size_t seen_ = 0;
};

class AtATerminal : public DebugTest {};

TEST_F(AtATerminal, TheDebuggerGetsTheKeys) {
  SKEIN_NEEDS_GDB();
  Terminal terminal;
  const auto see = [&](const std::string& part) {
    ASSERT_TRUE(terminal.shows(part)) << part << " in\n" << terminal.text();
  };
  terminal.type("TERM=dumb " + program("skein") + " run " + scenario_ +
                " --planner patrol --duration 30 --no-oracle --out " + dir("run").string() + " --debug changi\n");
  see("changi is in gdb here");
  see("(gdb) ");
  terminal.type("\x1a");  // Ctrl-Z
  see("Stopped");
  terminal.type("fg\n");
  see("run");
  terminal.type("tbreak skein::agent::PatrolPlanner::plan\nrun\n");
  see("Temporary breakpoint 1, ");
  terminal.type("continue\n");
  see("Continuing.");
  terminal.type("\x03");  // Ctrl-C
  see("received signal SIGINT");
  see("(gdb) ");
  EXPECT_EQ(processes_of(dir("run")).size(), 6u) << "the launcher and its five programs";
  terminal.type("continue\n");
  see("exited normally]");
  see("(gdb) ");
  terminal.type("quit\n");
  see("status    completed");
  terminal.type("echo code $?\n");
  see("code 0");
  EXPECT_TRUE(result("run")["lost_members"].empty());
}

}  // namespace
}  // namespace skein::test
