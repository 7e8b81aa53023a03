#include "cli/secure/earlier_truth.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "process/files/closed_to_agents.hpp"
#include "process/files/user_cache.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// The entries of a folder except symbolic links; none if it cannot be listed.
std::vector<fs::path> listed(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!entry->is_symlink(error)) paths.push_back(entry->path());
  }
  return paths;
}

/// A run's files, or the flights of a study or a hunt.
bool holds_results(const fs::path& folder) {
  return std::ranges::any_of(listed(folder), [](const fs::path& path) {
    return run_folder::is_of_a_run(path.filename()) || path.filename() == "flights";
  });
}

}  // namespace

void close_earlier_truth(const fs::path& out) {
  for (const fs::path& folder : listed(fs::absolute(out).parent_path())) {
    if (holds_results(folder)) close_to_agents(folder);
  }
  const auto cache = user_cache_folder();
  if (!cache) return;
  for (const fs::path& file : listed(*cache)) {  // estimates, plans and points; what agents read is in its folders
    if (fs::is_regular_file(file)) close_to_agents(file);
  }
  for (const fs::path& grammar : listed(*cache / "worlds")) {
    for (const fs::path& world : listed(grammar)) close_to_agents(world / run_folder::kSceneFiles);
  }
}

}  // namespace skein::cli
