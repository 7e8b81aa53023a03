#include "cli/run/results_dir.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "cli/planner_spec.hpp"
#include "core/types.hpp"
#include "process/files/atomic_file.hpp"
#include "process/files/closed_to_agents.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

/// Disk space for the result of a large fleet with all its links [bytes].
constexpr off_t kRoomForResult = 256 << 10;
/// The file that reserves this space. run_folder::is_of_a_run() accepts its name, so the next run deletes a stale one.
const std::string kRoom = std::string(run_folder::kResult) + ".tmp-room";

/// Deletes an earlier run's files. Links are removed, not their targets, and no file is opened: opening a named pipe
/// could block for ever.
void remove_stale(const std::filesystem::path& dir) {
  for (const auto& entry : std::filesystem::directory_iterator(dir)) {
    if (!run_folder::is_of_a_run(entry.path().filename())) continue;
    if (entry.symlink_status().type() != std::filesystem::file_type::directory) {
      std::filesystem::remove(entry.path());
    } else if (entry.path().filename() == run_folder::kPlannerFiles) {
      std::filesystem::remove_all(entry.path());
    } else if (entry.path().has_extension()) {
      throw InputError(entry.path().string() + ": a folder is in the way of a file that the run writes");
    }
  }
}

}  // namespace

std::filesystem::path default_results_dir(const std::string& scenario, const std::string& planner, std::uint64_t seed) {
  const auto name_of = [](const std::filesystem::path& agent) { return agent.filename().string(); };
  const std::string label = planner_label(with_agents_named(planner, name_of));
  return std::filesystem::path("runs") / (scenario + "-" + label + "-" + std::to_string(seed));
}

std::filesystem::path free_results_dir(const std::filesystem::path& base) {
  const auto is_free = [](const std::filesystem::path& dir) {
    std::error_code error;  // ignored: ResultsDir reports what cannot be read
    const auto kind = std::filesystem::symlink_status(dir, error).type();
    if (kind == std::filesystem::file_type::none || kind == std::filesystem::file_type::not_found) return true;
    return kind == std::filesystem::file_type::directory && std::filesystem::is_empty(dir, error) && !error;
  };
  std::filesystem::path dir = base;
  for (int number = 2; !is_free(dir); ++number) dir = base.string() + "-" + std::to_string(number);
  return dir;
}

std::filesystem::path results_dir_of(const RunOptions& run, const std::string& scenario) {
  if (run.out) return *run.out;
  const std::filesystem::path usual = default_results_dir(scenario, run.planner, run.seed);
  return run.force ? usual : free_results_dir(usual);
}

void ResultsDir::check(const std::filesystem::path& dir, bool force) {
  std::error_code error;  // e.g. the name is too long, or links form a circle
  const auto kind = std::filesystem::status(dir, error).type();
  if (kind == std::filesystem::file_type::none) {
    throw InputError("--out " + dir.string() + ": cannot be looked at (" + error.message() +
                     "); choose another folder");
  }
  if (kind != std::filesystem::file_type::directory && kind != std::filesystem::file_type::not_found) {
    throw InputError("--out " + dir.string() + ": is no folder");
  }
  if (!force && std::filesystem::exists(dir / run_folder::kResult, error)) {
    throw InputError(dir.string() + " holds a result already; overwrite it with --force, or choose another --out");
  }
}

ResultsDir::ResultsDir(const std::filesystem::path& dir, bool force) : path_(std::filesystem::absolute(dir)) {
  check(dir, force);
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (!error) lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (error || lock_ < 0 || ::access(path_.c_str(), W_OK) != 0) {
    throw InputError("--out " + dir.string() + ": cannot be written to");
  }
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    throw InputError(dir.string() + ": another run is writing there; choose another --out");
  }
  close_to_agents(path_);
  try {
    remove_stale(path_);
    keep_room();
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

ResultsDir::~ResultsDir() {
  give_room();
  ::close(lock_);
}

void ResultsDir::keep_room() const {
  const std::filesystem::path room = path_ / kRoom;
  const int file = ::open(room.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  const int reason = file < 0 ? errno : ::posix_fallocate(file, 0, kRoomForResult);
  if (file >= 0) ::close(file);
  if (reason != ENOSPC && reason != EDQUOT && reason != EFBIG) return;  // not every file system supports the call
  give_room();
  throw InputError("--out " + path_.string() + ": no room for a result there (" +
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
