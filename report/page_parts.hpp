// The sections of a run's report, as HTML. A section without data says what is missing, or is left out (losses by
// place, maps). Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/figures.hpp"
#include "report/flight_picture.hpp"

namespace skein::report {

/// A run with all figures that the sections use.
struct RunPage {
  explicit RunPage(results::RunRecord data);

  results::RunRecord run;
  std::vector<Lane> lanes;
  std::vector<std::optional<TimeBudget>> budgets;  ///< in fleet order
  std::vector<BoxFigures> boxes;
  std::vector<results::ScoreRow> earned;
  LinkShares links;
  Latency latency;
  std::vector<std::optional<MapFigures>> maps;  ///< in fleet order
  FlightPicture picture;
};

/// Scenario, planners and status of the run, its main figures, and warnings.
std::string head_section(const RunPage& page);
/// A waterfall chart from the attainable to the delivered score, by cause of loss.
std::string losses_section(const RunPage& page);
std::string timeline_section(const RunPage& page);
std::string boxes_section(const RunPage& page);
/// Structure and tracks: oblique view, plan view and two elevations.
std::string views_section(const RunPage& page);
/// Plan views of the points that lost score, one for each cause. Empty if no causes are known.
std::string places_section(const RunPage& page);
/// The final map of each UAV, in plan view. Empty if no UAV left a map.
std::string maps_section(const RunPage& page);
std::string fleet_section(const RunPage& page);
std::string radio_section(const RunPage& page);
std::string machine_section(const RunPage& page);

/// The command that repeats the run: `repeat_command` or `command` of the result, or else composed from its other keys.
std::string command_of(const Json& result);
/// The planners of the result's UAVs, each once: "kios", "patrol · hover".
std::string planners_of(const Json& result);

/// Header and row of a table. Names and cells are HTML; the first cell names the row. @param style  its CSS class.
std::string table_head(const std::vector<std::string>& names);
std::string table_row(const std::vector<std::string>& cells, const std::string& style = "");
/// A number of a JSON object as text; a dash if there is none.
std::string cell_of(const Json& object, const char* key, int digits);
/// A paragraph that says what a section cannot show. `why` is HTML.
std::string absent(const std::string& why);

}  // namespace skein::report
