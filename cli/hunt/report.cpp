#include "cli/hunt/report.hpp"

#include <algorithm>

#include "cli/fault_tests/report.hpp"
#include "core/text/text.hpp"
#include "process/files/atomic_file.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

using Outcome = properties::Verdict::Outcome;

std::string record_text(const PropertyRecord& record) {
  std::string text = "held in " + std::to_string(record.held) + " runs, vacuous in " + std::to_string(record.vacuous) +
                     ", failed in " + std::to_string(record.failed);
  if (record.least)
    text += "; least margin " + number_text(*record.least + 0.0) + " in case " + std::to_string(record.least_in);
  return text;
}

std::vector<FaultVerdict> verdicts_of(const HuntSummary& summary) {
  std::vector<FaultVerdict> verdicts;
  for (const PropertyRecord& record : property_records(summary)) {
    FaultVerdict& verdict = verdicts.emplace_back();
    verdict.name = record.name;
    verdict.file = summary.plan.out;
    verdict.flown = summary.count > 0;
    verdict.results = summary.plan.out;
    for (const Find& find : summary.finds) {
      if (find.broke == record.name) verdict.broken.push_back(find.capsule.string() + ": " + find.told);
    }
    if (record.failed > 0 && verdict.broken.empty()) {  // the hunt was stopped before it made a find of the failure
      verdict.broken.push_back(record_text(record));
    }
    (record.held == 0 && record.failed == 0 ? verdict.vacuous : verdict.held).push_back(record_text(record));
  }
  return verdicts;
}

}  // namespace

std::vector<PropertyRecord> property_records(const HuntSummary& summary) {
  std::vector<PropertyRecord> records = {{kCompletes}};
  for (const auto& [name, entry] : summary.plan.entries) records.push_back({name});
  for (std::size_t i = 0; i < std::min(summary.count, summary.outcomes.size()); ++i) {
    if (!summary.outcomes[i]) continue;
    for (PropertyRecord& record : records) {
      const TrialFinding* finding = summary.outcomes[i]->find(record.name);
      const Outcome outcome = finding != nullptr ? finding->outcome : Outcome::vacuous;
      ++(outcome == Outcome::holds ? record.held : outcome == Outcome::fails ? record.failed : record.vacuous);
      if (finding == nullptr || !finding->margin || (record.least && *record.least <= *finding->margin)) continue;
      record.least = finding->margin;
      record.least_in = i;
    }
  }
  return records;
}

void write_hunt_report(const HuntSummary& summary) {
  write_file_atomically(summary.plan.out / run_folder::kPage, hunt_page(summary));
  if (!summary.plan.options.junit) return;
  try {
    replace_or_overwrite(*summary.plan.options.junit,
                         junit_xml("skein hunt " + summary.plan.fleet.scenario.name, verdicts_of(summary)));
  } catch (const std::runtime_error& error) {
    throw InputError("--junit: " + std::string(error.what()));
  }
}

}  // namespace skein::cli
