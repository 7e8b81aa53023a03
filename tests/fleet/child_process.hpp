// A program started by a test: its output goes to files, and it never outlives the test.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/eventually.hpp"

namespace skein::test {

using Arguments = std::vector<std::string>;
inline Arguments joined(Arguments words, const Arguments& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}
/// Variables that are set on top of the test's own environment.
using Environment = std::map<std::string, std::string>;

std::string text_of(const std::filesystem::path& file);

struct ExitStatus {
  int code = -1;   ///< -1 when a signal ended it
  int signal = 0;  ///< 0 unless a signal ended it
};

/// Timeout for scripts that examine pages in a browser. The browser renders on the same cores, which takes minutes on a
/// busy machine. A script says on stderr what it waits for.
inline constexpr std::chrono::seconds kBrowserPatience{600};

/// Runs from construction on, in a process group of its own. Destruction kills the group; the kernel kills the process
/// when the test dies.   Threads: one, which must outlive this.
class ChildProcess {
 public:
  /// @param argv  argv[0] is the path of the binary. @throws std::runtime_error when it cannot be started.
  ChildProcess(const Arguments& argv, const Environment& environment, std::filesystem::path out,
               std::filesystem::path err);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  void signal(int signal) const;
  /// @returns nullopt while the process runs.
  std::optional<ExitStatus> ended();
  /// @throws std::runtime_error when the process has not ended within `patience`.
  ExitStatus wait(std::chrono::seconds patience = kPatience);
  /// The output so far.
  std::string out() const { return text_of(out_); }
  std::string err() const { return text_of(err_); }

 private:
  pid_t pid_ = -1;
  std::filesystem::path out_, err_;
  std::optional<ExitStatus> exit_;
};

}  // namespace skein::test
