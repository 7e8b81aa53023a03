#include "debug/debug_watch.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "host/proc_table.hpp"
#include "results/run_folder.hpp"

extern "C" {  // missing in glibc 2.36's header
#include <sys/pidfd.h>
}

namespace skein::cli {
namespace {

bool follows(const std::vector<std::string>& words, const std::string& option, const std::string& value) {
  const auto found = std::find(words.begin(), words.end(), option);
  return found != words.end() && found + 1 != words.end() && *(found + 1) == value;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A debugger must be recognised by its name, because it has the same environment as the command that it starts.
bool is_debugger(pid_t pid) {
  const std::string name = process_name(pid);
  for (const char* known : {"gdb", "gdbserver", "lldb", "lldb-server", "rr", "strace"}) {
    if (name == known) return true;
  }
  return false;
}

}  // namespace

DebugWatch::DebugWatch(Debuggee debuggee, std::filesystem::path out, std::filesystem::path file)
    : debuggee_(std::move(debuggee)), out_(std::move(out)), file_(file.filename()) {}

DebugWatch::~DebugWatch() {
  if (fd_ >= 0) ::close(fd_);
}

bool DebugWatch::appeared() {
  if (fd_ < 0) look();
  return fd_ >= 0 && !std::exchange(told_, true);
}

bool DebugWatch::ended() {
  if (fd_ < 0) look();
  if (fd_ < 0) return false;
  pollfd polled{fd_, POLLIN, 0};
  if (::poll(&polled, 1, 0) <= 0) return false;
  ::close(std::exchange(fd_, -1));
  return true;
}

void DebugWatch::await_end(std::chrono::milliseconds timeout) const {
  pollfd polled{fd_, POLLIN, 0};
  if (fd_ >= 0) ::poll(&polled, 1, static_cast<int>(timeout.count()));
}

void DebugWatch::look() {
  for (const pid_t pid : all_processes()) {
    if (!is_debugged(pid) || is_debugged(parent_of(pid))) continue;
    const int fd = ::pidfd_open(pid, 0);
    if (fd < 0) continue;
    if (!is_debugged(pid)) {  // it has ended, and another process may have its id
      ::close(fd);
      continue;
    }
    pid_ = pid;
    fd_ = fd;
    told_ = false;
    return;
  }
}

// The first word must be the program's file: a debugger's command line contains the same words after its own.
bool DebugWatch::is_agent_process(pid_t pid) const {
  const std::vector<std::string> words = words_of(pid, "cmdline");
  const bool ours = !words.empty() && std::filesystem::path(words[0]).filename() == file_;
  const bool same = !programs::is_agent(debuggee_.program) || follows(words, "--uav", debuggee_.member) ||
                    (debuggee_.program == programs::kGroundAgent && follows(words, "--role", "gcs"));
  return ours && same && follows(words, "--out", out_);
}

bool DebugWatch::is_command_process(pid_t pid) const {
  const std::vector<std::string> variables = words_of(pid, "environ");
  return holds(variables, "SKEIN_UAV=" + debuggee_.member) && holds(variables, "SKEIN_OUT=" + out_) &&
         !is_debugger(pid);
}

}  // namespace skein::cli
