// A program that a command talks to over two pipes, bytes both ways: the browser that draws a film, the encoder that
// keeps it. Its process group, and whatever it starts, ends with this object, and with this process, however that ends.
// Threads: one, which must live as long as the program.
#pragma once

#include <chrono>
#include <csignal>
#include <string>
#include <string_view>

#include "cli/run/program_host.hpp"
#include "cli/run/program_start.hpp"

namespace skein::cli {

/// From construction to destruction Ctrl-C and the like (interrupt_signals()) wait to be looked at, and SIGPIPE is
/// ignored.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// Readable when one of them came.
  int fd() const { return fd_.get(); }

 private:
  Fd fd_;
  sigset_t former_mask_{};
  struct sigaction former_pipe_action_ {};
};

class PipedProgram {
 public:
  /// It writes to descriptor kStatusFd and reads from kControlFd. @param signals  must outlive this.
  /// @throws std::system_error when it cannot be started.
  PipedProgram(const ProgramSpec& spec, const HeldSignals& signals);
  /// Ends it at once.
  ~PipedProgram();
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;

  /// Waits until it has taken all of that. @throws Interrupted; std::runtime_error when it does not read any more.
  void write(std::string_view bytes);
  /// Waits for some bytes. @throws Interrupted; std::runtime_error when it has ended, or says nothing for long.
  std::string read();
  /// There is no more for it: waits until it has ended. @returns how. @throws Interrupted; std::runtime_error.
  ExitStatus finish();

 private:
  /// @throws Interrupted; std::runtime_error after a long time.
  void wait_for(int fd, short events) const;
  std::string last_words() const;

  const ProgramSpec spec_;
  const HeldSignals& signals_;
  StartedProgram program_;
};

}  // namespace skein::cli
