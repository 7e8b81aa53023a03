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

std::string collected_file(const std::string& program, const std::string& name) {
  const std::string member = programs::member_name(program);
  const bool own = name.starts_with(program + ".") || name == map_file(member) || is_maps_file(name, member);
  return own ? name : program + "." + name;
}

bool is_of_a_run(const std::string& name) {
  // "metadata.yaml" is kBagMetadata of recording/bag.hpp, which this layer cannot include.
  constexpr std::array<std::string_view, 20> kFixedNames = {
      "metadata.yaml",  kFleetLog,        kResult,       kScore,         kCaptures, kDigests,     kLosses,
      kEvents,          kCaptureMessages, kTrajectories, kScoreTimeline, kScene,    kPage,        kRecording,
      kRecordingLayout, kTracking,        kWork,         kActivity,      kByHand,   kPlannerFiles};
  // Files whose names begin with a program's name: reports, logs (also the log of the process that runs a whole fleet),
  // recordings, the station's journal and the router's counts. If the journal or the counts of an earlier run remained
  // in the folder, the station or the router would continue from them, as after a crash.
  const bool is_of_a_program =
      programs::is_agent(name) || name.starts_with(std::string(programs::kOneProcess) + ".") ||
      std::any_of(programs::kServers.begin(), programs::kServers.end(),
                  [&](const char* program) { return name.starts_with(std::string(program) + "."); });
  // A program that is killed while it writes a file leaves a temporary file: the final name with a suffix
  // (atomic_file.hpp).
  const std::string final_name = name.substr(0, name.rfind(".tmp"));
  const bool is_map = (final_name.starts_with("map-") && final_name.ends_with(".bt")) ||
                      (final_name.starts_with("maps-") && final_name.ends_with(".mcap"));
  const bool is_hand_file = final_name.starts_with("hand-") && final_name.ends_with(".csv");
  return is_of_a_program || is_map || is_hand_file ||
         std::find(kFixedNames.begin(), kFixedNames.end(), final_name) != kFixedNames.end();
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
  if (!fs::is_directory(run)) throw InputError(run.string() + ": is not a folder");
  return false;
}

}  // namespace run_folder
}  // namespace skein
