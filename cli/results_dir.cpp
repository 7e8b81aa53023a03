#include "cli/results_dir.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <set>

#include "cli/planner_spec.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

bool written_by_a_run(const std::string& name) {
  static const std::set<std::string> kNames = {
      "result.json",          "score.csv",        "captures.csv",       "digests.csv", "losses.csv", "events.csv",
      "capture_messages.csv", "trajectories.csv", "score_timeline.csv", "scene.json",  "report.html"};
  const bool of_a_program = name.starts_with("sim_server.") || name.starts_with("comm_router.") ||
                            name.starts_with("station.") || name.starts_with("uav_agent-");
  const bool of_its_files = name.ends_with(".report.json") || name.ends_with(".journal") || name.ends_with(".log");
  return kNames.contains(name) || (of_a_program && of_its_files);
}

}  // namespace

std::filesystem::path default_results_dir(const std::string& scenario, const std::string& planner, std::uint64_t seed) {
  return std::filesystem::path("runs") / (scenario + "-" + planner_label(planner) + "-" + std::to_string(seed));
}

void ResultsDir::check(const std::filesystem::path& dir, bool force) {
  if (std::filesystem::exists(dir) && !std::filesystem::is_directory(dir)) {
    throw InputError("--out " + dir.string() + ": is no folder");
  }
  if (!force && std::filesystem::exists(dir / "result.json")) {
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
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    if (entry.is_regular_file() && written_by_a_run(entry.path().filename())) std::filesystem::remove(entry.path());
  }
}

ResultsDir::~ResultsDir() { ::close(lock_); }

}  // namespace skein::cli
