// A child process from fork to exec: its descriptors, its user, its minder, and the news whether all that went well.
// Linux.   Threads: one, which must live as long as the programs (PR_SET_PDEATHSIG goes by thread).
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <utility>

#include "cli/host/supervisor.hpp"

namespace skein::cli {

/// A file descriptor that closes itself.
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

/// @throws std::system_error with errno's reason.
[[noreturn]] void throw_errno(const std::string& what);

struct StartedProgram {
  pid_t pid = -1;           ///< our child: the program, or its minder
  pid_t program = -1;       ///< leads a process group
  bool foreground = false;  ///< of the terminal, which was ours
  Fd pidfd;                 ///< of `pid`
  Fd status, control;       ///< our ends of the pipes, which never block
  Fd log;                   ///< where the program appends; none when it has our own output
};

/// Whether what is typed comes to us.
bool owns_terminal();
/// From here on Ctrl-C and what is typed are for that process group.
void give_terminal_to(pid_t group);

/// Starts a program in a process group of its own, both pipes open, stdin closed unless it is to have the terminal.
/// @throws std::system_error when the log cannot be written or the binary cannot be started.
StartedProgram start_program(const ProgramSpec& spec);

}  // namespace skein::cli
