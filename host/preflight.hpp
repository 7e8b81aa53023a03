// Checks before a run: lets programs validate their input, and runs helper programs to their end.
// Threads: the launcher's one.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/program_host.hpp"

namespace skein::cli {

/// The user pressed Ctrl-C before the fleet had started.
struct Interrupted {};

/// Receives a message about the programs that the launcher waits for, if that takes long.
using TellWaiting = std::function<void(const std::string&)>;

/// Runs programs that only validate (--check), all at once, and waits for them.
/// @returns their warnings, a line each.
/// @throws InputError with the message of the first program (in the order given) that ended with exit code 2;
///   std::runtime_error when one failed in another way; Interrupted.
std::vector<std::string> run_checks(const std::vector<ProgramSpec>& programs, const TellWaiting& tell = {});

/// Runs one program and waits for its end. If the user presses Ctrl-C, ends it and throws Interrupted.
ExitStatus run_to_end(const ProgramSpec& program);

/// The same, but kills a program that has not ended within the limit, and returns nullopt then.
std::optional<ExitStatus> run_within(const ProgramSpec& program, std::chrono::milliseconds limit);

/// Runs the program that does a command's work. @returns the command's exit code: that of the program, or
/// kExitProcessFailed if a signal ended it or its code is not one of 0 to kExitBadInput. @throws Interrupted.
int hand_over(const ProgramSpec& program);

/// A temporary folder. The destructor deletes it with its contents. If this process is killed, the next process that
/// creates such a folder in the same place deletes it: each living process holds a lock on its folder.
class ScratchDir {
 public:
  /// @throws InputError when no folder can be made under TMPDIR.
  ScratchDir();
  ~ScratchDir();
  ScratchDir(const ScratchDir&) = delete;
  ScratchDir& operator=(const ScratchDir&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace skein::cli
