#include "station/station_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

#include "core/text/text.hpp"
#include "process/files/atomic_file.hpp"
#include "process/reports/program_report.hpp"
#include "process/reports/reports.hpp"
#include "results/run_folder.hpp"
#include "results/run_tables.hpp"

namespace skein::station {
namespace {

std::string timeline_csv(const Scoreboard& scoreboard) {
  std::string text = run_tables::kScoreTimelineColumns + std::string("\n");
  for (const TimelinePoint& at : scoreboard.timeline()) {
    text += fmt::format("{:.9g},{},{:.9g}\n", seconds(at.tick), at.points, at.score);
  }
  return text;
}

/// The reason why a point of a capture does not count; empty when it counts.
std::string reason(const Scoreboard& scoreboard, const LedgerEntry& entry, const CapturePoint& point,
                   const Audit& audit) {
  if (scoreboard.is_void(entry.uav)) return run_tables::kUavCollided;
  if (!audit.delivered) {
    return audit.refused ? "refused: " + std::string(to_string(*audit.refused)) : "not received";
  }
  const PointTally& counts = scoreboard.delivered().points()[point.index];
  const bool is_this = counts.uav == entry.uav && counts.capture == entry.capture.capture;
  return is_this ? "" : "better capture";
}

std::string captures_csv(const Scoreboard& scoreboard, const std::vector<std::string>& uav_names) {
  std::string text = run_tables::kCaptureColumns + std::string("\n");
  for (const LedgerEntry& entry : scoreboard.ledger()) {
    if (entry.collision) continue;
    const Audit audit = scoreboard.audit(entry);
    for (const CapturePoint& point : entry.capture.points) {
      // Nine digits distinguish any two floats.
      text += fmt::format(
          "{},{},{},{:.9g},{},1,{:.9g},{:.9g},{:.9g},{:.9g},{},{}\n", uav_names[entry.uav], entry.capture.capture,
          entry.tick, seconds(entry.tick), point.index, point.q_blur, point.q_res, point.q_distance, point.q,
          audit.delivered ? significant(seconds(*audit.delivered), 9) : "", reason(scoreboard, entry, point, audit));
    }
  }
  return text;
}

StationReport report_of(const Scoreboard& scoreboard, const std::vector<std::string>& uav_names) {
  const ScoreTable& table = scoreboard.delivered();
  StationReport report{.points_detected = table.points_detected(),
                       .score = table.score(),
                       .points = std::vector<ScoredPointReport>(),
                       .reports_received = scoreboard.reports_received(),
                       .duplicates = scoreboard.duplicates()};
  if (scoreboard.standing() > 0 || scoreboard.ledger().empty()) report.score_earned = scoreboard.earned().score();
  const std::vector<double> scores = table.score_by_uav();
  for (const UavIndex uav : FirstUavs(scores.size())) report.score_by_uav.emplace_back(uav_names[uav], scores[uav]);
  for (std::size_t index = 0; index < table.points().size(); ++index) {
    const PointTally& tally = table.points()[index];
    if (tally.q <= 0.0F) continue;
    report.points->push_back({.index = index, .score = tally.q, .uav = uav_names[tally.uav], .capture = tally.capture});
  }
  for (const Refusal why : {Refusal::unknown, Refusal::borrowed, Refusal::altered}) {
    report.refused.emplace_back(to_string(why), scoreboard.refused(why));
  }
  return report;
}

}  // namespace

void write_station_report(const std::filesystem::path& folder, const Scoreboard& scoreboard,
                          const std::vector<std::string>& uav_names, StatusPipe& status, StationNotes notes) {
  for (std::string trouble : {write_if_possible(folder / run_folder::kScoreTimeline, timeline_csv(scoreboard)),
                              write_if_possible(folder / run_folder::kCaptures, captures_csv(scoreboard, uav_names))}) {
    if (!trouble.empty()) notes.unwritten.push_back(std::move(trouble));
  }
  StationReport report = report_of(scoreboard, uav_names);
  report.malformed = notes.malformed;
  report.unsent = notes.unsent;
  if (!notes.dds.empty()) report.dds = notes.dds;
  report.unwritten = std::move(notes.unwritten);
  hand_in_report(json_of(report), folder / run_folder::report_file(programs::kStation), status);
}

}  // namespace skein::station
