#include "signals/judge.hpp"

#include <algorithm>
#include <cmath>

#include "core/text/text.hpp"

namespace skein::signals {

using properties::NamedProperty;
using properties::Property;
using properties::Verdict;

std::string PropertyFinding::text() const {
  const std::string of = verdict.bound.empty() ? "" : " (" + verdict.bound + ")";
  if (verdict.outcome == Verdict::Outcome::vacuous) return "vacuous: " + verdict.reason + of;
  const std::string unit = unit_text(verdict.unit);
  std::string margin = std::isfinite(verdict.margin) ? "margin " + number_text(verdict.margin + 0.0) : "true by itself";
  if (std::isfinite(verdict.margin) && !unit.empty()) margin += " " + unit;
  if (verdict.outcome == Verdict::Outcome::holds) {
    return margin + of + ", decided at " + number_text(verdict.at_s) + " s";
  }
  return verdict.reason + of + (std::isfinite(verdict.margin) ? ", " + margin : "");
}

std::vector<PropertyFinding> judge_properties(const properties::PropertySet& set, properties::RunSignals& run) {
  std::vector<PropertyFinding> findings;
  for (const NamedProperty& property : set) {
    std::vector<Verdict> verdicts;
    for (const Property& one : property.cases) verdicts.push_back(evaluate(one, run));
    findings.push_back({property.name, worst_of(verdicts)});
  }
  return findings;
}

bool needs_undisturbed(const properties::PropertySet& set) {
  return std::ranges::any_of(set, [&](const NamedProperty& property) {
    return std::ranges::any_of(property.cases,
                               [&](const Property& one) { return std::ranges::any_of(one.signals, is_comparison); });
  });
}

void check_against_plan(const properties::PropertySet& set, const FaultPlan& plan, const Scenario& scenario,
                        const std::string& key, ConfigErrors& errors) {
  double healed_s = 0.0;
  for (const Fault& fault : plan.faults) healed_s = std::max(healed_s, fault.until_s.value_or(0.0));
  for (const NamedProperty& property : set) {
    const properties::Window& window = property.cases.empty() ? properties::Window{} : property.cases[0].window;
    const bool waits = window.from == properties::Window::From::heal && window.within_s;
    if (!waits || healed_s + *window.within_s <= scenario.duration_s) continue;
    errors.check(false, key + "." + property.name,
                 "is beyond the end: the last fault ends at " + number_text(healed_s) + " s, " +
                     number_text(*window.within_s) + " s later the mission of '" + scenario.name + "', which lasts " +
                     number_text(scenario.duration_s) + " s, is over");
  }
}

}  // namespace skein::signals
