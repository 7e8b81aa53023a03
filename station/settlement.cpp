#include "station/settlement.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "station/journal.hpp"
#include "station/station_report.hpp"

namespace skein::station {
namespace {

std::size_t count_points(const std::filesystem::path& scene_file) {
  std::ifstream in(scene_file);
  const nlohmann::json scene = nlohmann::json::parse(in, nullptr, false);
  if (!scene.is_object() || !scene.contains("points")) throw std::runtime_error("no points in " + scene_file.string());
  return scene["points"].size();
}

}  // namespace

void settle(const std::filesystem::path& folder, const Scenario& scenario, RunId run, StatusPipe& status) {
  const Journal journal(folder / "station.journal", run);
  const std::vector<std::string> uavs = scenario.uav_names();
  Scoreboard scoreboard(uavs.size(), count_points(folder / "scene.json"), scenario.rules);
  std::uint64_t index = 0;
  for (const TallyRecord& record : journal.replayed()) {
    scoreboard.restore(record);
    LedgerEntry entry = record.entry;
    entry.index = index++;  // the ledger without what never arrived
    scoreboard.add_entry(entry);
  }
  write_station_report(folder, scoreboard, uavs, status);
}

}  // namespace skein::station
