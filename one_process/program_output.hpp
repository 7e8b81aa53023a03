// Output of a program that shares its process with others: its log gets the program's log lines, and all output to
// stdout and stderr in its turns. In a turn that a program has alone, descriptors 1 and 2 lead to its log, too. In
// turns that run in parallel, the streams of C++ and C write to the log of the calling thread's program; output that is
// written to descriptor 1 or 2 directly then goes to the log of the process.
// Threads: enter_beside() and leave_beside() from any; all others from the main thread, which runs the rounds.
#pragma once

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

namespace spdlog {
class logger;
}

namespace skein::one_process {

class ProgramOutput {
 public:
  /// @param file  the log; empty: the program writes where its process does.
  /// @throws std::system_error when the file cannot be opened.
  ProgramOutput(const std::filesystem::path& file, bool append);
  ~ProgramOutput();
  ProgramOutput(const ProgramOutput&) = delete;
  ProgramOutput& operator=(const ProgramOutput&) = delete;

  /// Begins a turn alone: from now on all output of the process goes to this program's log.
  void enter();
  /// Begins a turn in parallel: this thread's output to streams goes to this program's log until leave_beside().
  void enter_beside() const;
  static void leave_beside();
  /// The program output that this thread writes to; null: that of the process.
  static const ProgramOutput* here();

  /// From now on, for good, streams and logs choose their destination by the calling thread. Call it once, before there
  /// are other threads. @param out  the C++ stream for stdout. @throws std::system_error
  static void lead_by_thread(std::ostream& out);
  /// Gives the descriptors back to the process, and also the output of threads that work for no program. Call it after
  /// lead_by_thread(), before turns in parallel.
  static void stand_aside();

  /// @throws InputError for an unknown level (process/program.hpp).
  void set_log(const std::string& name, const std::string& level);
  /// Descriptor of the log. @returns -1: the program has no log file of its own.
  int descriptor() const { return fd_; }
  /// @returns nullptr before set_log().
  spdlog::logger* log() const { return log_.get(); }

 private:
  int fd_ = -1;
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace skein::one_process
