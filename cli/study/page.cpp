#include "cli/study/page.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "cli/study/columns.hpp"
#include "cli/study/page_parts.hpp"
#include "cli/study/spec.hpp"
#include "core/text/suggestion.hpp"
#include "report/html.hpp"

namespace skein::cli {
namespace {

using namespace report;

constexpr std::size_t kLongestTitle = 100;

/// Additional styles of a study's page.
constexpr const char* kStudyStyle = R"css(.study svg.plot { max-width: 560px; }
.study .panels { grid-template-columns: repeat(auto-fit, minmax(min(320px, 100%), 1fr)); }
.study .panels.large { grid-template-columns: repeat(auto-fit, minmax(min(400px, 100%), 1fr)); }
.study td strong { font-size: 1.1em; } .study tr.best td.decides strong { font-weight: 800; }
.study .card strong { overflow-wrap: anywhere; line-height: 1.15; margin: 0.1em 0; }
.study td.name { font-weight: 400; } @media (min-width: 601px) { .study td.name { min-width: 13em; max-width: 22em; } }
.study tbody tr.group td { border-top: 2px solid var(--soft); }
.study td.few { color: var(--soft); font-style: italic; text-align: center; }
.study a { color: var(--c0); text-decoration-thickness: 1px; text-underline-offset: 2px; }
.study figcaption a { font-weight: 400; } .study a.file { float: right; font-size: 0.85em; margin-left: 1em; }
.study .plot text.name { paint-order: stroke; stroke: var(--panel); stroke-width: 3px; }
.study .columns { columns: 24em; column-gap: 2.4em; max-width: none; padding-left: 1.2em; }
.study .columns li { break-inside: avoid; }
.study .files { overflow-wrap: anywhere; }
@media print { .study a { color: inherit; } .study a.file { display: none; } }
)css";

std::string seeds_text(const Study& study) {
  std::vector<std::string> seeds;
  bool in_a_row = true;
  for (std::size_t i = 0; i < study.seeds.size(); ++i) {
    seeds.push_back(std::to_string(study.seeds[i]));
    in_a_row = in_a_row && study.seeds[i] == study.seeds[0] + i;
  }
  return in_a_row && seeds.size() > 2 ? seeds.front() + " to " + seeds.back() : joined(seeds);
}

std::string study_card(const std::string& name, const std::string& value, const std::string& small,
                       const std::string& style = "") {
  return fmt::format("<div class=\"card {}\"><span>{}</span><strong>{}</strong><small>{}</small></div>\n", style, name,
                     escaped(value), escaped(small));
}

/// A card with the planner in first place: in a contest by its rule, else by the median of its shares or totals.
std::string leader_card(const Study& study) {
  if (study.contest) {
    const std::vector<Standing> all = standings(study);
    if (all.empty() || !all.front().decides) return study_card("First place", "–", "no complete test", "main");
    const auto ahead = std::ranges::count(all, all.front().decides, &Standing::decides);
    if (ahead > 1) {
      return study_card("First place", counted(static_cast<std::size_t>(ahead), "planner"),
                        "share it: " + rank_name(study.rank) + " total " + fixed(*all.front().decides, 1), "main");
    }
    return study_card("First place", shortened(study.planners[all.front().planner], 24),
                      rank_name(study.rank) + " total " + fixed(*all.front().decides, 1), "main");
  }
  const bool by_share = study.compares_by_share();
  const auto figure = [&](const FlightEntry& flight) -> std::optional<double> {
    return by_share ? flight.figures->attainable_percent : flight.figures->score;
  };
  std::optional<double> most;
  std::size_t first = 0;
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    std::vector<double> totals;
    for (const std::uint64_t seed : study.seeds) {
      if (const auto total = total_of(study, p, seed, figure)) totals.push_back(*total);
    }
    const double median = spread_of(totals).median;
    if (totals.empty() || (most && median <= *most)) continue;
    most = median;
    first = p;
  }
  if (!most) return study_card("Highest score", "–", "no planner has a flight in every scene", "main");
  const std::string name = shortened(study.planners[first], 24);
  const auto scenes = static_cast<double>(study.scenarios.size());
  if (by_share) {
    return study_card("Highest share", name,
                      "median " + fixed(*most / scenes, 1) + " % of attainable, mean of all scenes", "main");
  }
  return study_card("Highest score", name,
                    "median " + fixed(*most, 1) + (study.scenarios.size() > 1 ? ", sum over all scenes" : ""), "main");
}

std::string study_cards(const Study& study) {
  std::size_t judged = 0, collisions = 0;
  double flown_s = 0.0;
  for (const FlightEntry& flight : study.flights) {
    if (!flight.figures) continue;
    ++judged;
    collisions += static_cast<std::size_t>(flight.figures->collisions);
    flown_s += flight.figures->mission_time_s;
  }
  return "<div class=\"cards\">\n" + leader_card(study) +
         study_card("Flights that count", fmt::format("{} of {}", judged, study.flights.size()),
                    counted(study.seeds.size(), "seed") + ": " + seeds_text(study),
                    judged < study.flights.size() ? "bad" : "") +
         study_card("Planners", std::to_string(study.planners.size()), "each in every scene") +
         study_card("Scenes", std::to_string(study.scenarios.size()), "all with the same seeds") +
         study_card("Mission time", fixed(flown_s / 60.0, 0) + " min", "of all flights together") +
         study_card("Collisions", std::to_string(collisions), "of all flights") + "</div>\n";
}

std::string study_facts(const Study& study) {
  std::string html = "<dl class=\"facts\">\n";
  const auto fact = [&](const std::string& name, const std::string& value) {
    html += "<div><dt>" + name + "</dt><dd>" + (value.empty() ? "–" : escaped(value)) + "</dd></div>\n";
  };
  fact("Seeds", seeds_text(study));
  if (!study.conditions.empty()) fact("Not the scenarios' own", study.conditions);
  fact("DDS", study.medium);
  fact("Skein", study.version);
  return html + "<div class=\"long\"><dt>Programs</dt><dd><code>" + escaped(study.programs.substr(0, 12)) +
         "</code></dd></div>\n</dl>\n";
}

std::string problem_notes(const StudyReport& report) {
  const Study& study = report.study;
  if (!study.any_problem()) return "";
  std::string html = "<div class=\"note lost\"><b>Flights that did not go well</b><ul>\n";
  for (const FlightEntry& flight : study.flights) {
    if (flight.problem.empty()) continue;
    html += fmt::format("<li>{}, {}, seed {}: {}{}</li>\n", escaped(report.titles[flight.scenario]),
                        escaped(study.planners[flight.planner]), flight.seed, escaped(flight.problem),
                        flight.figures ? " (its result counts)" : " (does not count)");
  }
  return html + "</ul></div>\n";
}

std::string study_head(const StudyReport& report) {
  const Study& study = report.study;
  return fmt::format("<header><p class=\"soft over\">Skein {}</p>\n<h1>{} <span class=\"by\">in</span> {}</h1>\n",
                     study.contest ? "contest" : "comparison",
                     escaped(shortened(joined(study.planners, " · "), kLongestTitle)),
                     escaped(shortened(joined(report.titles, " · "), kLongestTitle))) +
         study_cards(study) + study_facts(study) + "<pre class=\"command\">" + escaped(study.command_line) +
         "</pre>\n" + problem_notes(report) + "</header>\n";
}

std::string explanations() {
  std::string html = "<section id=\"words\"><h2>What the columns say</h2>\n<ul class=\"columns\">\n";
  for (const StudyColumn& column : study_columns()) {
    if (column.in_report) html += "<li><b>" + escaped(column.title) + "</b>: " + escaped(column.help) + "</li>\n";
  }
  return html + "</ul></section>\n";
}

std::string file_links(const StudyReport& report) {
  std::vector<std::string> files = {"flights.csv", "summary.csv", "pairs.csv"};
  if (report.study.contest) files.push_back("totals.csv");
  files.push_back(kTexTable);
  for (const StudyFigure& figure : report.figures) files.push_back(std::string(kFiguresFolder) + "/" + figure.file);
  std::string html =
      "<section id=\"files\"><h2>Files for papers and programs</h2>\n<p>All figures of all flights, medians, a table "
      "for "
      "LaTeX (booktabs), and each drawing of this page as an SVG file, black on white.</p>\n<ul class=\"columns "
      "files\">\n";
  for (const std::string& file : files) html += fmt::format("<li><a href=\"{0}\">{0}</a></li>\n", escaped(file));
  return html + "</ul></section>\n";
}

/// Median of a figure over the flights that have it.
std::optional<double> of_flights(const Study& study, std::optional<double> FlightFigures::*figure) {
  std::vector<double> values;
  for (const FlightEntry& flight : study.flights) {
    if (flight.figures && (*flight.figures).*figure) values.push_back(*((*flight.figures).*figure));
  }
  return values.empty() ? std::nullopt : std::optional(spread_of(values).median);
}

std::string study_footer(const Study& study) {
  const std::string at_once = study.jobs == 1
                                  ? std::string("one flight at a time")
                                  : "up to " + counted(static_cast<std::size_t>(study.jobs), "flight") + " at once";
  std::string html = "<footer class=\"soft\">\n";
  if (!study.machine.empty())
    html += "<p id=\"machine\">Written on " + escaped(study.machine) + "; ";
  else
    html += "<p id=\"machine\">";
  html += fmt::format(
      "{}. A flight kept {} processors busy and took {} MB of memory (medians). Skein {}, DDS: "
      "{}.</p>\n",
      at_once, fixed(of_flights(study, &FlightFigures::processors), 2),
      fixed(of_flights(study, &FlightFigures::memory_mb), 0), escaped(study.version), escaped(study.medium));
  return html +
         "<p>The same command with the same build gives the same flights, bit by bit, whatever the machine and however "
         "many fly at once. Only CPU and times real time are this machine's.</p></footer>\n";
}

}  // namespace

StudyReport::StudyReport(const Study& of, StudyPictures drawn)
    : study(of),
      pictures(std::move(drawn)),
      titles(scene_titles(of.scenarios)),
      pairs(planner_pairs(of)),
      figures(study_figures(of, pictures, pairs, titles)) {}

std::string study_page(const StudyReport& report) {
  const Study& study = report.study;
  std::string html = page_begin(joined(study.planners), std::nullopt, "run study", kStudyStyle);
  html += study_head(report);
  if (study.contest) html += ranking_section(report);
  html += overview_section(report) + spread_section(report) + pairs_section(report) + delivery_section(report);
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) html += scene_section(report, s);
  return html + explanations() + file_links(report) + study_footer(study) + "</main>\n</body>\n</html>\n";
}

}  // namespace skein::cli
