#include "station/settlement.hpp"

#include <algorithm>
#include <stdexcept>

#include "process/json_text.hpp"
#include "process/reports/reports.hpp"
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

/// The collisions in the simulator's report, if it is there, and of this run.
std::vector<LedgerEntry> reported_collisions(const std::filesystem::path& folder, RunId run,
                                             const std::vector<std::string>& uavs) {
  const std::filesystem::path file = folder / run_folder::report_file(programs::kSimServer);
  std::vector<LedgerEntry> entries;
  if (!std::filesystem::exists(file)) return entries;
  const auto report = struct_of<SimServerReport>(read_json(file));
  if (report.flight.run.value_or(0) != static_cast<std::uint64_t>(run)) return entries;
  for (const CollisionReport& collision : report.collisions) {
    const auto uav = std::ranges::find(uavs, collision.uav.value_or(""));
    if (uav == uavs.end() || !collision.time_s) continue;
    LedgerEntry& entry = entries.emplace_back();
    entry.tick = ticks(*collision.time_s);
    entry.uav = UavIndex(static_cast<std::size_t>(uav - uavs.begin()));
    entry.collision = true;
  }
  return entries;
}

}  // namespace

void settle(const std::filesystem::path& folder, const Scenario& scenario, RunId run, StatusPipe& status) {
  const Journal journal(folder / run_folder::kJournal, run);
  const std::vector<std::string> uavs = scenario.uav_names();
  Scoreboard scoreboard(uavs.size(), count_points(folder / run_folder::kScene), scenario.rules);
  std::vector<TallyRecord> records = journal.replayed();
  std::vector<bool> collided(uavs.size(), false);
  for (const TallyRecord& record : records) {
    if (record.entry.collision && record.entry.uav < uavs.size()) collided[record.entry.uav] = true;
  }
  for (const LedgerEntry& entry : reported_collisions(folder, run, uavs)) {
    if (collided[entry.uav]) continue;
    collided[entry.uav] = true;
    const Tick last = records.empty() ? 0 : records.back().tick;
    records.push_back({std::max(last, entry.tick), entry});
  }
  std::uint64_t index = 0;
  for (const TallyRecord& record : records) {
    scoreboard.restore(record);
    LedgerEntry entry = record.entry;
    entry.index = index++;  // this ledger has no entries that never arrived, so its indices are new
    scoreboard.add_entry(entry);
  }
  write_station_report(folder, scoreboard, uavs, status);
}

}  // namespace skein::station
