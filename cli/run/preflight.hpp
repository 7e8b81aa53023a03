// Everything that can be wrong is found before anything flies.
#pragma once

#include <functional>

#include "cli/run/fleet_plan.hpp"

namespace skein::cli {

/// The user pressed Ctrl-C before the fleet had started.
struct Interrupted {};

/// Is told whom we wait for, when that takes long.
using TellWaiting = std::function<void(const std::string&)>;

/// Runs programs that only validate, all at once, and waits for them.
/// @returns what they warn of, line by line.
/// @throws InputError with the message of the first program (in the order given) that ended with exit code 2;
///   std::runtime_error when one failed in another way; Interrupted.
std::vector<std::string> run_checks(const std::vector<ProgramSpec>& programs, const TellWaiting& tell = {});

/// Runs one program and waits for it. @throws Interrupted after ending it when the user pressed Ctrl-C.
ExitStatus run_to_end(const ProgramSpec& program);

/// Runs the program that does what a command is for. @returns its exit code, or that of a failed one for any odd end.
int hand_over(const ProgramSpec& program);

/// A folder for one purpose, removed with all that is in it: by this, or, should this process be killed, by the next
/// one that makes such a folder in the same place. Whoever lives holds a lock on his.
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
