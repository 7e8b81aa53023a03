#include "run/python_planners.hpp"

#include <algorithm>
#include <map>

#include "core/files/file_bytes.hpp"
#include "core/planners/python_spec.hpp"
#include "core/text/sha256.hpp"
#include "core/types.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSources = 100;
constexpr std::uintmax_t kLargestSource = 1'000'000;

/// Adds the modules in a folder and in its subfolders that are packages. @returns false when there are too many.
bool add_sources(const fs::path& folder, std::vector<fs::path>& sources) {
  std::vector<fs::path> entries;
  std::error_code none;
  for (fs::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none)) {
    if (entries.size() == 10 * kMostSources) return false;
    entries.push_back(entry->path());
  }
  std::ranges::sort(entries);
  for (const fs::path& entry : entries) {
    if (fs::is_symlink(entry, none) && fs::is_directory(entry, none)) continue;
    if (fs::is_regular_file(entry / "__init__.py", none)) {
      if (!add_sources(entry, sources)) return false;
    } else if (entry.extension() == ".py" && fs::is_regular_file(entry, none) &&
               fs::file_size(entry, none) <= kLargestSource) {
      sources.push_back(entry);
      if (sources.size() > kMostSources) return false;
    }
  }
  return true;
}

void make_absolute(UavPlanner& planner) {
  auto python = python_spec(planner.spec);
  if (!python) return;
  python->file = fs::absolute(python->file).lexically_normal();
  if (!fs::is_regular_file(python->file)) {
    throw InputError("--planner " + written(planner) + ": there is no file " + python->file.string());
  }
  planner.spec = text_of(*python);
}

}  // namespace

void find_python_files(Planners& planners) {
  make_absolute(planners.fallback);
  for (UavPlanner& planner : planners.uavs) make_absolute(planner);
  if (!planners.ground || !python_spec(planners.ground->spec)) return;
  throw InputError("--planner gcs=" + written(*planners.ground) +
                   ": at the ground station flies no planner; a program of your own there is gcs=exec:CMD");
}

std::vector<fs::path> python_sources(const fs::path& file) {
  std::vector<fs::path> sources;
  if (!add_sources(file.parent_path(), sources)) sources.clear();
  std::erase(sources, file);
  sources.insert(sources.begin(), file);
  return sources;
}

std::string python_digest(const fs::path& file) {
  Sha256 hash;
  for (const fs::path& source : python_sources(file)) {
    hash.add(source.lexically_relative(file.parent_path()).string() + '\n');
    hash.add(read_file_bytes(source, kLargestSource));
  }
  return hash.hex();
}

Json keep_python_files(const std::vector<UavPlanner>& planners, const fs::path& run,
                       std::vector<std::string>& warnings) try {
  Json kept = Json::array();
  for (const UavPlanner& planner : planners) {
    const auto python = python_spec(planner.spec);
    const auto is_it = [&](const Json& one) { return one["file"] == python->file.string(); };
    if (!python || std::ranges::any_of(kept, is_it)) continue;
    const fs::path below = fs::path(run_folder::kPlannerFiles) / std::to_string(kept.size() + 1);
    for (const fs::path& source : python_sources(python->file)) {
      const fs::path copy = run / below / source.lexically_relative(python->file.parent_path());
      fs::create_directories(copy.parent_path());
      fs::copy_file(source, copy, fs::copy_options::overwrite_existing);
    }
    kept.push_back({{"file", python->file.string()},
                    {"kept", below / python->file.filename()},
                    {"sha256", python_digest(python->file)}});
  }
  return kept;
} catch (const std::exception& error) {
  warnings.push_back(std::string("planners in Python were not kept: ") + error.what());
  return Json::array();
}

std::string with_python_files_of(const std::string& text, const std::vector<std::string>& fleet, const fs::path& run,
                                 const Json& result, const std::function<void(const std::string&)>& tell) {
  const Json flown = value_or(result, "planner", Json::object());
  std::map<std::string, std::string> files;  // key: the file that flew; value: the file to fly now
  for (const Json& one : value_or(result, "planner_files", Json::array())) {
    const std::string file = text_in(one, "file");
    const fs::path copy = run / text_in(one, "kept");
    const bool same = fs::is_regular_file(file) && python_digest(file) == text_in(one, "sha256");
    files[file] = same || !fs::is_regular_file(copy) ? file : fs::absolute(copy).string();
    if (files[file] != file) tell(file + " has changed since that run: its copy in the run's folder flies");
  }
  if (files.empty()) return text;
  return planners_rewritten(text, fleet, [&](const UavPlanner& planner) {
    UavPlanner again = planner;
    if (!python_spec(planner.spec)) return again;
    auto python = python_spec(value_or(flown, planner.uav.c_str(), planner.spec).get<std::string>());
    if (!python || !files.contains(python->file)) return again;
    python->file = files[python->file];
    again.spec = text_of(*python);
    return again;
  });
}

}  // namespace skein::cli
