#include "cli/run/recording.hpp"

#include <system_error>
#include <vector>

#include "cli/run/viewer_layout.hpp"
#include "mcap/join.hpp"
#include "process/atomic_file.hpp"
#include "process/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> parts_in(const fs::path& dir) {
  std::vector<fs::path> parts;
  for (const char* program : programs::kServers) {
    for (int life = 0;; ++life) {
      const fs::path part = dir / run_folder::recording_part(program, life);
      if (!fs::exists(part)) break;
      parts.push_back(part);
    }
  }
  return parts;
}

/// What does not change when the same run is flown again, so that the recording does not either.
mcap::Metadata metadata_of(const Json& result) {
  mcap::Metadata metadata{"skein", {}};
  for (const char* key : {"skein_version", "scenario", "seed", "scene_seed", "planner", "clock", "rules", "digest"}) {
    const auto found = result.find(key);
    if (found == result.end() || found->is_null()) continue;
    metadata.entries[key] = found->is_string() ? found->get<std::string>() : found->dump();
  }
  return metadata;
}

}  // namespace

std::string join_recording(const fs::path& dir, const Scenario& scenario, const Json& result) try {
  const std::vector<fs::path> parts = parts_in(dir);
  if (parts.empty()) return "";
  const fs::path recording = dir / run_folder::kRecording;
  const std::string trouble = mcap::join(parts, recording, {metadata_of(result)});
  if (!trouble.empty()) {
    fs::remove(recording);
    return "no recording.mcap, but its parts: " + trouble;
  }
  for (const fs::path& part : parts) fs::remove(part);
  return write_if_possible(dir / run_folder::kRecordingLayout, viewer_layout(scenario).dump(1) + "\n");
} catch (const std::system_error& error) {
  return std::string("no recording.mcap, but its parts: ") + error.what();
}

}  // namespace skein::cli
