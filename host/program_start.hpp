// Starts a child process, from fork to exec: sets up its file descriptors, user and minder, and reports errors to the
// launcher. Linux.   Threads: one, which must live as long as the programs: when it ends, the kernel kills them
// (PR_SET_PDEATHSIG).
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <utility>

#include "host/supervisor.hpp"

namespace skein::cli {

/// Owns a file descriptor, and closes it in its destructor.
class Fd {
 public:
  Fd() = default;
  explicit Fd(int fd) : fd_(fd) {}
  Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Fd& operator=(Fd&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Fd() { reset(); }
  int get() const { return fd_; }
  void reset() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }

 private:
  int fd_ = -1;
};

/// @throws std::system_error for the current value of errno. @param what  begins its message.
[[noreturn]] void throw_errno(const std::string& what);

struct StartedProgram {
  pid_t pid = -1;           ///< the launcher's child: the program, or its minder
  pid_t program = -1;       ///< process id of the program, which leads a process group of its own
  bool foreground = false;  ///< the program's group has the terminal, which the launcher had before
  Fd pidfd;                 ///< of `pid`
  Fd status, control;       ///< the launcher's ends of the pipes, non-blocking
  Fd log;  ///< file to which the program appends; none: the program has the launcher's stdout and stderr
};

/// Whether stdin is a terminal whose foreground process group is the launcher's.
bool owns_terminal();
/// Makes `group` the terminal's foreground process group: from then on, it receives Ctrl-C and what the user types.
void give_terminal_to(pid_t group);

/// For a child between fork and exec: unblocks all signals, and gives each its default action, also those that the
/// shell ignored.
void reset_signals();

/// Starts a program in a process group of its own, with a status and a control pipe. Its stdin is /dev/null, or that of
/// the launcher (ProgramSpec::here).
/// @throws std::system_error if the log cannot be opened, or the binary cannot be started or watched.
StartedProgram start_program(const ProgramSpec& spec);

/// Sends a signal to a program's process group. A minder that has stopped with its program goes on after SIGCONT and
/// SIGKILL.
void signal_program(const StartedProgram& program, int signal);

}  // namespace skein::cli
