// Where a program that shares its process writes: its own log takes what it logs, and all else that reaches stdout and
// stderr in its turns. A program that has the process to itself has its descriptors, too. Where several have their
// turns side by side, streams of C++ and of C lead each thread to its own program's log; what somebody then writes to
// descriptor 1 or 2 past them goes to the log of the process.
// Threads: enter_beside() and leave_beside() from any; the rest from the one that works for all programs.
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
  /// @param file  empty: it writes where its process does. @throws std::system_error when the file cannot be opened.
  ProgramOutput(const std::filesystem::path& file, bool append);
  ~ProgramOutput();
  ProgramOutput(const ProgramOutput&) = delete;
  ProgramOutput& operator=(const ProgramOutput&) = delete;

  /// From here on all that is written goes there.
  void enter();
  /// From here on what this thread writes through streams goes there, until it calls leave_beside().
  void enter_beside() const;
  static void leave_beside();
  /// Whose output this thread's is; null: the process's.
  static const ProgramOutput* here();

  /// Streams and logs are led by threads from here on, for good. Once, before there are other threads.
  /// @param out  of C++, for stdout.
  static void lead_by_thread(std::ostream& out);
  /// The descriptors, and what threads write that work for nobody, are the process's again. After lead_by_thread().
  static void stand_aside();

  /// @throws InputError for a level that is none (process/program.hpp).
  void set_log(const std::string& name, const std::string& level);
  /// @returns -1: it has no file of its own.
  int descriptor() const { return fd_; }
  /// null before set_log().
  spdlog::logger* log() const { return log_.get(); }

 private:
  int fd_ = -1;
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace skein::one_process
