#include "host/preflight.hpp"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <stdexcept>

#include "core/run/wait_notice.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "host/supervisor.hpp"
#include "process/log_lines.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kMessageLines = 20;
constexpr std::chrono::milliseconds kCheckGrace{2000};

std::string message_of(const ProgramSpec& program) {
  std::string text;
  for (const std::string& line : last_lines(program.log, kMessageLines)) text += (text.empty() ? "" : "\n") + line;
  return text;
}

/// Runs programs side by side until the last has ended, or until the deadline, and then kills the others.
/// @returns how each program ended that did so in time
std::map<std::string, ExitStatus> run_all(const std::vector<ProgramSpec>& programs, const TellWaiting& tell,
                                          std::optional<WaitNotice::Clock::time_point> deadline = {}) {
  Supervisor supervisor;  // its destructor kills the programs that still run
  for (const ProgramSpec& program : programs) supervisor.start(program);
  std::map<std::string, ExitStatus> exits;
  WaitNotice notice(WaitNotice::Clock::now());
  while (!supervisor.running().empty() && (!deadline || WaitNotice::Clock::now() < *deadline)) {
    const auto waited_s = notice.due(WaitNotice::Clock::now());
    if (tell && waited_s) {
      tell(fmt::format("waiting for {} to check its input ({:.0f} s)", joined(supervisor.running()), *waited_s));
    }
    std::chrono::milliseconds left = notice.left(WaitNotice::Clock::now());
    if (deadline) {
      const auto until = std::chrono::ceil<std::chrono::milliseconds>(*deadline - WaitNotice::Clock::now());
      left = std::clamp(until, std::chrono::milliseconds(0), left);
    }
    for (const Event& event : supervisor.wait(left)) {
      if (event.kind == Event::Kind::interrupt) {
        supervisor.end_all(kCheckGrace);
        throw Interrupted{};
      }
      if (event.kind == Event::Kind::exited) exits[event.program] = event.exit;
    }
  }
  return exits;
}

/// Beginning of the names of ScratchDir's folders, by which remove_orphans() recognises them.
constexpr const char* kScratch = "skein-scratch-";

/// Locks a scratch folder for as long as the returned descriptor is open. @returns -1 if the folder belongs to another
/// user, if another process holds the lock (with LOCK_NB), or if the folder is gone meanwhile.
int lock_folder(const std::filesystem::path& folder, int how) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat locked {
  }, named{};
  if (fd >= 0 && ::flock(fd, how) == 0 && ::fstat(fd, &locked) == 0 && locked.st_uid == ::geteuid() &&
      ::lstat(folder.c_str(), &named) == 0 && named.st_ino == locked.st_ino && named.st_dev == locked.st_dev) {
    return fd;
  }
  if (fd >= 0) ::close(fd);
  return -1;
}

/// Deletes the folders that killed processes left: no process holds their locks.
void remove_orphans(const std::filesystem::path& where) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(where, error), end; !error && entry != end; entry.increment(error)) {
    if (!entry->path().filename().string().starts_with(kScratch)) continue;
    const int lock = lock_folder(entry->path(), LOCK_EX | LOCK_NB);
    if (lock < 0) continue;
    std::error_code ignored;
    std::filesystem::remove_all(entry->path(), ignored);
    ::close(lock);
  }
}

}  // namespace

std::vector<std::string> run_checks(const std::vector<ProgramSpec>& programs, const TellWaiting& tell) {
  const std::map<std::string, ExitStatus> exits = run_all(programs, tell);
  std::vector<std::string> warnings;
  for (const ProgramSpec& program : programs) {
    const ExitStatus& exit = exits.at(program.name);
    if (exit.code == kExitBadInput) throw InputError(message_of(program));
    if (!exit.ok()) {
      throw std::runtime_error(program.name + " --check ended with " + exit.text() + "\n" + message_of(program));
    }
    for (std::string& line : last_lines(program.log, kMessageLines)) {
      if (log_lines::is_warning(line)) warnings.push_back(std::move(line));
    }
  }
  return warnings;
}

int hand_over(const ProgramSpec& program) {
  const ExitStatus exit = run_to_end(program);
  return exit.signal == 0 && exit.code <= kExitBadInput ? exit.code : kExitProcessFailed;
}

ExitStatus run_to_end(const ProgramSpec& program) { return run_all({program}, {}).at(program.name); }

std::optional<ExitStatus> run_within(const ProgramSpec& program, std::chrono::milliseconds limit) {
  const std::map<std::string, ExitStatus> exits = run_all({program}, {}, WaitNotice::Clock::now() + limit);
  return exits.empty() ? std::nullopt : std::optional(exits.at(program.name));
}

ScratchDir::ScratchDir() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) remove_orphans(folder);
  constexpr int kTries = 100;
  for (int tries = 0; lock_ < 0; ++tries) {
    std::string name = folder / (std::string(kScratch) + "XXXXXX");
    if (error || tries == kTries || ::mkdtemp(name.data()) == nullptr) {
      const char* named = std::getenv("TMPDIR");
      throw InputError(std::string("TMPDIR") + (named ? std::string("=") + named : " (not set: /tmp)") +
                       ": must be a folder in which files can be made");
    }
    path_ = name;
    lock_ = lock_folder(path_, LOCK_EX);  // -1: another process took the folder for an orphan
  }
}

ScratchDir::~ScratchDir() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  ::close(lock_);
}

}  // namespace skein::cli
