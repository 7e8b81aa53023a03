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

/// Folder of the replay. It lies in the run's folder, so that maps are moved and not copied. It is removed last: while
/// it exists, some maps may not have been moved yet.
constexpr const char* kReflight = "replay-maps";

void move_maps(const std::vector<std::string>& uavs, const fs::path& from, const fs::path& to) {
  for (const std::string& uav : uavs) {
    for (int life = 0; fs::exists(to / run_folder::maps_file(uav, life)); ++life) {
      fs::remove(to / run_folder::maps_file(uav, life));  // damaged
    }
    for (int life = 0; fs::exists(from / run_folder::maps_file(uav, life)); ++life) {
      fs::rename(from / run_folder::maps_file(uav, life), to / run_folder::maps_file(uav, life));
    }
  }
}

}  // namespace

int add_maps_in_time(const fs::path& run, const Console& console) try {
  const fs::path reflight = run / kReflight;
  const std::vector<std::string> uavs = fleet_of(results::read_result_file(run));
  if (!fs::exists(reflight) && view::has_maps_in_time(run, uavs)) return kExitDone;
  console.err << "computing the UAVs' maps: the run is flown again from its recording" << std::endl;
  std::ostringstream unseen;  // the summary is of no interest: the score is known
  const ThoughtAgain again =
      think_again_with_maps(run, reflight, {unseen, console.err, console.terminal, console.keyboard});
  if (again.code == kExitDone && again.different.empty()) move_maps(uavs, reflight, run);
  fs::remove_all(reflight);
  if (again.code != kExitDone) return again.code;
  for (const std::string& text : again.different) console.err << "warning: " << text << '\n';
  if (!again.different.empty()) {
    console.err << "warning: these would be maps of another run, so they are not shown" << std::endl;
  }
  return kExitDone;
} catch (const fs::filesystem_error& error) {
  throw InputError("--maps: " + std::string(error.what()));
}

}  // namespace skein::cli
