#include "station/settlement.hpp"

#include <stdexcept>

#include "process/json_text.hpp"
#include "results/run_folder.hpp"
#include "station/journal.hpp"
#include "station/station_report.hpp"

namespace skein::station {
namespace {

std::size_t count_points(const std::filesystem::path& scene_file) {
  const Json scene = read_json(scene_file);
  if (!scene.is_object() || !scene.contains("points")) throw std::runtime_error("no points in " + scene_file.string());
  return scene["points"].size();
}

}  // namespace

void settle(const std::filesystem::path& folder, const Scenario& scenario, RunId run, StatusPipe& status) {
  const Journal journal(folder / run_folder::kJournal, run);
  const std::vector<std::string> uavs = scenario.uav_names();
  Scoreboard scoreboard(uavs.size(), count_points(folder / run_folder::kScene), scenario.rules);
  std::uint64_t index = 0;
  for (const TallyRecord& record : journal.replayed()) {
    scoreboard.restore(record);
    LedgerEntry entry = record.entry;
    entry.index = index++;  // this ledger has no entries that never arrived, so its indices are new
    scoreboard.add_entry(entry);
  }
  write_station_report(folder, scoreboard, uavs, status);
}

}  // namespace skein::station
