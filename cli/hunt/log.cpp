#include "cli/hunt/log.hpp"

#include <algorithm>
#include <array>

#include "cli/hunt/search.hpp"
#include "core/files/file_bytes.hpp"
#include "core/types.hpp"
#include "process/files/atomic_file.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSettingsFile = "hunt.json";
constexpr const char* kLogFile = "log.jsonl";
constexpr const char* kFindsFolder = "finds";
/// Files and folders of a hunt that it deletes when it begins anew.
constexpr std::array kHuntParts = {kLogFile, kFindsFolder, "flights"};

std::string differing_keys(const Json& then, const Json& now) {
  std::string keys;
  const auto add = [&](const std::string& key) { keys += (keys.empty() ? "" : ", ") + key; };
  for (const auto& [key, value] : now.items()) {
    if (value_or(then, key.c_str(), nullptr) != value) add(key);
  }
  if (!then.is_object()) return keys;
  for (const auto& [key, value] : then.items()) {
    if (!now.contains(key)) add(key);  // an option that is not given now
  }
  return keys;
}

/// @returns `dir`. @throws InputError if it holds files, and no hunt: without `force` any but logs, with it those that
/// a hunt would overwrite or delete.
const fs::path& folder_for_hunt(const fs::path& dir, bool force) {
  std::error_code error;  // ignored: ResultsDir reports what cannot be looked at
  if (!fs::is_directory(dir, error) || fs::exists(dir / kSettingsFile, error)) return dir;
  std::vector<std::string> names(kHuntParts.begin(), kHuntParts.end());
  names.insert(names.end(), {HuntLog::kEarlier, "sweep", run_folder::kPage});
  for (const std::string& name : names) {
    if (!fs::exists(fs::symlink_status(dir / name, error))) continue;
    throw InputError("--out " + dir.string() + ": '" + name + "' exists and belongs to no hunt; choose another --out");
  }
  const std::string first = force ? "" : foreign_entry(dir);
  if (first.empty()) return dir;
  throw InputError("--out " + dir.string() + ": '" + first +
                   "' exists and belongs to no hunt; choose another --out, or use this folder anyway with --force");
}

/// The folder in kEarlier for the finds of an earlier hunt: the first number without finds. A launcher that was killed
/// before it could move them has left such a folder.
fs::path kept_folder(const fs::path& dir) {
  const fs::path all = dir / HuntLog::kEarlier;
  for (std::size_t number = 1;; ++number) {
    fs::path one = all / std::to_string(number);
    if (!fs::exists(one / kFindsFolder)) return one;
  }
}

}  // namespace

std::vector<fs::path> HuntLog::keep_finds(const fs::path& dir) {
  std::vector<fs::path> capsules;
  if (!fs::exists(dir / kFindsFolder) || fs::is_empty(dir / kFindsFolder)) return capsules;
  const fs::path kept = kept_folder(dir);
  fs::create_directories(kept);
  // Log and settings are copied before the finds move, and the originals stay until then. So the finds are always in
  // one place with their log and settings, even if the launcher is killed in between.
  for (const char* name : {kLogFile, kSettingsFile}) {
    if (fs::exists(dir / name)) fs::copy_file(dir / name, kept / name, fs::copy_options::overwrite_existing);
  }
  fs::rename(dir / kFindsFolder, kept / kFindsFolder);
  for (const auto& entry : fs::directory_iterator(kept / kFindsFolder)) {
    if (entry.path().extension() == ".yaml") capsules.push_back(entry.path());
  }
  std::ranges::sort(capsules);
  return capsules;
}

HuntLog::HuntLog(const fs::path& dir, const Json& settings, bool force)
    : dir_(folder_for_hunt(dir, force), Earlier::keep), file_(dir / kLogFile) {
  const Json then = read_json(dir / kSettingsFile);
  if (then.is_null() && fs::exists(dir / kSettingsFile) && !force) {
    throw InputError((dir / kSettingsFile).string() +
                     ": is damaged: it is not JSON; choose another --out, or start a new hunt there with --force");
  }
  if (!then.is_null() && then != settings && !force) {
    throw InputError(dir.string() + " holds another hunt, which differs in " + differing_keys(then, settings) +
                     "; choose another --out, or start a new hunt there with --force");
  }
  if (then.is_null() || force) {
    if (fs::exists(dir / kSettingsFile)) kept_ = keep_finds(dir);
    for (const char* part : kHuntParts) fs::remove_all(dir / part);
    write_file_atomically(dir / kSettingsFile, json_text(settings, 2) + "\n");
  }
  read_lines();
  lines_.open(file_, std::ios::app);
  if (!lines_) throw InputError("--out " + dir.string() + ": " + kLogFile + " cannot be written");
}

void HuntLog::read_lines() {
  std::ifstream in = open_text(file_);
  std::string line;
  std::uintmax_t whole = 0;
  for (std::size_t number = 1; std::getline(in, line) && !in.eof(); ++number) {
    whole += line.size() + 1;
    if (line.empty()) continue;
    const Json json = parse_json(line);
    const Json index = value_or(json, "case", nullptr), flown = value_or(json, "flown", nullptr);
    auto outcome = TrialOutcome::from_json(value_or(json, "outcome", nullptr));
    // A case flies only when the log has the cases up to `lag` before it, so the lines above bound its number.
    const std::size_t end = number + HuntSearch::kMostLag;
    if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= end || !flown.is_string() || !outcome) {
      throw InputError(file_.string() + ":" + std::to_string(number) +
                       ": is damaged: this line is not a case of this hunt; delete the line, and Skein flies its case "
                       "again, or start a new hunt with --force");
    }
    keep(index.get<std::size_t>(), flown.get<std::string>(), std::move(*outcome));
  }
  in.close();
  // Removes an incomplete last line, which the launcher was writing when it was killed.
  std::error_code error;
  if (fs::exists(file_, error) && fs::file_size(file_, error) > whole) fs::resize_file(file_, whole, error);
}

void HuntLog::check(std::size_t index, const std::string& flown) const {
  if (index >= outcomes_.size() || !outcomes_[index] || flown_[index] == flown) return;
  throw InputError(
      file_.string() + ": case " + std::to_string(index) +
      " was flown with other faults or settings than this hunt now has for it; start a new hunt with --force");
}

void HuntLog::add(std::size_t index, const std::string& flown, TrialOutcome outcome) {
  lines_ << json_text({{"case", index}, {"flown", flown}, {"outcome", outcome.to_json()}}) << std::endl;
  if (!lines_)
    throw std::runtime_error(file_.string() + ": cannot be written; the same command continues the hunt from there");
  keep(index, flown, std::move(outcome));
}

void HuntLog::keep(std::size_t index, const std::string& flown, TrialOutcome outcome) {
  if (index >= outcomes_.size()) {
    outcomes_.resize(index + 1);
    flown_.resize(index + 1);
  }
  outcomes_[index] = std::move(outcome);
  flown_[index] = flown;
}

}  // namespace skein::cli
