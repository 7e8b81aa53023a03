#include "results/run_folder.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>

#include "core/types.hpp"

namespace skein {
namespace programs {
namespace {

constexpr std::string_view kAgentPrefix = "uav_agent-";

}  // namespace

std::string agent_program(const std::string& member) { return std::string(kAgentPrefix) + member; }

bool is_agent(const std::string& program) { return program.starts_with(kAgentPrefix); }

std::string member_name(const std::string& program) {
  return is_agent(program) ? program.substr(kAgentPrefix.size()) : program;
}

std::string program_of(const std::string& member) {
  return member == kCommRouter || member == kStation ? member : agent_program(member);
}

}  // namespace programs

namespace run_folder {

std::string report_file(const std::string& program) { return program + ".report.json"; }

std::string log_file(const std::string& program) { return program + ".log"; }

std::string hand_file(const std::string& uav) { return "hand-" + uav + ".csv"; }

std::string map_file(const std::string& uav) { return "map-" + uav + ".bt"; }

std::string recording_part(const std::string& program, int life) {
  return program + (life == 0 ? "" : "." + std::to_string(life + 1)) + ".mcap";
}

std::string maps_file(const std::string& uav, int life) { return recording_part("maps-" + uav, life); }

bool is_maps_file(const std::string& name, const std::string& uav) {
  const std::string begin = "maps-" + uav + ".", end = ".mcap";
  if (name == maps_file(uav, 0)) return true;
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() <= begin.size() + end.size()) return false;
  const std::string_view life = std::string_view(name).substr(begin.size(), name.size() - begin.size() - end.size());
  return life.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_of_a_run(const std::string& name) {
  // recording/bag.hpp writes metadata.yaml.
  constexpr std::array<std::string_view, 20> kTables = {
      "metadata.yaml",  kFleetLog,        kResult,       kScore,         kCaptures, kDigests,     kLosses,
      kEvents,          kCaptureMessages, kTrajectories, kScoreTimeline, kScene,    kPage,        kRecording,
      kRecordingLayout, kTracking,        kWork,         kActivity,      kByHand,   kPlannerFiles};
  // Reports, logs (also that of a whole fleet's process), the station's journal and the router's counts. If a journal
  // or counts of another run stayed, the program would continue from them, as after a crash.
  const bool of_a_program = programs::is_agent(name) || name.starts_with(std::string(programs::kOneProcess) + ".") ||
                            std::any_of(programs::kServers.begin(), programs::kServers.end(), [&](const char* program) {
                              return name.starts_with(std::string(program) + ".");
                            });
  // Without the suffix of a temporary file, which stays if the writing program is killed (atomic_file.hpp).
  const std::string whole = name.substr(0, name.rfind(".tmp"));
  const bool is_map =
      (whole.starts_with("map-") && whole.ends_with(".bt")) || (whole.starts_with("maps-") && whole.ends_with(".mcap"));
  const bool is_of_a_hand = whole.starts_with("hand-") && whole.ends_with(".csv");
  return of_a_program || is_map || is_of_a_hand || std::find(kTables.begin(), kTables.end(), whole) != kTables.end();
}

bool has_file(const std::filesystem::path& run, const std::string& name) {
  namespace fs = std::filesystem;
  const auto exists = [](const fs::path& path) {
    std::error_code error;
    const fs::file_type type = fs::status(path, error).type();
    if (type == fs::file_type::none) throw InputError(path.string() + ": cannot be read (" + error.message() + ")");
    return type != fs::file_type::not_found;
  };
  if (exists(run / name)) return true;
  if (!exists(run)) throw InputError(run.string() + ": there is no such folder");
  if (!fs::is_directory(run)) throw InputError(run.string() + ": is no folder");
  return false;
}

}  // namespace run_folder
}  // namespace skein
