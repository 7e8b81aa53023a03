#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/hunt/report.hpp"
#include "core/faults/fault_writer.hpp"
#include "report/html.hpp"
#include "report/page_parts.hpp"
#include "report/time_chart.hpp"
#include "results/run_record.hpp"
#include "run/drawn_world.hpp"
#include "signals/judge.hpp"
#include "signals/run_signals.hpp"

namespace skein::cli {
namespace {

using report::escaped;
using report::fixed;
using report::table_head;
using report::table_row;

std::string count_text(std::size_t count) { return std::to_string(count); }

std::string head(const HuntSummary& summary) {
  const RunOptions& run = summary.plan.fleet.options;
  return "<header><h1>Hunt: " + escaped(summary.plan.fleet.scenario.name) + ", " + escaped(run.planner) + "</h1>\n<p>" +
         fmt::format("{} runs, {} finds, {} states of the fleet.", summary.count, summary.finds.size(),
                     summary.states) +
         "</p>\n<p class=\"soft\"><code>" + escaped(run.command) + "</code></p></header>\n";
}

std::string properties_section(const HuntSummary& summary) {
  std::string html = "<section id=\"properties\"><h2>Properties</h2>\n<div class=\"wide\"><table>" +
                     table_head({"Property", "Held", "Failed", "Vacuous", "Least margin", "In case"}) + "<tbody>\n";
  for (const PropertyRecord& record : property_records(summary)) {
    const bool vacuous = record.held == 0 && record.failed == 0;
    html += table_row({escaped(record.name) + (vacuous ? " (vacuous)" : ""), count_text(record.held),
                       count_text(record.failed), count_text(record.vacuous), fixed(record.least, 3),
                       record.least ? count_text(record.least_in) : "–"});
  }
  return html + "</tbody></table></div></section>\n";
}

/// How many new states each tenth of the search met.
std::string coverage_section(const HuntSummary& summary) {
  constexpr std::size_t kParts = 10;
  std::set<std::uint64_t> met;
  std::string text;
  std::size_t before = 0, part = 1;
  for (std::size_t i = 0; i < std::min(summary.count, summary.outcomes.size()); ++i) {
    if (summary.outcomes[i]) met.insert(summary.outcomes[i]->states.begin(), summary.outcomes[i]->states.end());
    if ((i + 1) * kParts < part * summary.count) continue;
    text += (text.empty() ? "" : ", ") + count_text(met.size() - before);
    before = met.size();
    part = (i + 1) * kParts / summary.count + 1;
  }
  return "<section id=\"coverage\"><h2>Coverage</h2>\n<p>New states in each tenth of the search: " + text +
         ".</p></section>\n";
}

/// Margin over time of the property that failed; empty if that property compares with a run without faults.
report::TimeCurve margin_curve(const HuntSummary& summary, const Find& find, const results::RunRecord& run) {
  report::TimeCurve curve{"margin of " + find.broke, "delivered", {}};
  const Scenario scenario = scenario_flown(find.trial.run);
  const properties::PropertySet set = properties::parse_properties(summary.plan.entries, scenario);
  const auto property = std::ranges::find(set, find.broke, &properties::NamedProperty::name);
  if (property == set.end() || signals::needs_undisturbed({*property})) return curve;
  FaultPlan plan;
  plan.faults = find.trial.faults;
  signals::FolderSignals signals(run, scenario, nullptr, &plan);
  std::vector<double> worst;
  for (const properties::Property& one : property->cases) {
    const std::vector<double> margins = margins_over_time(one, signals);
    if (worst.empty()) worst = margins;
    for (std::size_t k = 0; k < margins.size(); ++k) worst[k] = std::min(worst[k], margins[k]);
  }
  for (std::size_t k = 0; k < worst.size(); ++k) {
    const double value = std::isfinite(worst[k]) ? worst[k] : (worst[k] > 0.0 ? 1.0 : 0.0);
    if (curve.changes.empty() || curve.changes.back().second != value) {
      curve.changes.emplace_back(static_cast<double>(k) * signals.period_s(), value);
    }
  }
  return curve;
}

std::string chart(const HuntSummary& summary, const Find& find) try {
  const results::RunRecord run = results::read_run(find.run);
  return "<figure>" +
         report::time_chart_svg("Margin of " + find.broke + " over time", {margin_curve(summary, find, run)}, run, {}) +
         "<figcaption>margin over time; bars in the background: faults</figcaption></figure>\n";
} catch (const std::exception& error) {  // the find is valid without its chart
  return report::absent(error.what());
}

std::string find_section(const HuntSummary& summary, const Find& find) {
  std::string html = "<section id=\"" + escaped(find.name) + "\"><h2>" + escaped(find.name) + "</h2>\n<p>" +
                     escaped(find.told) + "</p>\n<pre>";
  for (const Fault& fault : find.trial.faults) html += escaped(fault_line(fault)) + "\n";
  html += "</pre>\n" +
          fmt::format("<p>Found in case {}, minimised with {} flights{}. <a href=\"finds/{}.yaml\">Capsule</a></p>\n",
                      find.index, find.flights, find.over_dds ? ", confirmed over DDS" : "", escaped(find.name));
  return html + chart(summary, find) + "</section>\n";
}

std::string finds_table(const HuntSummary& summary) {
  std::string html = "<section id=\"finds\"><h2>Finds</h2>\n";
  if (summary.finds.empty()) return html + "<p>None.</p></section>\n";
  html += "<div class=\"wide\"><table>" + table_head({"Find", "Property", "Faults", "Failures", "Case"}) + "<tbody>\n";
  for (const Find& find : summary.finds) {
    html += table_row({"<a href=\"#" + escaped(find.name) + "\">" + escaped(find.name) + "</a>", escaped(find.property),
                       count_text(find.trial.faults.size()), count_text(summary.failures.at(find.broke)),
                       count_text(find.index)});
  }
  return html + "</tbody></table></div></section>\n";
}

}  // namespace

std::string hunt_page(const HuntSummary& summary) {
  std::string html = report::page_begin("hunt", std::nullopt, "run");
  html += head(summary) + finds_table(summary) + properties_section(summary) + coverage_section(summary);
  for (const Find& find : summary.finds) html += find_section(summary, find);
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace skein::cli
