#include "cli/maps_in_time.hpp"

#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "cli/rerun_command.hpp"
#include "core/types.hpp"
#include "process/program.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"
#include "view/map_files.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// Results folder of the second flight, inside the run's folder: on the same file system, so that a rename moves the
/// maps. It is removed last. If it is still there when a command starts, an earlier command was interrupted, and may
/// not have moved all maps.
constexpr const char* kSecondFlight = "replay-maps";

/// Replaces the maps of these UAVs in `to` with those in `from`.
void move_maps(const std::vector<std::string>& uavs, const fs::path& from, const fs::path& to) {
  for (const std::string& uav : uavs) {
    for (int life = 0; fs::exists(to / run_folder::maps_file(uav, life)); ++life) {
      fs::remove(to / run_folder::maps_file(uav, life));  // damaged, or moved by an interrupted command
    }
    for (int life = 0; fs::exists(from / run_folder::maps_file(uav, life)); ++life) {
      fs::rename(from / run_folder::maps_file(uav, life), to / run_folder::maps_file(uav, life));
    }
  }
}

}  // namespace

int add_maps_in_time(const fs::path& run, const Console& console) try {
  const fs::path second_flight = run / kSecondFlight;
  const std::vector<std::string> uavs = fleet_of(results::read_result_file(run));
  if (!fs::exists(second_flight) && view::has_maps_in_time(run, uavs)) return kExitDone;
  console.err << "computing the UAVs' maps: the run is flown again from its recording" << std::endl;
  std::ostringstream ignored_summary;  // it would repeat the score of the recorded run
  const ThoughtAgain again =
      think_again_with_maps(run, second_flight, {ignored_summary, console.err, console.terminal, console.keyboard});
  if (again.code == kExitDone && again.different.empty()) move_maps(uavs, second_flight, run);
  fs::remove_all(second_flight);
  if (again.code != kExitDone) return again.code;
  for (const std::string& text : again.different) console.err << "warning: " << text << '\n';
  if (!again.different.empty()) {
    console.err << "warning: the computed maps are therefore maps of another run, and Skein discards them" << std::endl;
  }
  return kExitDone;
} catch (const fs::filesystem_error& error) {
  throw InputError("--maps: " + std::string(error.what()));
}

}  // namespace skein::cli
