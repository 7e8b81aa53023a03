// The sections of a run's report, as HTML. Each says what it misses where a table is not there. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/figures.hpp"
#include "report/flight_picture.hpp"

namespace skein::report {

/// What all sections are made of.
struct RunPage {
  explicit RunPage(results::RunData data);

  results::RunData run;
  std::vector<Lane> lanes;
  std::vector<BoxFigures> boxes;
  std::vector<results::RunScore> earned;
  LinkShares links;
  Latency latency;
  std::vector<std::optional<MapFigures>> maps;  ///< by UAV
  FlightPicture picture;
};

/// What was flown, how it ended, the figures that count, and what to be warned of.
std::string head_section(const RunPage& page);
/// From what could be had to what was had.
std::string losses_section(const RunPage& page);
std::string timeline_section(const RunPage& page);
std::string boxes_section(const RunPage& page);
/// Structure and tracks from all sides.
std::string views_section(const RunPage& page);
/// Where points were lost: a map for each cause.
std::string places_section(const RunPage& page);
/// What each UAV knew at its end: its map in plan.
std::string maps_section(const RunPage& page);
std::string fleet_section(const RunPage& page);
std::string radio_section(const RunPage& page);
std::string machine_section(const RunPage& page);

/// The command that repeats the run: as it was given, or built from the result.
std::string command_of(const Json& result);
/// Of the result's planners, each once: "kios", "patrol · hover".
std::string planners_of(const Json& result);

/// A table's pieces. `cells` are HTML; the first column is a row's name.
std::string table_head(const std::vector<std::string>& names);
std::string table_row(const std::vector<std::string>& cells, const std::string& style = "");
/// A number of a JSON object, or a dash.
std::string cell_of(const Json& object, const char* key, int digits);
/// A drawing twice, for wide and for narrow windows.
template <class Draw>
std::string two_widths(const Draw& draw, double wide) {
  return "<div class=\"broad\">" + draw(wide) + "</div><div class=\"narrow\">" + draw(380.0) + "</div>\n";
}
/// For what a section cannot show.
std::string absent(const std::string& why);

}  // namespace skein::report
