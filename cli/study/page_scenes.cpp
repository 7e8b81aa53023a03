// The sections of a study's page that are about one scene.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>

#include "cli/study/columns.hpp"
#include "cli/study/page_parts.hpp"
#include "core/text/suggestion.hpp"
#include "report/html.hpp"

namespace skein::cli {
namespace {

using namespace report;

constexpr std::size_t kMostOpenRows = 24;  ///< longer tables of UAVs are folded

/// Median, and below it the range if there are several values.
std::string value_cell(const StudyColumn& column, const std::vector<double>& values, bool is_best) {
  if (values.empty()) return "<td>–</td>";
  const Spread spread = spread_of(values);
  // The median of an even number of whole numbers may end in .5.
  const int digits =
      column.digits == 0 && spread.median != static_cast<double>(static_cast<long>(spread.median)) && spread.max < 100.0
          ? 1
          : column.digits;
  std::string html = fmt::format("<td{}>{}", is_best ? " class=\"best\"" : "", fixed(spread.median, digits));
  if (values.size() > 1) {
    html += "<small>" + fixed(spread.min, column.digits) + "–" + fixed(spread.max, column.digits) + "</small>";
  }
  return html + "</td>";
}

std::string scene_table(const Study& study, std::size_t scenario) {
  std::string html =
      "<div class=\"wide\"><table data-table=\"scene\">\n<thead><tr><th class=\"name\">Planner</th><th>Flights</th>";
  for (const StudyColumn& column : study_columns()) {
    if (column.in_report) {
      html += "<th title=\"" + escaped(column.help) + "\">" + escaped(column.title) + "</th>";
    }
  }
  html += "</tr></thead>\n<tbody>\n";
  double best = 0.0;
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    best = std::max(best, spread_of(column_values(study_columns().front(), study.cell(p, scenario))).median);
  }
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    const auto flights = study.cell(p, scenario);
    html += "<tr>" + planner_cell(study, p) + "<td>" + std::to_string(flights.size()) + "</td>";
    for (const StudyColumn& column : study_columns()) {
      if (!column.in_report) continue;
      const std::vector<double> values = column_values(column, flights);
      html += value_cell(column, values, column.name == "score" && best > 0.0 && spread_of(values).median == best);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string flight_cell(const FlightEntry* flight) {
  if (flight == nullptr) return "<td>–</td>";
  const std::string words = flight->figures ? fixed(flight->figures->score, 1) : "–";
  std::string html = "<td>" + (flight->page.empty() ? words
                                                    : "<a href=\"" + escaped(flight->page) + "\">" +
                                                          (flight->figures ? words : "report") + "</a>");
  if (flight->figures) {
    html += "<small>" + counted(static_cast<std::size_t>(flight->figures->points_detected), "point") + "</small>";
    if (flight->figures->collisions > 0) {
      html += "<small>" + counted(static_cast<std::size_t>(flight->figures->collisions), "collision") + "</small>";
    }
  }
  return html + (flight->problem.empty() ? "" : "<small class=\"cross\">problem</small>") + "</td>";
}

std::string flight_table(const Study& study, std::size_t scenario) {
  std::string html =
      "<h3>Flights</h3>\n<p class=\"soft\">Score and points of each flight; the link opens its own report.</p>\n"
      "<div class=\"wide\"><table data-table=\"flights\">\n<thead><tr><th class=\"name\">Planner</th>";
  for (const std::uint64_t seed : study.seeds) html += fmt::format("<th>Seed {}</th>", seed);
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    html += "<tr>" + planner_cell(study, p);
    std::map<std::uint64_t, const FlightEntry*> by_seed;
    for (const std::size_t i : study.flights.in_scenario(p, scenario)) {
      by_seed.try_emplace(study.flights[i].seed, &study.flights[i]);
    }
    for (const std::uint64_t seed : study.seeds) {
      const auto found = by_seed.find(seed);
      html += flight_cell(found == by_seed.end() ? nullptr : found->second);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// Figures of one UAV in all flights of a planner in a scene.
struct UavRow {
  std::string role;
  std::vector<double> scores, distances_m, idle_s, captures, better;
  std::size_t taken = 0, never = 0;  ///< captures that improved a point; those never delivered
};

/// Rows by name of the UAV, in fleet order.
std::vector<std::pair<std::string, UavRow>> uav_rows(const std::vector<const FlightEntry*>& flights) {
  std::vector<std::pair<std::string, UavRow>> rows;
  for (const FlightEntry* flight : flights) {
    const std::vector<UavFigures>& uavs = flight->figures->uavs;
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      auto row = std::ranges::find(rows, uavs[i].name, &std::pair<std::string, UavRow>::first);
      if (row == rows.end()) row = rows.insert(rows.end(), {uavs[i].name, {uavs[i].role, {}, {}, {}, {}, {}}});
      UavRow& sums = row->second;
      sums.scores.push_back(uavs[i].score);
      sums.distances_m.push_back(uavs[i].distance_m);
      if (uavs[i].idle_s) sums.idle_s.push_back(*uavs[i].idle_s);
      if (uavs[i].captures) sums.captures.push_back(*uavs[i].captures);
      if (!flight->tables || i >= flight->tables->latencies.size()) continue;
      const Latency& latency = flight->tables->latencies[i];
      const std::size_t taken = latency.delays_s.size() + latency.never;
      sums.better.push_back(static_cast<double>(taken));
      sums.taken += taken;
      sums.never += latency.never;
    }
  }
  return rows;
}

std::string median_cell(const std::vector<double>& values, int digits) {
  return "<td>" + (values.empty() ? "–" : fixed(spread_of(values).median, digits)) + "</td>";
}

std::string uav_table(const Study& study, std::size_t scenario) {
  std::string rows;
  std::size_t count = 0;
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    bool first = true;
    for (const auto& [name, row] : uav_rows(study.cell(p, scenario))) {
      rows += fmt::format("<tr{}>{}<td class=\"name\">{}</td><td>{}</td>", first && count > 0 ? " class=\"group\"" : "",
                          planner_cell(study, p), escaped(name), escaped(row.role));
      rows += median_cell(row.scores, 1) + median_cell(row.distances_m, 0) + median_cell(row.idle_s, 0) +
              median_cell(row.captures, 0) + median_cell(row.better, 0);
      rows +=
          "<td>" +
          (row.taken > 0 ? fixed(100.0 * static_cast<double>(row.never) / static_cast<double>(row.taken), 1) : "–") +
          "</td></tr>\n";
      first = false;
      ++count;
    }
  }
  if (count == 0) return "";
  return fmt::format(
      "<details{}><summary>UAV by UAV</summary>\n<p class=\"soft\">Medians over the seeds. Undelivered: the share of "
      "the captures that improved a "
      "point, over all flights, that the station never got.</p>\n"
      "<div class=\"wide\"><table data-table=\"uavs\">\n<thead><tr><th class=\"name\">Planner</th>"
      "<th class=\"name\">UAV</th><th>Role</th><th>Score</th><th>Distance [m]</th><th>Idle [s]</th>"
      "<th>Pictures</th><th>Captures</th><th>Undelivered "
      "[%]</th></tr></thead>\n<tbody>\n{}</tbody></table></div></details>\n",
      count <= kMostOpenRows ? " open=\"open\"" : "", rows);
}

}  // namespace

std::string scene_section(const StudyReport& report, std::size_t scenario) {
  const Study& study = report.study;
  std::string html =
      fmt::format("<section id=\"scene-{}\"><h2>{}</h2>\n", scenario + 1, escaped(report.titles[scenario]));
  if (study.scenarios[scenario] != report.titles[scenario]) {
    html += "<p class=\"soft\">" + escaped(study.scenarios[scenario]) + "</p>\n";
  }
  html += "<p class=\"soft\">Medians over the seeds, and below them the range from the least to the greatest.</p>\n" +
          scene_table(study, scenario) + flight_table(study, scenario) + uav_table(study, scenario);
  const std::string drawings = figure_panels(report, {FigureKind::flight}, scenario);
  if (drawings.empty()) return html + "</section>\n";
  const auto first =
      std::ranges::find_if(report.pictures, [&](const auto& entry) { return entry.first.first == scenario; });
  return html +
         "<h3>Best flights</h3>\n<p class=\"soft\">The best flight of each planner, all from the same side and at the "
         "same scale.</p>\n" +
         picture_legend(first->second) + drawings + "</section>\n";
}

}  // namespace skein::cli
