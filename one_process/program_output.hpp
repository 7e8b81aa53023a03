// Where a program that shares its process writes: its own log takes what it logs, and all else that reaches stdout and
// stderr in its turns.   Threads: the one that works for all programs.
#pragma once

#include <filesystem>
#include <memory>
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
  /// @throws InputError for a level that is none (process/program.hpp).
  void set_log(const std::string& name, const std::string& level);

 private:
  int fd_ = -1;
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace skein::one_process
