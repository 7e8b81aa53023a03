#include "cli/sweep/controller.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <ostream>
#include <random>

#include "cli/study/flights.hpp"
#include "core/math/random_stream.hpp"
#include "core/text/sha256.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "host/supervisor.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTries = 3;  ///< successive tries of a unit that complete no further flight of it
/// How often the controller gives the remaining checks to the engine. Once is not enough: the engine may give a check
/// to the node that flew the flight first, and that node does not fly it again.
constexpr std::size_t kMostCheckRounds = 4;
/// This machine flies at most so many of the checks that no other node has flown.
constexpr std::size_t kMostChecksHere = 10;

std::string digest_in(const SweepRow& row) { return text_in(row.figures, "digest"); }

std::string digest_of(const SweepPlan& plan) {
  Sha256 hash;
  for (std::size_t i = 0; i < plan.flights; ++i) hash.add(to_json(plan.flight(i)).dump());
  return hash.hex();
}

std::string new_token(const std::string& plan) {
  std::random_device chance;
  return Sha256().add(plan).add(std::uint64_t{chance()}).add(std::uint64_t{chance()}).hex().substr(0, 12);
}

}  // namespace

bool is_checked(std::size_t index, std::size_t flights) {
  if (flights < kCheckedShare) return index == flights / 2;
  // One flight of each kCheckedShare, at a random place among them. If it were always the same place, all checked
  // flights might have the same seed: a study may repeat its seeds with this period.
  return RandomStream(1, "checked flight", index / kCheckedShare).bits() % kCheckedShare == index % kCheckedShare;
}

void SweepController::plan(const SweepPlan& plan, bool anew) {
  const std::string digest = digest_of(plan);
  const auto former = folder_.settings();
  if (former && former->plan == digest && former->sizes.flights == plan.flights) {
    settings_ = *former;
    if (settings_.command != plan.command || settings_.working_folder != plan.working_folder) {
      settings_.command = plan.command;
      settings_.working_folder = plan.working_folder;
      folder_.write_settings(settings_);
    }
    mend_units(plan);
    reopen_what_must_fly(anew);
    if (!anew) return;
    folder_.write_tries({});
    folder_.forget_sick();
    return;
  }
  if (former) engine_.cancel();
  begin(plan, digest);
}

void SweepController::begin(const SweepPlan& plan, const std::string& digest_of_plan) {
  settings_ = {};
  settings_.token = new_token(digest_of_plan);
  settings_.plan = digest_of_plan;
  settings_.command = plan.command;
  settings_.working_folder = plan.working_folder;
  const auto former = folder_.settings();
  // Nodes that have reproduced this reference flight in the former sweep need not fly it again. The rounds of a hunt,
  // for example, share one reference flight.
  const bool is_known = former && std::ranges::any_of(plan.references, [&](const SweepFlight& flight) {
                          return to_json(flight) == to_json(former->reference);
                        });
  if (is_known) {
    settings_.reference = former->reference;
    settings_.digest = former->digest;
    settings_.reference_s = former->reference_s;
  } else {
    fly_a_reference(plan);
  }
  settings_.sizes = plan.unit_sizes(settings_.reference_s);
  folder_.forget_sick();
  folder_.begin(settings_, is_known, [&](std::size_t number) { return planned_unit(plan, number); });
  for (std::size_t number = 0; number < settings_.units(); ++number) close_what_is_flown(number, &say_);
}

/// Flies the candidates for the reference flight in their order until one succeeds, so that a planner that always fails
/// does not prevent the sweep. @throws NodeTrouble if all fail.
void SweepController::fly_a_reference(const SweepPlan& plan) {
  for (const SweepFlight& flight : plan.references) {
    const auto began = std::chrono::steady_clock::now();
    try {
      settings_.digest = fly_reference(folder_, flight, here_);
    } catch (const NodeTrouble&) {
      if (&flight == &plan.references.back()) throw;
      continue;
    }
    settings_.reference = flight;
    settings_.reference_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return;
  }
}

void SweepController::look() {
  const auto settings = folder_.settings();
  if (!settings) throw InputError(folder_.why_no_settings());
  settings_ = *settings;
}

bool SweepController::fly() {
  for (;;) {
    judge_checks();
    remove_quarantined();
    const std::set<std::string> before = nodes_to_avoid();
    EngineWork work{within_tries(open_units()), before};
    const bool checks_follow = !work.units.empty();
    if (work.units.empty()) work = checks_elsewhere();
    if (work.units.empty() && check_here()) continue;
    if (work.units.empty()) break;
    const auto more = [&] { return checks_follow ? checks_elsewhere() : EngineWork{}; };
    if (!engine_.fly(work, {[this] { tell_progress(); }, more})) return false;
    tell_progress();
    // A node with a problem fails each of its units at once, so the engine may have given it many units before it was
    // quarantined or noted as sick. These tries say nothing about the units.
    if (nodes_to_avoid() != before) folder_.write_tries({});
  }
  folder_.remove_unfinished();
  return true;
}

std::set<std::string> SweepController::nodes_to_avoid() const {
  std::set<std::string> nodes = folder_.quarantined_nodes();
  nodes.merge(folder_.sick_nodes());
  return nodes;
}

std::vector<std::size_t> SweepController::open_units() const {
  const std::set<std::size_t> done = folder_.done(settings_.token);
  std::vector<std::size_t> open;
  for (std::size_t unit = 0; unit < settings_.units(); ++unit) {
    if (!done.contains(unit)) open.push_back(unit);
  }
  return open;
}

/// The units that have tries left; counts one more try of each. If flights of a unit have been completed since its last
/// try, it has all its tries again, because the engine's time limit may interrupt a unit many times.
std::vector<std::size_t> SweepController::within_tries(const std::vector<std::size_t>& units) const {
  std::map<std::size_t, SweepFolder::Tries> tries = folder_.tries();
  std::vector<std::size_t> within;
  for (const std::size_t unit : units) {
    const std::vector<SweepFlight> flights = folder_.unit(unit).flights;
    const auto flown = static_cast<std::size_t>(
        std::ranges::count_if(flights, [](const SweepFlight& flight) { return fs::exists(flight.dir / kFlightMark); }));
    SweepFolder::Tries& tried = tries[unit];
    if (flown > tried.flown) tried.tries = 0;
    tried.flown = flown;
    if (tried.tries >= kMostTries) continue;
    ++tried.tries;
    within.push_back(unit);
  }
  if (!within.empty()) folder_.write_tries(tries);
  return within;
}

SweepFlight SweepController::flight(std::size_t index) const {
  const std::size_t unit = settings_.sizes.unit_of(index);
  return folder_.unit(unit).flights.at(index - settings_.sizes.first(unit));
}

/// The flights to check (is_checked()) that have a result, but have not been flown again on a second node yet.
std::vector<SweepFlight> SweepController::unchecked_flights() const {
  std::vector<SweepFlight> unchecked;
  const std::size_t flights = settings_.sizes.flights;
  for (std::size_t index = 0; index < flights; ++index) {
    if (!is_checked(index, flights)) continue;
    const auto rows = folder_.rows(settings_.token, settings_.sizes.unit_of(index));
    if (!rows) continue;
    const auto row = std::ranges::find(*rows, index, &SweepRow::index);
    if (row == rows->end() || digest_in(*row).empty()) continue;
    const auto check = folder_.check(settings_.token, index);
    if (check && check->first_node == row->node && check->first_digest == digest_in(*row)) continue;
    unchecked.push_back(flight(index));
  }
  return unchecked;
}

/// Writes extra units, numbered after those of the sweep, with the unchecked flights. A node that gets such a unit
/// flies only those of its flights that another node flew first. @returns their numbers; none if there is no second
/// node, or after kMostCheckRounds.
std::vector<std::size_t> SweepController::units_of_checks() const {
  if (!engine_.has_other_nodes() || engine_.lacks_nodes() || folder_.nodes().size() < 2) return {};
  const std::size_t first = settings_.units();
  std::map<std::size_t, SweepFolder::Tries> tries = folder_.tries();
  std::size_t& rounds = tries[first].tries;  // the tries of the first extra unit count the rounds
  const std::vector<SweepFlight> flights = unchecked_flights();
  if (flights.empty() || rounds == kMostCheckRounds) return {};
  ++rounds;
  folder_.write_tries(tries);
  std::vector<std::size_t> units;
  for (std::size_t i = 0; i < flights.size(); i += settings_.sizes.size) {
    const std::size_t number = first + units.size(), end = std::min(i + settings_.sizes.size, flights.size());
    const auto begin = flights.begin();
    folder_.add_unit(number,
                     {{begin + static_cast<std::ptrdiff_t>(i), begin + static_cast<std::ptrdiff_t>(end)}, true});
    if (folder_.rows(settings_.token, number)) folder_.reopen(settings_.token, number);
    units.push_back(number);
  }
  return units;
}

EngineWork SweepController::checks_elsewhere() {
  const std::set<std::string> avoided = nodes_to_avoid();
  EngineWork work{units_of_checks(), avoided};
  work.not_on.merge(nodes_of_no_use(work.units, avoided));
  return work;
}

/// If a single node flew all flights of these units first, it cannot check any of them. @returns this node if another
/// node may fly, otherwise an empty set.
std::set<std::string> SweepController::nodes_of_no_use(const std::vector<std::size_t>& checks,
                                                       const std::set<std::string>& avoided) const {
  std::set<std::string> flew, others;
  for (const std::size_t unit : checks) {
    for (const SweepFlight& flight : folder_.unit(unit).flights) {
      if (const auto first = row_in_place(folder_, flight, here_)) flew.insert(first->node);
    }
  }
  if (flew.size() != 1) return {};
  for (const std::string& node : folder_.nodes()) {
    if (!avoided.contains(node) && !flew.contains(node)) others.insert(node);
  }
  return others.empty() ? std::set<std::string>{} : flew;
}

/// Flies a flight again on this machine. @returns its digest; nullopt, with a message, if it fails here. Then it is not
/// tried again, and the sweep goes on without the check.
std::optional<std::string> SweepController::flown_again(const SweepFlight& flight) {
  if (fails_here_.contains(flight.index)) return std::nullopt;
  try {
    return digest_here(folder_, flight, here_);
  } catch (const NodeTrouble& trouble) {
    fails_here_.insert(flight.index);
    say_ << trouble.what() << "; its digest is not checked here" << std::endl;
    return std::nullopt;
  }
}

/// Flies the remaining checks on this machine, without those of flights that this machine flew first: at most
/// kMostChecksHere in the life of this object. @returns whether it has flown any.
bool SweepController::check_here() {
  if (!engine_.has_other_nodes()) return false;
  bool any = false;
  for (const SweepFlight& flight : unchecked_flights()) {
    const auto first = row_in_place(folder_, flight, here_);
    if (!first || first->node == here_.name || fails_here_.contains(flight.index)) continue;
    if (checked_here_ == kMostChecksHere) break;
    ++checked_here_;
    const auto digest = flown_again(flight);
    if (!digest) continue;
    folder_.write_check(settings_.token, {flight.index, here_.name, *digest, first->node, digest_in(*first)});
    any = true;
  }
  return any;
}

void SweepController::judge_checks() {
  for (const std::size_t index : folder_.checks(settings_.token)) {
    const auto check = folder_.check(settings_.token, index);
    if (check && check->digest != check->first_digest) judge(*check);
  }
}

/// Two nodes have different digests of a flight. To find out which of them is wrong, this machine flies the flight
/// twice. If its own two digests are equal, it quarantines each node with another digest. If not, the flight is not
/// repeatable, and neither node is to blame. If the flight fails here, the check stays for a later call of the command.
void SweepController::judge(const SweepCheck& check) {
  const SweepFlight disputed = flight(check.index);
  const auto first = flown_again(disputed), second = first ? flown_again(disputed) : std::nullopt;
  if (!second) return;
  const std::string& here = *first;
  if (*second != here) {
    say_ << disputed.dir.string()
         << ": its digest is different each time that it is flown here, so it is not repeatable: see "
            "`skein check-planner`\n";
  } else {
    for (const auto& [node, digest] :
         {std::pair(check.first_node, check.first_digest), std::pair(check.node, check.digest)}) {
      if (digest == here) continue;
      folder_.quarantine(node, fmt::format("{} has the digest {} there, and {} on {}", disputed.dir.string(), digest,
                                           here, here_.name));
    }
  }
  folder_.forget_check(settings_.token, check.index);
}

/// Moves the flights of quarantined nodes to aside/, so that they never count and other nodes fly them again. Also
/// moves those of units that are not over.
void SweepController::remove_quarantined() {
  const std::set<std::string> nodes = folder_.quarantined_nodes();
  if (nodes == removed_) return;
  for (const std::string& node : nodes) {
    if (!removed_.contains(node)) {
      say_ << "no result of the node " << node << " counts: " << folder_.quarantined(node).value_or("") << std::endl;
    }
  }
  for (std::size_t unit = 0; unit < settings_.units(); ++unit) {
    bool any = false;
    for (const SweepFlight& flight : folder_.unit(unit).flights) {
      const Json mark = read_json(flight.dir / kFlightMark);
      if (!nodes.contains(text_in(mark, "node"))) continue;
      folder_.set_aside(flight.dir);
      any = true;
    }
    const auto rows = folder_.rows(settings_.token, unit);
    any = any || (rows && std::ranges::any_of(*rows, [&](const SweepRow& row) { return nodes.contains(row.node); }));
    if (any && rows) folder_.reopen(settings_.token, unit);
  }
  removed_ = nodes;
}

void SweepController::collect(const std::function<void(SweepRow row)>& take) const {
  for (std::size_t unit = 0; unit < settings_.units(); ++unit) {
    if (auto rows = folder_.rows(settings_.token, unit)) {
      for (SweepRow& row : *rows) take(std::move(row));
      continue;
    }
    for (const SweepFlight& flight : folder_.unit(unit).flights) {
      if (auto row = row_in_place(folder_, flight, here_)) take(std::move(*row));
    }
  }
}

std::map<std::size_t, std::string> SweepController::failed() const {
  std::map<std::size_t, std::string> failed;
  for (const std::size_t unit : open_units()) {
    const std::vector<std::string> last = last_lines(folder_.log_of(unit), 1);
    failed[unit] = last.empty() ? "" : last.back();
  }
  return failed;
}

std::vector<std::string> SweepController::findings() const {
  std::vector<std::string> lines;
  for (const std::string& node : folder_.quarantined_nodes()) {
    lines.push_back("no result of the node " + node + " counts: " + folder_.quarantined(node).value_or(""));
  }
  const std::vector<std::string> nodes = folder_.nodes();
  const std::size_t count = std::set<std::string>(nodes.begin(), nodes.end()).size();
  lines.push_back(counted(count, "node") + "; " + text_of_checks());
  return lines;
}

/// What the checks have shown. A user who only looks at a sweep may see digests that differ and are not judged yet.
std::string SweepController::text_of_checks() const {
  std::size_t checks = 0, different = 0;
  for (const std::size_t index : folder_.checks(settings_.token)) {
    const auto check = folder_.check(settings_.token, index);
    if (!check) continue;
    ++checks;
    if (check->digest != check->first_digest) ++different;
  }
  if (checks == 0) return "no flight was flown again on a second node";
  const std::string flown = counted(checks, "flight") + " flown again elsewhere, ";
  if (different == 0) return flown + "each with the same digest";
  return flown + fmt::format("{} with another digest: continue the study to find out which node is wrong", different);
}

void SweepController::tell_progress() {
  const std::set<std::size_t> done = folder_.done(settings_.token);
  const auto over = static_cast<std::size_t>(std::distance(done.begin(), done.lower_bound(settings_.units())));
  if (over == told_) return;
  told_ = over;
  say_ << fmt::format("{} of {} units are over", over, settings_.units()) << std::endl;
}

}  // namespace skein::cli
