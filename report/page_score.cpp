// The sections about the score.
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/text/text.hpp"
#include "report/html.hpp"
#include "report/page_parts.hpp"
#include "report/time_chart.hpp"
#include "results/losses.hpp"

namespace skein::report {
namespace {

/// A bar of the waterfall chart between two scores. @param most  score at the right end of the chart.
std::string bar_cell(double from, double until, double most, const std::string& style) {
  const double low = 100.0 * std::min(from, until) / most,
               width = std::max(0.25, 100.0 * std::abs(until - from) / most);
  return fmt::format(
      "<svg class=\"fall\" viewBox=\"0 0 100 10\" preserveAspectRatio=\"none\" aria-hidden=\"true\" "
      "xmlns=\"http://www.w3.org/2000/svg\"><rect class=\"{}\" x=\"{}\" y=\"1\" width=\"{}\" height=\"8\"/></svg>",
      style, significant(low, 5), significant(width, 5));
}

std::string swatch(std::size_t cause) {
  return fmt::format("<span class=\"swatch\" style=\"background:var(--k{})\"></span>", cause);
}

/// A cell of the heat map. @param share  of the attainable value, 0 to 1; the greater, the stronger the colour.
std::string heat(const std::string& text, double share, const std::string& colour) {
  return fmt::format("<td class=\"heat\" style=\"--v:{}%;--h:var(--{})\">{}</td>",
                     fixed(std::clamp(60.0 * share, 0.0, 60.0), 0), colour, text);
}

/// Whether UAVs came near the points that were never in a picture; empty if there are none, or this is not known.
std::string never_seen_table(const RunPage& page) {
  const std::optional<NeverInPicture> sums = never_in_picture(page.run);
  if (!sums) return "";
  return "<p class=\"soft\">Points never in the picture: a UAV comes near a point if it is within the range in which "
         "its camera is sharp enough.</p>\n<div class=\"wide\"><table class=\"words\" data-table=\"unseen\">\n" +
         table_head({"", "Lost", "Points"}) + "<tbody>\n" +
         table_row({"no UAV ever came near", fixed(sums->loss_far, 1), std::to_string(sums->points_far)}) +
         table_row({"a UAV came near, but did not look, or something was in between", fixed(sums->loss_near, 1),
                    std::to_string(sums->points_near)}) +
         "</tbody></table></div>\n";
}

/// Why points were too poor to count; empty if there are none.
std::string poor_table(const Json& losses) {
  const auto parts = results::poor_parts(losses);
  std::string rows;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].points == 0) continue;
    rows += table_row({results::kPoorParts[i].title, fixed(parts[i].score, 1), std::to_string(parts[i].points)});
  }
  if (rows.empty()) return "";
  return "<p class=\"soft\">Points too poor to count: by the worst part of the quality of their best "
         "picture.</p>\n<div class=\"wide\"><table class=\"words\" data-table=\"poor\">\n" +
         table_head({"", "Lost", "Points"}) + "<tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string percent(double part, double whole) { return whole > 0.0 ? fixed(100.0 * part / whole, 1) + " %" : "–"; }

}  // namespace

std::string losses_section(const RunPage& page) {
  const Json& result = page.run.result;
  const Json attainable = value_or(result, "attainable", Json::object()), losses = value_or(result, "losses", nullptr);
  const auto estimate = number_if_any(attainable, "score");
  std::string html = "<section id=\"why\"><h2>Why this score</h2>\n";
  if (!estimate || !losses.is_object()) {
    return html + absent("The attainable score of this run is not known, so its losses are not known either.") +
           "</section>\n";
  }
  double most = std::max({*estimate, number_in(result, "score"), 1e-9}), left = *estimate;
  for (const results::Cause& cause : results::kCauses) {
    left -= number_in(value_or(losses, std::string(cause.key).c_str(), Json::object()), "score");
    most = std::max(most, left);
  }
  html +=
      "<p class=\"soft\">From the score attainable with full knowledge of the scene to the delivered score. Each point "
      "loses to one cause; the bars add up.</p>\n<div class=\"wide\"><table class=\"waterfall\" "
      "data-table=\"losses\">\n" +
      table_head({"", "Score", "Share", "Points", ""}) + "<tbody>\n";
  html += table_row({"attainable", fixed(*estimate, 1), "100.0 %", cell_of(attainable, "points", 0),
                     bar_cell(0.0, *estimate, most, "whole")},
                    "sum");
  left = *estimate;
  for (std::size_t i = 0; i < results::kCauses.size(); ++i) {
    const Json sum = value_or(losses, std::string(results::kCauses[i].key).c_str(), Json::object());
    const double lost = number_in(sum, "score");
    if (number_in(sum, "points") <= 0.0) continue;
    html += table_row({swatch(i) + std::string(results::kCauses[i].title), fixed(-lost, 1), percent(lost, *estimate),
                       cell_of(sum, "points", 0), bar_cell(left - lost, left, most, fmt::format("k{}", i))});
    left -= lost;
  }
  html += table_row({"delivered", cell_of(result, "score", 1), percent(number_in(result, "score"), *estimate),
                     cell_of(result, "points_detected", 0), bar_cell(0.0, number_in(result, "score"), most, "had")},
                    "sum");
  return html + "</tbody></table></div>\n" + poor_table(losses) + never_seen_table(page) + "</section>\n";
}

std::string timeline_section(const RunPage& page) {
  std::string html = "<section id=\"time\"><h2>Score over time</h2>\n";
  TimeCurve delivered{"delivered", "delivered", {}}, earned{"earned", "earned", {}};
  for (const results::ScoreRow& score : page.run.scores) delivered.changes.emplace_back(score.time_s, score.score);
  for (const results::ScoreRow& score : page.earned) earned.changes.emplace_back(score.time_s, score.score);
  const std::string title = "Score over time: " + cell_of(page.run.result, "score", 1) + " at the end";
  html +=
      "<ul class=\"legend\"><li><span class=\"swatch line\" style=\"background:var(--c0)\"></span>delivered</li>"
      "<li><span class=\"swatch line\" style=\"background:var(--c1)\"></span>earned: photographed by UAVs that never "
      "collided</li>"
      "<li>ticks: captures that improved a point</li>";
  if (!page.run.faults.empty())
    html += "<li><span class=\"swatch\" style=\"background:var(--fault)\"></span>faults</li>";
  html += "</ul>\n<figure data-live=\"score\">" + time_chart_svg(title, {earned, delivered}, page.run, page.lanes) +
          "</figure>\n";
  if (!page.run.faults.empty()) {
    html += "<details open=\"open\"><summary>Faults</summary><div class=\"wide\"><table data-table=\"faults\">" +
            table_head({"Fault", "From [s]", "Until [s]"}) + "<tbody>\n";
    for (const results::RunFault& fault : page.run.faults) {
      html += table_row({escaped(fault.kind + " " + fault.target), fixed(fault.from_s, 2), fixed(fault.until_s, 2)});
    }
    html += "</tbody></table></div></details>\n";
  }
  return html + "</section>\n";
}

std::string boxes_section(const RunPage& page) {
  std::string html = "<section id=\"boxes\"><h2>Quality by box</h2>\n";
  if (page.run.points.empty()) return html + absent("No interest points are known.") + "</section>\n";
  std::vector<std::size_t> causes;  // with a loss
  const BoxFigures& all = page.boxes.back();
  for (std::size_t i = 0; i < results::kCauses.size(); ++i) {
    if (all.losses[i] != 0.0) causes.push_back(i);
  }
  std::vector<std::string> names = {"Box", "Points", "Scored", "Mean q [1]", "Score"};
  if (page.run.causes_known) names.insert(names.begin() + 2, "Attainable");
  if (page.run.causes_known) names.push_back("Of estimate");
  for (const std::size_t i : causes) names.push_back("Lost: " + std::string(results::kCauses[i].title));
  html +=
      "<p class=\"soft\">A point in several boxes counts in the first. Darker cells: a larger share of the box's "
      "attainable score; losses are scores.</p>\n"
      "<div class=\"wide\"><table class=\"heatmap\" data-table=\"boxes\">\n" +
      table_head(names) + "<tbody>\n";
  for (const BoxFigures& box : page.boxes) {
    std::string row = "<td>" + escaped(box.name) + "</td><td>" + std::to_string(box.points) + "</td>";
    if (page.run.causes_known) row += "<td>" + std::to_string(box.attainable) + "</td>";
    const double of = static_cast<double>(page.run.causes_known ? box.attainable : box.points);
    row += heat(std::to_string(box.scored), of > 0.0 ? static_cast<double>(box.scored) / of : 0.0, "c0") +
           heat(box.scored > 0 ? fixed(box.mean_q(), 3) : "–", box.mean_q(), "c0") + "<td>" + fixed(box.score, 1) +
           "</td>";
    if (page.run.causes_known)
      row += heat(percent(box.score, box.estimate), box.estimate > 0.0 ? box.score / box.estimate : 0.0, "c0");
    for (const std::size_t i : causes) {
      row += heat(box.losses[i] == 0.0 ? "–" : fixed(box.losses[i], 1),
                  box.estimate > 0.0 ? box.losses[i] / box.estimate : 0.0, fmt::format("k{}", i));
    }
    html += (&box == &all ? "<tr class=\"sum\">" : "<tr>") + row + "</tr>\n";
  }
  return html + "</tbody></table></div></section>\n";
}

}  // namespace skein::report
