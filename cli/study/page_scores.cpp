// The sections of a study's page that are about all scenes.
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "cli/study/columns.hpp"
#include "cli/study/page_parts.hpp"
#include "report/html.hpp"

namespace skein::cli {
namespace {

using namespace report;

/// One planner in one scene, or in all of them with the same seed: then sums, and means of the shares.
struct OverviewCell {
  std::vector<double> scores, shares, points, points_total;
};

OverviewCell overview_of(const Study& study, std::size_t planner, std::optional<std::size_t> scenario) {
  OverviewCell cell;
  const auto add = [&](double score, const std::optional<double>& share, double points, double points_total) {
    cell.scores.push_back(score);
    if (share) cell.shares.push_back(*share);
    cell.points.push_back(points);
    cell.points_total.push_back(points_total);
  };
  if (scenario) {
    for (const FlightEntry* flight : study.cell(planner, *scenario)) {
      const FlightFigures& f = *flight->figures;
      add(f.score, f.attainable_percent, f.points_detected, f.points_total);
    }
    return cell;
  }
  for (const std::uint64_t seed : study.seeds) {
    const auto total = [&](const std::function<std::optional<double>(const FlightFigures&)>& value) {
      return total_of(study, planner, seed, [&](const FlightEntry& flight) { return value(*flight.figures); });
    };
    const auto score = total([](const FlightFigures& f) { return f.score; });
    if (!score) continue;
    auto share = total([](const FlightFigures& f) { return f.attainable_percent; });
    if (share) *share /= static_cast<double>(study.scenarios.size());
    add(*score, share, *total([](const FlightFigures& f) { return f.points_detected; }),
        *total([](const FlightFigures& f) { return f.points_total; }));
  }
  return cell;
}

std::string overview_cell(const OverviewCell& cell, bool is_best) {
  if (cell.scores.empty()) return "<td>–</td>";
  std::string html = fmt::format("<td{}><strong>{}</strong>", is_best ? " class=\"best\"" : "",
                                 fixed(spread_of(cell.scores).median, 1));
  if (!cell.shares.empty()) {
    html += "<small>" + fixed(spread_of(cell.shares).median, 1) + " % of attainable</small>";
  }
  return html + "<small>" + fixed_at_most(spread_of(cell.points).median, 1) + " of " +
         fixed_at_most(spread_of(cell.points_total).median, 1) + " points</small></td>";
}

std::string pair_row(const StudyReport& report, const PlannerPair& pair, bool new_group) {
  const Study& study = report.study;
  const std::vector<double> values = pair.values();
  const auto ahead = std::ranges::count_if(values, [](double value) { return value > 0.0; });
  std::string html = fmt::format("<tr{}><td>{}</td><td class=\"name\">{} − {}</td><td>{}</td><td>{}</td>",
                                 new_group ? " class=\"group\"" : "",
                                 pair.scenario ? escaped(report.titles[*pair.scenario]) : "all scenes",
                                 escaped(study.planners[pair.first]), escaped(study.planners[pair.second]),
                                 values.size(), values.empty() ? "–" : fmt::format("{} of {}", ahead, values.size()));
  html += "<td>" + fixed(pair.median, 1) + "</td>";
  if (!pair.interval) return html + "<td class=\"few\" colspan=\"3\">n too small</td></tr>\n";
  return html + fmt::format("<td>{} to {}</td><td>{}</td><td>{}</td></tr>\n", fixed(pair.interval->low, 1),
                            fixed(pair.interval->high, 1), escaped(p_text(pair.test->p)), escaped(p_text(pair.p_holm)));
}

/// What the figures of pairs mean, and what they do not.
std::string pairs_words(const StudyReport& report) {
  std::string html =
      "<p>Two planners in the same scene with the same seed make a pair: first score less second. The interval holds "
      "the "
      "median with 95 % (bootstrap percentiles of all resamples; Efron 1979, Efron and Tibshirani 1993). <i>p</i> is "
      "that of "
      "Wilcoxon&#39;s signed-rank test (1945), two-sided and exact for up to 100 pairs, differences of 0 left out. ";
  std::size_t tests = 0;
  for (const PlannerPair& pair : report.pairs) tests += pair.test ? 1 : 0;
  if (tests > 1) {
    html += "<i>p</i>, Holm is corrected for all scenes of the pair, or for all pairs of totals (Holm 1979). ";
  }
  html += fmt::format("Below {} pairs, the table has neither. ", kFewestPairs);
  const std::size_t seeds = report.study.seeds.size();
  if (tests > 0 && seeds < 8) {
    html += fmt::format("With {} pairs <i>p</i> cannot be less than {}, and the interval is rough. ", seeds,
                        fixed_at_most(std::ldexp(2.0, -static_cast<int>(seeds)), 4));
  }
  return html + "The seeds are what the pairs are drawn from: nothing follows for other scenes.</p>\n";
}

std::string latency_cell(const Study& study, std::size_t planner, std::size_t scenario) {
  std::vector<Latency> parts;
  for (const FlightEntry* flight : study.cell(planner, scenario)) {
    if (!flight->tables) continue;
    parts.insert(parts.end(), flight->tables->latencies.begin(), flight->tables->latencies.end());
  }
  const Latency all = merged(parts);
  const std::size_t captures = all.delays_s.size() + all.never;
  if (captures == 0) return "<td>–</td>";
  std::string html = "<td>";
  if (!all.delays_s.empty()) {
    html += fmt::format("<strong>{} s</strong><small>nine of ten within {} s</small>", fixed(all.quantile(0.5), 2),
                        fixed(all.quantile(0.9), 2));
  } else {
    html += "<strong>–</strong>";
  }
  return html + fmt::format("<small>{} of {} never ({} %)</small></td>", all.never, captures,
                            fixed(100.0 * static_cast<double>(all.never) / static_cast<double>(captures), 1));
}

std::string scene_heads(const StudyReport& report, bool with_all) {
  std::string html = "<thead><tr><th class=\"name\">Planner</th>";
  for (const std::string& title : report.titles) html += "<th>" + escaped(title) + "</th>";
  return html + (with_all ? "<th>All scenes</th>" : "") + "</tr></thead>\n<tbody>\n";
}

}  // namespace

std::string planner_cell(const Study& study, std::size_t planner) {
  return fmt::format(
      "<td class=\"name\"><div><span class=\"swatch\" style=\"background:var(--{})\"></span><span>{}</span></div></td>",
      colour_class(planner), escaped(study.planners[planner]));
}

std::string figure_panels(const StudyReport& report, std::initializer_list<FigureKind> kinds,
                          std::optional<std::size_t> scenario) {
  std::string html;
  bool large = false;
  for (const StudyFigure& figure : report.figures) {
    if (std::ranges::find(kinds, figure.kind) == kinds.end() || (scenario && figure.scenario != scenario)) continue;
    const std::string link =
        figure.page.empty() ? "" : " · <a href=\"" + escaped(figure.page) + "\">report of this flight</a>";
    html += fmt::format("<figure><figcaption><a class=\"file\" href=\"{}/{}\">SVG</a>{}", kFiguresFolder,
                        escaped(figure.file), escaped(figure.caption)) +
            (figure.small.empty() ? "" : "<small>" + escaped(figure.small) + link + "</small>") + "</figcaption>\n" +
            figure.svg + "</figure>\n";
    large = figure.kind == FigureKind::curves || figure.kind == FigureKind::flight;
  }
  return html.empty() ? "" : "<div class=\"panels" + std::string(large ? " large" : "") + "\">\n" + html + "</div>\n";
}

std::string ranking_section(const StudyReport& report) {
  const Study& study = report.study;
  const std::string by = rank_name(study.rank);
  std::string html =
      "<section id=\"ranking\"><h2>Ranking</h2>\n<p>By the " +
      std::string(study.rank == Rank::maximum  ? "greatest"
                  : study.rank == Rank::median ? "median"
                                               : "worst") +
      " of the planner's totals. A test is one flight in every scene, all with the same seed; a total is "
      "the sum of the scores of one test.</p>\n"
      "<div class=\"wide\"><table>\n<thead><tr><th>Place</th><th class=\"name\">Planner</th>";
  for (const char* name : {"max", "median", "worst"}) html += fmt::format("<th>Total, {}</th>", name);
  for (const std::uint64_t seed : study.seeds) html += fmt::format("<th>Test {}</th>", seed);
  html += "</tr></thead>\n<tbody>\n";
  for (const Standing& standing : standings(study)) {
    html += fmt::format("<tr{}><td>{}</td>", standing.decides && standing.place == 1 ? " class=\"best\"" : "",
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
  return html + "</tbody></table></div></section>\n";
}

std::string overview_section(const StudyReport& report) {
  const Study& study = report.study;
  std::vector<std::optional<std::size_t>> where;
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) where.emplace_back(s);
  if (study.scenarios.size() > 1) where.emplace_back(std::nullopt);
  std::vector<std::vector<OverviewCell>> cells(study.planners.size());
  std::vector<double> best(where.size(), 0.0);
  const auto measure = [&](std::size_t p, std::size_t i) {
    const OverviewCell& cell = cells[p][i];
    return spread_of(!where[i] && study.compares_by_share() ? cell.shares : cell.scores).median;
  };
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    for (std::size_t i = 0; i < where.size(); ++i) {
      cells[p].push_back(overview_of(study, p, where[i]));
      best[i] = std::max(best[i], measure(p, i));
    }
  }
  const bool with_all = where.size() > study.scenarios.size();
  std::string html =
      "<section id=\"overview\"><h2>Scores at a glance</h2>\n<p>Medians over the seeds: score, its share of what full "
      "knowledge of the scene could score, points detected." +
      std::string(with_all ? " All scenes: sums over the flights of one seed, and the mean of their shares, in which "
                             "each scene counts the same."
                           : "") +
      "</p>\n<div class=\"wide\"><table data-table=\"overview\">\n" + scene_heads(report, with_all);
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    html += "<tr>" + planner_cell(study, p);
    for (std::size_t i = 0; i < where.size(); ++i) {
      html += overview_cell(cells[p][i], best[i] > 0.0 && measure(p, i) == best[i]);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></section>\n";
}

std::string spread_section(const StudyReport& report) {
  const std::string curves = figure_panels(report, {FigureKind::curves});
  return fmt::format(
             "<section id=\"spread\"><h2>Spread of the scores</h2>\n<p class=\"soft\">Every flight is a dot, the "
             "thick line is the median. From {} flights on, a box reaches from the lower to the upper quartile, "
             "and the whiskers end at the least and the greatest. All scenes have the same axis, totals have their "
             "own.</p>\n",
             kFewestInABox) +
         figure_panels(report, {FigureKind::total, FigureKind::score}) + "</section>\n" +
         "<section id=\"curves\"><h2>Score over time</h2>\n<p class=\"soft\">The line is the median over the seeds, "
         "the band reaches from the least to the greatest. Delivered score; all scenes have the same axes.</p>\n" +
         (curves.empty() ? "<p class=\"absent\">No flight tells its score over time.</p>\n" : curves) + "</section>\n";
}

std::string pairs_section(const StudyReport& report) {
  if (report.pairs.empty()) return "";
  std::string html = "<section id=\"pairs\"><h2>Planner against planner</h2>\n" + pairs_words(report) +
                     figure_panels(report, {FigureKind::difference}) +
                     "<div class=\"wide\"><table data-table=\"pairs\">\n<thead><tr><th>Scene</th>"
                     "<th class=\"name\">Planners</th><th>Pairs</th><th>First ahead</th><th>Median difference</th>"
                     "<th>95 % interval</th><th><i>p</i></th><th><i>p</i>, Holm</th></tr></thead>\n<tbody>\n";
  const PlannerPair* before = nullptr;
  for (const PlannerPair& pair : report.pairs) {
    html += pair_row(report, pair, before != nullptr && before->scenario != pair.scenario);
    before = &pair;
  }
  return html + "</tbody></table></div></section>\n";
}

std::string delivery_section(const StudyReport& report) {
  const Study& study = report.study;
  std::string html =
      "<section id=\"delivery\"><h2>Delivery of captures</h2>\n<p>From picture to station, of all captures of all "
      "flights that improved a point: median, the time within which nine of ten came, and those that never "
      "did.</p>\n<div class=\"wide\"><table data-table=\"delivery\">\n" +
      scene_heads(report, false);
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    html += "<tr>" + planner_cell(study, p);
    for (std::size_t s = 0; s < study.scenarios.size(); ++s) html += latency_cell(study, p, s);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></section>\n";
}

}  // namespace skein::cli
