#include "cli/study/page.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "cli/study/box_plot.hpp"
#include "cli/study/columns.hpp"
#include "cli/study/html.hpp"
#include "cli/study/style.hpp"
#include "core/suggestion.hpp"

namespace skein::cli {
namespace {

std::string planner_cell(const Study& study, std::size_t planner) {
  return fmt::format(
      "<td class=\"name\"><div><span class=\"swatch\" "
      "style=\"background:var(--c{})\"></span><span>{}</span></div></td>",
      planner % kPlotColours, escaped(study.planners[planner]));
}

std::string seeds_text(const Study& study) {
  std::vector<std::string> seeds;
  bool in_a_row = true;
  for (std::size_t i = 0; i < study.seeds.size(); ++i) {
    seeds.push_back(std::to_string(study.seeds[i]));
    in_a_row = in_a_row && study.seeds[i] == study.seeds[0] + i;
  }
  return in_a_row && seeds.size() > 2 ? seeds.front() + " to " + seeds.back() : joined(seeds);
}

std::string plural(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string introduction(const Study& study) {
  std::size_t counted = 0;
  for (const FlightEntry& flight : study.flights) counted += flight.figures ? 1 : 0;
  std::string html = fmt::format("<h1>Skein {}: {}</h1>\n<p>{} in {}, seeds {}: {} of {} flights count. ",
                                 study.contest ? "contest" : "comparison", escaped(joined(study.planners, " · ")),
                                 plural(study.planners.size(), "planner"), plural(study.scenarios.size(), "scene"),
                                 seeds_text(study), counted, study.flights.size());
  if (!study.conditions.empty()) html += "<b>Not the scenarios' own: " + escaped(study.conditions) + ".</b> ";
  if (study.contest) html += "A test is one flight in every scene, all with the same seed. ";
  return html + "Tables show medians over the seeds, and below them the range from the least to the greatest.</p>\n";
}

std::string ranking(const Study& study) {
  const std::string by = rank_name(study.rank);
  std::string html = "<h2>Ranking</h2>\n<p>By the " +
                     std::string(study.rank == Rank::maximum  ? "greatest"
                                 : study.rank == Rank::median ? "median"
                                                              : "worst") +
                     " of the planner's totals; a total is the sum of the scores of one test.</p>\n"
                     "<div class=\"wide\"><table>\n<thead><tr><th>Place</th><th class=\"name\">Planner</th>";
  for (const char* name : {"max", "median", "worst"}) html += fmt::format("<th>Total, {}</th>", name);
  for (const std::uint64_t seed : study.seeds) html += fmt::format("<th>Test {}</th>", seed);
  html += "</tr></thead>\n<tbody>\n";
  for (const Standing& standing : standings(study)) {
    html += fmt::format("<tr{}><td>{}</td>", standing.place == 1 ? " class=\"best\"" : "",
                        standing.decides ? std::to_string(standing.place) : "–");
    html += planner_cell(study, standing.planner);
    const std::vector<double> totals = complete_totals(standing);
    const Spread spread = spread_of(totals);
    for (const auto& [name, value] : {std::pair("max", spread.max), {"median", spread.median}, {"worst", spread.min}}) {
      html +=
          fmt::format("<td{}>{}</td>", by == name ? " class=\"decides\"" : "", totals.empty() ? "–" : fixed(value, 1));
    }
    for (const std::optional<double>& total : standing.totals) html += "<td>" + fixed(total, 1) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string figure(const std::string& caption, const std::string& small, const std::string& svg) {
  return "<figure><figcaption>" + escaped(caption) + (small.empty() ? "" : "<small>" + escaped(small) + "</small>") +
         "</figcaption>\n" + svg + "</figure>\n";
}

std::string box_plots(const Study& study) {
  std::string html =
      "<h2>Spread of the scores</h2>\n<p class=\"soft\">Every flight is a dot. The box reaches from the lower to the "
      "upper "
      "quartile, the thick line is the median, the whiskers end at the least and the greatest.</p>\n"
      "<div class=\"panels\">\n";
  if (study.contest) {
    BoxPlot totals{"Total of a test", "sum of scores over all scenes", {}};
    for (std::size_t p = 0; p < study.planners.size(); ++p) totals.rows.push_back({study.planners[p], p, {}});
    for (const Standing& standing : standings(study)) {
      for (std::size_t t = 0; t < standing.totals.size(); ++t) {
        if (!standing.totals[t]) continue;
        totals.rows[standing.planner].values.push_back(
            {*standing.totals[t], fmt::format("test {}: {}", study.seeds[t], fixed(*standing.totals[t], 1))});
      }
    }
    html += figure("Total", "all scenes of a test", box_plot_svg(totals));
  }
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    BoxPlot plot{"Scores in " + study.scenarios[s], "score", {}};
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      PlotRow row{study.planners[p], p, {}};
      for (const FlightEntry* flight : study.cell(p, s)) {
        row.values.push_back(
            {flight->figures->score, fmt::format("seed {}: {}", flight->seed, fixed(flight->figures->score, 1))});
      }
      plot.rows.push_back(std::move(row));
    }
    html += figure(study.scenarios[s], "", box_plot_svg(plot));
  }
  return html + "</div>\n";
}

/// Median with the range below where there is one.
std::string value_cell(const StudyColumn& column, const std::vector<double>& values, bool is_best) {
  if (values.empty()) return "<td>–</td>";
  const Spread spread = spread_of(values);
  // The median of an even number of whole numbers may lie between two.
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
  std::string html = "<div class=\"wide\"><table>\n<thead><tr><th class=\"name\">Planner</th><th>Flights</th>";
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

/// Colours of the drawings of one scene.
std::string legend(const FlightPicture& picture) {
  std::string html = "<ul class=\"legend\">\n";
  for (std::size_t i = 0; i < picture.tracks.size(); ++i) {
    const PictureTrack& track = picture.tracks[i];
    html += fmt::format(
        "<li><svg viewBox=\"0 0 22 10\" aria-hidden=\"true\"><path class=\"track t{}{}{}\" d=\"M1 5L21 5\"/></svg>{}, "
        "{}"
        "</li>\n",
        i % kTrackColours, i >= kTrackColours ? " again" : "", track.explorer ? " explorer" : "", escaped(track.uav),
        track.explorer ? "explorer" : "photographer");
  }
  const double step = (1.0 - kDetected) / kScoreColours;
  html += "<li><span class=\"swatch\" style=\"background:var(--q0)\"></span>not detected</li>\n";
  for (std::size_t i = 0; i < kScoreColours; ++i) {
    const double from = kDetected + step * static_cast<double>(i);
    html += fmt::format("<li><span class=\"swatch\" style=\"background:var(--q{})\"></span>score {} to {}</li>\n",
                        i + 1, fixed(from, 1), fixed(from + step, 1));
  }
  return html + "<li>dashed: boxes that the fleet is told</li>\n</ul>\n";
}

std::string drawings(const Study& study, std::size_t scenario, const StudyPictures& pictures) {
  std::vector<const FlightPicture*> of_scene;
  for (const auto& [key, picture] : pictures) {
    if (key.first == scenario) of_scene.push_back(&picture);
  }
  if (of_scene.empty()) return "";
  const PictureView view(of_scene);
  std::string html =
      "<p class=\"soft\">The best flight of each planner, all from the same side and at the same scale.</p>\n" +
      legend(*of_scene.front()) + "<div class=\"panels large\">\n";
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    const auto found = pictures.find({scenario, p});
    const FlightEntry* best = study.best(p, scenario);
    if (found == pictures.end() || best == nullptr) continue;
    const std::string words =
        fmt::format("{} points detected, {} score", best->figures->points_detected, fixed(best->figures->score, 0));
    html +=
        figure(study.planners[p] + ": " + words, fmt::format("{}, seed {}", study.scenarios[scenario], best->seed),
               picture_svg(found->second, view, study.planners[p] + " in " + study.scenarios[scenario] + ": " + words));
  }
  return html + "</div>\n";
}

std::string problems(const Study& study) {
  if (!study.any_problem()) return "";
  std::string html = "<h2>Flights that did not go well</h2>\n<ul>\n";
  for (const FlightEntry& flight : study.flights) {
    if (flight.problem.empty()) continue;
    html += fmt::format("<li>{}, {}, seed {}: {}{}</li>\n", escaped(study.scenarios[flight.scenario]),
                        escaped(study.planners[flight.planner]), flight.seed, escaped(flight.problem),
                        flight.figures ? " (its result counts)" : " (does not count)");
  }
  return html + "</ul>\n";
}

std::string explanations(const Study& study) {
  std::string html = "<h2>What the columns say</h2>\n<ul>\n";
  for (const StudyColumn& column : study_columns()) {
    if (column.in_report) html += "<li><b>" + escaped(column.title) + "</b>: " + escaped(column.help) + "</li>\n";
  }
  html += "</ul>\n<h2>How to make this page again</h2>\n<pre>" + escaped(study.command_line) + "</pre>\n";
  html += fmt::format(
      "<p class=\"soft\">Skein {}, flown in or over {}, programs {}. The same command with the same build gives the "
      "same flights, "
      "bit by "
      "bit, whatever the machine and however many fly at once. Only CPU and times real time are this machine's; {}. "
      "All figures of all flights: flights.csv; medians: summary.csv{}.</p>\n",
      escaped(study.version), escaped(study.medium), escaped(study.programs.substr(0, 12)),
      study.jobs == 1 ? std::string("one flight at a time")
                      : "up to " + plural(static_cast<std::size_t>(study.jobs), "flight") + " at once",
      study.contest ? "; totals: totals.csv" : "");
  return html;
}

}  // namespace

std::string study_page(const Study& study, const StudyPictures& pictures) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>Skein: " +
      escaped(joined(study.planners)) + "</title>\n<style>\n" + std::string(study_style()) +
      "</style>\n</head>\n<body>\n<main>\n";
  html += introduction(study);
  if (study.contest) html += ranking(study);
  html += box_plots(study);
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    html += "<h2>" + escaped(study.scenarios[s]) + "</h2>\n" + scene_table(study, s) + drawings(study, s, pictures);
  }
  return html + problems(study) + explanations(study) + "</main>\n</body>\n</html>\n";
}

}  // namespace skein::cli
