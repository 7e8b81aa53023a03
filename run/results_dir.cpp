#include "run/results_dir.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

#include "core/types.hpp"
#include "process/files/atomic_file.hpp"
#include "process/files/closed_to_agents.hpp"
#include "results/run_folder.hpp"
#include "run/planner_spec.hpp"

namespace skein::cli {
namespace {

/// Disk space for the result of a large fleet with all its links [bytes].
constexpr off_t kRoomForResult = 256 << 10;
/// The file that reserves this space. run_folder::is_of_a_run() accepts its name, so the next run deletes a stale one.
const std::string kRoom = std::string(run_folder::kResult) + ".tmp-room";

bool is_folder(const std::filesystem::directory_entry& entry) {
  return entry.symlink_status().type() == std::filesystem::file_type::directory;
}

/// Whether an entry of the results folder is in a run's way: the run would write to it, or delete it.
bool is_in_the_way(const std::filesystem::directory_entry& entry) {
  const std::filesystem::path name = entry.path().filename();
  if (!run_folder::is_of_a_run(name)) return false;
  return !is_folder(entry) || name == run_folder::kPlannerFiles || name.has_extension();
}

/// Deletes an earlier run's files. Links are removed, not their targets, and no file is opened: opening a named pipe
/// could block for ever.
void remove_stale(const std::filesystem::path& dir) {
  for (const auto& entry : std::filesystem::directory_iterator(dir)) {
    if (!is_in_the_way(entry)) continue;
    if (!is_folder(entry)) {
      std::filesystem::remove(entry.path());
    } else if (entry.path().filename() == run_folder::kPlannerFiles) {
      std::filesystem::remove_all(entry.path());
    } else {
      throw InputError(entry.path().string() + ": a folder is in the way of a file that the run writes");
    }
  }
}

void check_kind(const std::filesystem::path& dir) {
  std::error_code error;  // e.g. the name is too long, or links form a circle
  const auto kind = std::filesystem::status(dir, error).type();
  if (kind == std::filesystem::file_type::none) {
    throw InputError("--out " + dir.string() + ": cannot be read (" + error.message() + "); choose another folder");
  }
  if (kind != std::filesystem::file_type::directory && kind != std::filesystem::file_type::not_found) {
    throw InputError("--out " + dir.string() + ": is not a folder");
  }
}

/// Without --force, a run neither overwrites nor deletes a file, no matter which program wrote it. @throws InputError
void check_nothing_in_the_way(const std::filesystem::path& dir) {
  const auto refuse = [&](const std::string& what, const std::string& lose) {
    throw InputError(dir.string() + " holds " + what + "; " + lose + " it with --force, or choose another --out");
  };
  std::error_code error;  // ignored: the constructor reports what cannot be read
  if (std::filesystem::exists(dir / run_folder::kResult, error)) refuse("a result already", "overwrite");
  std::string first;  // the least name, so that the message does not depend on the order in the folder
  for (std::filesystem::directory_iterator entry(dir, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (is_in_the_way(*entry) && (first.empty() || name < first)) first = name;
  }
  if (!first.empty()) refuse("'" + first + "', a name that a run uses for files of its own", "delete");
}

int open_folder(const std::filesystem::path& dir) { return ::open(dir.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }

/// Whether a run holds the lock of this folder now. To find out, this function takes the lock for a moment, shared:
/// take_lock() does not mistake that for a run.
bool is_held(const std::filesystem::path& dir) {
  const int folder = open_folder(dir);
  if (folder < 0) return false;
  const bool held = ::flock(folder, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(folder);
  return held;
}

/// Takes the lock of an open folder for a run. @returns 0, or the reason: EWOULDBLOCK if another run holds it.
int take_lock(int folder) {
  // A shared lock can be had beside the momentary ones of is_held(), but not beside that of a run. Each try takes about
  // a microsecond, so all of them last longer than is_held() does even when it is preempted.
  constexpr int kMostTries = 100'000;
  for (int i = 0; i < kMostTries; ++i) {
    if (::flock(folder, LOCK_EX | LOCK_NB) == 0) return 0;
    if (errno != EWOULDBLOCK || ::flock(folder, LOCK_SH | LOCK_NB) != 0) return errno;
    ::flock(folder, LOCK_UN);
    std::this_thread::yield();
  }
  return EWOULDBLOCK;
}

[[noreturn]] void tell_of_another_run(const std::filesystem::path& dir) {
  throw FolderInUse(dir.string() + ": another run is writing there; choose another --out");
}

/// Whether a run may take this name if the user names no folder: nothing is there, or an empty folder.
bool is_free(const std::filesystem::path& dir) {
  std::error_code error;  // ignored: ResultsDir reports what cannot be read
  const auto kind = std::filesystem::symlink_status(dir, error).type();
  if (kind == std::filesystem::file_type::none || kind == std::filesystem::file_type::not_found) return true;
  return kind == std::filesystem::file_type::directory && std::filesystem::is_empty(dir, error) && !error;
}

/// `base`, `base`-2, `base`-3, ...
std::filesystem::path numbered_dir(const std::filesystem::path& base, int number) {
  return number == 1 ? base : std::filesystem::path(base.string() + "-" + std::to_string(number));
}

std::filesystem::path usual_dir_of(const RunOptions& run, const std::string& scenario) {
  return run.usual_out.value_or(default_results_dir(scenario, run.planner, run.seed));
}

/// Whether a file is a log, on which no results depend.
bool is_log(const std::filesystem::path& file) {
  struct stat entry {};
  if (::lstat(file.c_str(), &entry) != 0 || !S_ISREG(entry.st_mode)) return false;
  const auto is_printed_to = [&](int fd) {
    struct stat printed {};
    return ::fstat(fd, &printed) == 0 && printed.st_dev == entry.st_dev && printed.st_ino == entry.st_ino;
  };
  const std::filesystem::path extension = file.extension();
  return extension == ".log" || extension == ".out" || extension == ".err" || is_printed_to(STDOUT_FILENO) ||
         is_printed_to(STDERR_FILENO);
}

}  // namespace

std::filesystem::path default_results_dir(const std::string& scenario, const std::string& planner, std::uint64_t seed) {
  const auto name_of = [](const std::filesystem::path& agent) { return agent.filename().string(); };
  const std::string label = planner_label(with_agents_named(planner, name_of));
  return std::filesystem::path("runs") / (scenario + "-" + label + "-" + std::to_string(seed));
}

std::filesystem::path free_results_dir(const std::filesystem::path& base) {
  int number = 1;
  while (!is_free(numbered_dir(base, number))) ++number;
  return numbered_dir(base, number);
}

std::filesystem::path results_dir_of(const RunOptions& run, const std::string& scenario) {
  if (run.out) return *run.out;
  const std::filesystem::path usual = usual_dir_of(run, scenario);
  return run.force ? usual : free_results_dir(usual);
}

std::error_code make_results_folder(const std::filesystem::path& dir) {
  std::error_code error;
  if (std::filesystem::is_directory(dir, error)) return {};
  std::filesystem::create_directories(dir, error);
  if (!error) close_to_agents(dir);
  return error;
}

std::string foreign_entry(const std::filesystem::path& dir) {
  std::string first;  // the least name, so that messages do not depend on the order in the folder
  std::error_code error;
  for (std::filesystem::directory_iterator entry(dir, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (name.starts_with('.') || name == "lost+found" || name == kRoom || is_log(entry->path())) continue;
    if (first.empty() || name < first) first = name;
  }
  return first;
}

void ResultsDir::check(const std::filesystem::path& dir, bool force) {
  check_kind(dir);
  if (force) return;
  try {
    check_nothing_in_the_way(dir);
  } catch (const InputError&) {
    if (is_held(dir)) tell_of_another_run(dir);
    throw;
  }
}

FolderLock::FolderLock(const std::filesystem::path& dir) : folder_(open_folder(dir)) {
  const int reason = folder_ < 0 ? errno : take_lock(folder_);
  if (reason == 0) return;
  if (folder_ >= 0) ::close(folder_);
  if (reason == EWOULDBLOCK) tell_of_another_run(dir);
  throw InputError(dir.string() + ": cannot be locked (" + std::generic_category().message(reason) +
                   "); choose another folder");
}

FolderLock::~FolderLock() { ::close(folder_); }

ResultsDir::ResultsDir(const std::filesystem::path& dir, Earlier earlier)
    : given_(dir), path_(std::filesystem::absolute(dir)) {
  check_kind(dir);
  if (make_results_folder(path_) || ::access(path_.c_str(), R_OK | W_OK) != 0) {
    throw InputError("--out " + dir.string() + ": cannot be written to");
  }
  lock_.emplace(dir);
  if (earlier == Earlier::refuse) check_nothing_in_the_way(dir);
  if (earlier == Earlier::remove) remove_stale(path_);
  keep_room();
}

std::unique_ptr<ResultsDir> ResultsDir::take(const RunOptions& run, const std::string& scenario) {
  if (run.out || run.force) return std::make_unique<ResultsDir>(results_dir_of(run, scenario), run.force);
  return take_free(usual_dir_of(run, scenario));
}

std::unique_ptr<ResultsDir> ResultsDir::take_for_flights(const std::optional<std::filesystem::path>& out,
                                                         const std::filesystem::path& usual, bool force) {
  if (!out && !force) return take_free(usual);
  auto dir = std::make_unique<ResultsDir>(out.value_or(usual), Earlier::keep);
  const std::string first = force ? "" : foreign_entry(dir->path());
  if (first.empty()) return dir;
  throw InputError("--out " + dir->given().string() + ": '" + first +
                   "' exists already; choose another --out, or use this folder anyway with --force");
}

std::unique_ptr<ResultsDir> ResultsDir::take_free(const std::filesystem::path& base) {
  for (int number = 1;; ++number) {
    if (!is_free(numbered_dir(base, number))) continue;
    try {
      return std::make_unique<ResultsDir>(numbered_dir(base, number), false);
    } catch (const FolderInUse&) {  // another run has taken it just now
    }
  }
}

void ResultsDir::keep_room() const {
  const std::filesystem::path room = path_ / kRoom;
  const int file = ::open(room.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  const int reason = file < 0 ? errno : ::posix_fallocate(file, 0, kRoomForResult);
  if (file >= 0) ::close(file);
  if (reason != ENOSPC && reason != EDQUOT && reason != EFBIG) return;  // not every file system supports the call
  give_room();
  throw InputError("--out " + path_.string() + ": the disk has no room for a result (" +
                   std::generic_category().message(reason) + "); choose another folder");
}

void ResultsDir::give_room() const {
  std::error_code ignored;
  std::filesystem::remove(path_ / kRoom, ignored);
}

std::string ResultsDir::write_result(const std::string& text) const {
  give_room();
  return write_if_possible(path_ / run_folder::kResult, text);
}

}  // namespace skein::cli
