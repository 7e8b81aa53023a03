// A program with which a command exchanges bytes over two pipes: the browser that draws a film, the encoder that saves
// it. Its process group, and all that it has started, ends with this object, or when this process ends in any way.
// Threads: one, which must live as long as the program.
#pragma once

#include <chrono>
#include <csignal>
#include <string>
#include <string_view>

#include "host/program_host.hpp"
#include "host/program_start.hpp"

namespace skein::cli {

/// From construction to destruction, Ctrl-C and similar signals (interrupt_signals()) only make fd() readable, and this
/// process ignores SIGPIPE.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// Readable when one of these signals has arrived.
  int fd() const { return fd_.get(); }

 private:
  Fd fd_;
  sigset_t former_mask_{};
  struct sigaction former_pipe_action_ {};
};

class PipedProgram {
 public:
  /// The program writes to descriptor kStatusFd and reads from kControlFd. @param signals  must outlive this.
  /// @throws std::system_error when the program cannot be started.
  PipedProgram(const ProgramSpec& spec, const HeldSignals& signals);
  /// Kills the program at once.
  ~PipedProgram();
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;

  /// Waits until the program has taken all bytes. @throws Interrupted; std::runtime_error when it no longer reads.
  void write(std::string_view bytes);
  /// Waits for bytes. @throws Interrupted; std::runtime_error when the program has ended, or is silent for too long.
  std::string read();
  /// Closes the program's input, waits for its end. @returns how it ended. @throws Interrupted; std::runtime_error.
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
