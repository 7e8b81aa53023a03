#include "run/recording.hpp"

#include <system_error>
#include <vector>

#include "core/types.hpp"
#include "process/files/atomic_file.hpp"
#include "recording/bag.hpp"
#include "recording/mcap/join.hpp"
#include "results/run_folder.hpp"
#include "run/viewer_layout.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMetadata = "skein";
constexpr const char* kDigest = "digest";

/// Only entries that stay the same when the run is repeated, so that its recording stays the same, too.
mcap::Metadata metadata_of(const Json& result) {
  mcap::Metadata metadata{kMetadata, {}};
  for (const char* key : {"skein_version", "scenario", "seed", "scene_seed", "planner", "clock", "rules", kDigest}) {
    const auto found = result.find(key);
    if (found == result.end() || found->is_null()) continue;
    metadata.entries[key] = found->is_string() ? found->get<std::string>() : found->dump();
  }
  return metadata;
}

}  // namespace

std::string recorded_digest(const mcap::Reader& recording) {
  std::string digest;
  recording.records([&](const mcap::RawRecord& record, std::uint64_t) {
    if (record.opcode != mcap::Opcode::metadata) return;
    const auto metadata = mcap::parse<mcap::Metadata>(record.content);
    if (!metadata || metadata->name != kMetadata) return;
    if (const auto found = metadata->entries.find(kDigest); found != metadata->entries.end()) digest = found->second;
  });
  return digest;
}

std::vector<fs::path> recording_parts(const fs::path& dir) {
  std::vector<fs::path> parts;
  for (const char* program : programs::kServers) {
    for (int life = 0;; ++life) {
      const fs::path part = dir / run_folder::recording_part(program, life);
      if (!fs::exists(part)) break;
      if (!fs::is_empty(part)) parts.push_back(part);  // empty: killed before it wrote
    }
  }
  return parts;
}

std::vector<std::string> recording_damage(const fs::path& dir) {
  std::vector<std::string> damage;
  try {
    if (fs::exists(dir / run_folder::kRecording)) mcap::Reader::whole(dir / run_folder::kRecording);
  } catch (const InputError& error) {
    damage.push_back(error.what());
  }
  for (const fs::path& part : recording_parts(dir)) {  // a part may be cut off
    try {
      for (const std::string& one : mcap::Reader(part).damage()) damage.push_back(part.string() + ": " + one);
    } catch (const InputError& error) {
      damage.push_back(error.what());
    }
  }
  return damage;
}

std::string join_parts(const fs::path& dir, const Json& result) try {
  const std::vector<fs::path> parts = recording_parts(dir);
  const fs::path recording = dir / run_folder::kRecording;
  const std::string trouble = mcap::join(parts, recording, {metadata_of(result)});
  if (!trouble.empty()) {
    fs::remove(recording);
    return "no recording.mcap, but its parts: " + trouble;
  }
  for (const fs::path& part : parts) fs::remove(part);
  return "";
} catch (const std::system_error& error) {
  return std::string("no recording.mcap, but its parts: ") + error.what();
}

std::string join_recording(const fs::path& dir, const Scenario& scenario, const Json& result) {
  if (recording_parts(dir).empty()) return "";
  const std::string trouble = join_parts(dir, result);
  if (!trouble.empty()) return trouble;
  const std::string refused =
      write_if_possible(dir / recording::kBagMetadata, recording::bag_metadata(dir / run_folder::kRecording));
  if (!refused.empty()) return refused;
  return write_if_possible(dir / run_folder::kRecordingLayout, viewer_layout(scenario).dump(1) + "\n");
}

}  // namespace skein::cli
