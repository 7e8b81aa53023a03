#include "cli/hunt/finds.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "core/scenario/scenario_reader.hpp"
#include "process/files/atomic_file.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::multiset<std::string> kinds_in(const std::vector<Fault>& faults) {
  std::multiset<std::string> kinds;
  for (const Fault& fault : faults) kinds.insert(fault_kind(fault));
  return kinds;
}

/// How long a mission must go on after its last fault, so that this property can be evaluated [s]. nullopt: the
/// property may be evaluated at any time, as for a collision; one with a deadline after the faults needs the time.
std::optional<double> after_s(const std::string& property, const HuntPlan& plan) {
  using When = properties::Property::Kind;
  const properties::PropertySet set = properties::parse_properties(plan.entries, plan.fleet.scenario);
  const auto found = std::ranges::find(set, property, &properties::NamedProperty::name);
  const bool at_any_time = found == set.end() || std::ranges::all_of(found->cases, [](const properties::Property& one) {
                             return (one.kind == When::always || one.kind == When::never) && !one.whenever &&
                                    one.window.from != properties::Window::From::heal;
                           });
  if (at_any_time) return std::nullopt;
  return plan.fleet.scenario.duration_s - plan.space.heal_by_s;
}

/// The file beside a capsule that has the other figures of the find.
fs::path notes_of(const Find& find) {
  fs::path file = find.capsule;
  return file.replace_extension(".json");
}

}  // namespace

Json Find::to_json() const {
  return {{"property", property}, {"told", told},     {"digest", digest},
          {"flights", flights},   {"wall_s", wall_s}, {"over_dds", over_dds}};
}

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
  Find find;
  find.name = failure.property + "-" + std::to_string(failure.index);
  find.broke = find.property = failure.property;
  find.index = failure.index;
  find.run = fs::absolute(plan_.out) / "finds" / find.name;
  find.capsule = plan_.out / "finds" / (find.name + ".yaml");
  const std::string of = trial.text() + outcome.digest + " shrink " + std::to_string(plan_.options.shrink);
  if (auto before = made_before(find, of)) {
    finds_.push_back(std::move(*before));
    return;
  }
  console_.err << "case " << failure.index << " breaks " << failure.property << " with " << trial.faults.size()
               << " faults; minimising it" << std::endl;
  make_small(find, trial, outcome);
  write(find, of);
  finds_.push_back(std::move(find));
}

void Finds::make_small(Find& find, const Trial& trial, const TrialOutcome& outcome) {
  const Clock::time_point began = Clock::now();
  flights_.ask(find.broke);
  const Shrunk small =
      shrink(trial, outcome, find.broke, plan_.fleet.scenario,
             {after_s(find.broke, plan_), static_cast<std::size_t>(*plan_.options.jobs), plan_.options.shrink},
             [this](const std::vector<Trial>& trials) { return flights_.fly(trials); });
  find.trial = small.trial;
  find.flights = small.flights;
  find.told = small.outcome.find(find.broke)->text;
  find.digest = small.outcome.digest;
  Trial kept = small.trial;
  kept.run.out = find.run;
  flights_.fly_and_keep(kept);
  confirm(find, small.outcome);
  flights_.ask("");
  find.wall_s = std::chrono::duration<double>(Clock::now() - began).count();
}

/// The find of the same failure that an earlier, interrupted call of this hunt has written. nullopt: there is none, or
/// its files are missing or damaged.
/// @param of  identifies the trial, its outcome and the options of minimising
std::optional<Find> Finds::made_before(const Find& find, const std::string& of) const try {
  const Json notes = read_json(notes_of(find));
  if (value_or(notes, "of", nullptr) != of || !fs::exists(find.capsule)) return std::nullopt;
  const RunOptions& run = plan_.fleet.options;
  const FaultTest test = load_fault_test(find.capsule, run.assets, run.agent, run.one_process);
  Find before = find;
  before.trial = {test.plan.options, test.plan.faults.faults};
  before.trial.run.faults.reset();
  before.property = notes.at("property").get<std::string>();
  before.told = notes.at("told").get<std::string>();
  before.digest = notes.at("digest").get<std::string>();
  before.flights = notes.at("flights").get<std::size_t>();
  before.wall_s = notes.at("wall_s").get<double>();
  before.over_dds = notes.at("over_dds").get<bool>();
  return before;
} catch (const InputError&) {
  return std::nullopt;
} catch (const Json::exception&) {
  return std::nullopt;
}

/// Flies a find of a hunt in one process again over DDS, unless the fleet is too large for it. If the two runs differ,
/// the find becomes one of kSameDigest.
void Finds::confirm(Find& find, const TrialOutcome& outcome) {
  if (!plan_.one_process || plan_.fleet.scenario.fleet.size() > kMostUavsOverDds) return;
  Trial trial = find.trial;
  trial.run.one_process = false;
  const TrialOutcome over_dds = flights_.fly({trial}).front();
  find.over_dds = over_dds.digest == outcome.digest && over_dds.fails(find.property);
  if (find.over_dds) return;
  find.property = kSameDigest;
  find.told = "the flight has the digest " + (over_dds.digest.empty() ? "none" : over_dds.digest) + " over DDS, and " +
              outcome.digest + " in one process: " + find.told;
}

/// Writes the notes last, because made_before() takes a find without notes as missing.
void Finds::write(const Find& find, const std::string& of) const {
  const CapsuleMark mark{find.property, find.digest, SKEIN_VERSION, build_of(plan_), plan_.options.run.command};
  fs::create_directories(find.capsule.parent_path());
  write_file_atomically(find.capsule,
                        capsule_text(find.name, find.trial, mark, find.property + ": " + find.told, plan_.entries));
  Json notes = find.to_json();
  notes["of"] = of;
  write_file_atomically(notes_of(find), json_text(notes, 2) + "\n");
}

}  // namespace skein::cli
