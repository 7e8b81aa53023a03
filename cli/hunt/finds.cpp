#include "cli/hunt/finds.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "core/text.hpp"
#include "process/atomic_file.hpp"

#ifndef SKEIN_VERSION
#error "SKEIN_VERSION comes from CMake's project()"
#endif

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::multiset<std::string> kinds_in(const std::vector<Fault>& faults) {
  std::multiset<std::string> kinds;
  for (const Fault& fault : faults) kinds.insert(fault_kind(fault));
  return kinds;
}

}  // namespace

std::vector<Failure> failures_of(const std::vector<std::optional<TrialOutcome>>& outcomes, std::size_t count) {
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < std::min(count, outcomes.size()); ++i) {
    if (!outcomes[i]) continue;
    for (const TrialFinding& finding : outcomes[i]->findings) {
      if (finding.fails()) failures.push_back({i, finding.property});
    }
  }
  return failures;
}

bool Finds::is_known(const Failure& failure, const Trial& trial) const {
  const std::multiset<std::string> kinds = kinds_in(trial.faults);
  std::size_t of_property = 0;
  for (const Find& find : finds_) {
    if (find.broke != failure.property) continue;
    const std::multiset<std::string> least = kinds_in(find.trial.faults);
    if (std::ranges::includes(kinds, least)) return true;
    ++of_property;
  }
  return of_property >= kMostOfAProperty;
}

void Finds::go_into(const Failure& failure, const Trial& trial, const TrialOutcome& outcome) {
  ++counts_[failure.property];
  if (is_known(failure, trial)) return;
  const Clock::time_point began = Clock::now();
  console_.err << "case " << failure.index << " breaks " << failure.property << " with " << trial.faults.size()
               << " faults; making it smaller" << std::endl;
  const Shrunk small = shrink(trial, outcome, failure.property, plan_.fleet.scenario,
                              {plan_.fleet.scenario.duration_s - plan_.space.heal_by_s,
                               static_cast<std::size_t>(*plan_.options.jobs), plan_.options.shrink},
                              [this](const std::vector<Trial>& trials) { return flights_.fly(trials); });
  Find find;
  find.name = failure.property + "-" + std::to_string(failure.index);
  find.broke = find.property = failure.property;
  find.index = failure.index;
  find.trial = small.trial;
  find.flights = small.flights;
  find.told = small.outcome.find(failure.property)->text;
  find.digest = small.outcome.digest;
  find.run = fs::absolute(plan_.out) / "finds" / find.name;
  Trial kept = small.trial;
  kept.run.out = find.run;
  flights_.fly_and_keep(kept);
  confirm(find, small.outcome);
  find.wall_s = std::chrono::duration<double>(Clock::now() - began).count();
  write(find);
  finds_.push_back(std::move(find));
}

/// What is found in one process must be so over DDS.
void Finds::confirm(Find& find, const TrialOutcome& outcome) {
  if (!plan_.one_process) return;
  Trial trial = find.trial;
  trial.run.one_process = false;
  const TrialOutcome over_dds = flights_.fly({trial}).front();
  find.over_dds = over_dds.digest == outcome.digest && over_dds.fails(find.property);
  if (find.over_dds) return;
  find.property = kSameDigest;
  find.told = "over DDS it is another run: digest " + (over_dds.digest.empty() ? "none" : over_dds.digest) + ", not " +
              outcome.digest + "; in one process " + find.told;
}

void Finds::write(Find& find) {
  const CapsuleMark mark{find.property, find.digest, SKEIN_VERSION, plan_.options.run.command};
  find.capsule = plan_.out / "finds" / (find.name + ".yaml");
  fs::create_directories(find.capsule.parent_path());
  write_file_atomically(find.capsule,
                        capsule_text(find.name, find.trial, mark, find.property + ": " + find.told, plan_.entries));
}

}  // namespace skein::cli
