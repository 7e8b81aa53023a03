#include "cli/blame_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "cli/fault_tests/fault_test.hpp"
#include "cli/hunt/capsule_run.hpp"
#include "cli/hunt/flights.hpp"
#include "cli/rerun_command.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "host/supervisor.hpp"
#include "process/program.hpp"
#include "results/diff.hpp"
#include "results/run_folder.hpp"
#include "results/run_record.hpp"
#include "run/results_dir.hpp"
#include "signals/radio_log.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// The run to examine, with its faults; and, if it comes from a capsule, the property that failed in it.
struct Subject {
  RunOptions run;
  std::vector<Fault> faults;
  properties::PropertyEntries entries;
  std::optional<std::string> property;
};

Subject subject_of(const BlameOptions& options) {
  Subject subject;
  RunOptions probe;
  probe.scenario = options.what.string();
  if (is_capsule(probe)) {
    const FaultTest test = load_fault_test(options.what, options.assets, options.agent);
    subject.run = test.plan.options;
    subject.faults = test.plan.faults.faults;
    subject.property = test.capsule->property;
    subject.entries = test.entries;
  } else {
    subject.run = options_of_run(options.what);
    if (options.agent) subject.run.agent = options.agent;
    if (options.assets) subject.run.assets = options.assets;
    subject.faults = plan_fleet(subject.run, program_dir(), Processes::one_if_possible).faults.faults;
  }
  subject.run.faults.reset();
  return subject;
}

HuntPlan plan_of(const BlameOptions& options, const Subject& subject) {
  HuntOptions hunt;
  hunt.run = subject.run;
  hunt.run.attainable = hunt.run.report = hunt.run.check = false;
  hunt.run.force = true;
  hunt.run.record = "messages";
  hunt.run.dds = options.dds.value_or(hunt.run.dds);
  hunt.run.one_process = false;  // a large fleet of a capsule; plan_fleet() chooses again
  hunt.jobs = 1;
  const Processes processes = options.dds ? Processes::as_given : Processes::one_if_possible;
  HuntPlan plan{hunt, plan_fleet(hunt.run, program_dir(), processes), subject.entries, {}};
  plan.one_process = plan.fleet.options.one_process;
  plan.fleet.options.duration_s = plan.fleet.scenario.duration_s;
  return plan;
}

std::unique_ptr<ResultsDir> take_folder(const BlameOptions& options) {
  const fs::path runs = fs::is_directory(options.what) ? options.what : fs::path("runs");
  return ResultsDir::take_for_flights(options.out, runs / "blame", options.force);
}

/// One flight from which one cause is removed.
struct Without {
  std::string what;  ///< what was removed, as text for the user
  Trial trial;
  TrialOutcome outcome = {};
  double points = 0.0;                 ///< what the cause cost, in points of the score
  std::optional<double> seconds = {};  ///< how much sooner the lower of the two final scores was reached without it
  std::string parts = {};              ///< text that says where the two runs first differ; empty: nowhere
};

void check_window(const std::vector<double>& window_s, double duration_s) {
  if (window_s.empty() || (window_s[0] >= 0.0 && window_s[0] < window_s[1] && window_s[0] < duration_s)) return;
  throw InputError("--messages " + number_text(window_s[0]) + " " + number_text(window_s[1]) +
                   ": FROM must be before UNTIL, and within the mission of " + number_text(duration_s) + " s");
}

/// Links (source, target) on which a message sent within this time window arrived.
std::set<std::pair<std::string, std::string>> links_used(const fs::path& dir, const Scenario& scenario,
                                                         const std::vector<double>& window_s) {
  std::set<std::pair<std::string, std::string>> links;
  for (const signals::RadioArrival& arrival : signals::read_radio_log(dir, scenario).arrivals) {
    const double sent_s = static_cast<double>(arrival.sent) * scenario.exchange_period_s;
    if (sent_s >= window_s[0] && sent_s < window_s[1]) links.emplace(arrival.stream.source, arrival.target);
  }
  return links;
}

/// @param as_it_was  results folder of the flight from which nothing is removed.
std::vector<Without> flights_without(const HuntPlan& plan, const Subject& subject, const BlameOptions& options,
                                     const fs::path& as_it_was) {
  std::vector<Without> all;
  for (std::size_t i = 0; i < subject.faults.size(); ++i) {
    Trial trial{plan.fleet.options, subject.faults};
    trial.faults.erase(trial.faults.begin() + static_cast<std::ptrdiff_t>(i));
    all.push_back({fault_line(subject.faults[i]), std::move(trial)});
  }
  if (options.messages.empty()) return all;
  const Scenario& scenario = plan.fleet.scenario;
  const std::set<std::pair<std::string, std::string>> used = links_used(as_it_was, scenario, options.messages);
  for (const Node from : scenario.nodes()) {
    for (const Node to : scenario.nodes()) {
      if (!used.contains({scenario.node_name(from), scenario.node_name(to)})) continue;
      LinkEffect effect;
      effect.from = {scenario.node_name(from)};
      effect.to = {scenario.node_name(to)};
      effect.loss = 1.0;
      Trial trial{plan.fleet.options, subject.faults};
      trial.faults.push_back({options.messages[0], options.messages[1], effect});
      all.push_back({"messages from " + effect.from[0] + " to " + effect.to[0], std::move(trial)});
    }
  }
  return all;
}

/// The time at which a run reached a score [s]; nullopt: it never did.
std::optional<double> time_of_score(const results::RunRecord& run, double score) {
  constexpr double kRounding = 1e-6;
  for (const results::ScoreRow& row : run.scores) {
    if (row.score >= score - kRounding) return row.time_s;
  }
  return std::nullopt;
}

/// Fills `points`, `seconds` and `parts`. The removed cause may have lowered the score or raised it.
/// @param there, score  folder and score of the flight with all causes.   @param here  folder of this flight.
void compare(Without& without, const fs::path& there, const fs::path& here, double score) {
  without.points = without.outcome.score - score;
  const results::RunRecord with = results::read_run(there), less = results::read_run(here);
  const double reached = std::min(score, without.outcome.score);
  const auto with_s = time_of_score(with, reached), less_s = time_of_score(less, reached);
  if (with_s && less_s) without.seconds = *with_s - *less_s;
  const auto difference = results::first_difference(there, here);
  if (!difference) return;
  without.parts = fmt::format("the runs first differ at step {} ({} s): {}", difference->step,
                              number_text(difference->time_s), joined(difference->fields));
}

bool is_flown(const TrialOutcome& outcome) { return !outcome.findings.empty(); }

/// Why `skein run` refused to fly. @param dir  folder of the flight
std::string refusal(const fs::path& dir) { return joined(last_lines(dir / run_folder::kFlightLog, 3), "\n"); }

void print(const std::vector<Without>& all, const TrialOutcome& outcome, const Subject& subject,
           const Console& console) {
  console.out << fmt::format("the run as it was flown: score {:.3f}\n", outcome.score);
  const auto tell_property = [&](const TrialOutcome& one, const char* indent) {
    const TrialFinding* finding = subject.property ? one.find(*subject.property) : nullptr;
    if (finding != nullptr) {
      console.out << indent << finding->property << (finding->fails() ? " fails: " : ": ") << finding->text << '\n';
    }
  };
  tell_property(outcome, "  ");
  if (!subject.property && outcome.fails(kCompletes)) console.out << "  " << outcome.find(kCompletes)->text << '\n';
  std::string no_difference;
  if (!all.empty())
    console.out
        << "what the run gains without each of these: points of the score, and how much sooner it reaches the lower of "
           "the two final scores\n";
  for (const Without& without : all) {
    if (without.parts.empty()) {
      no_difference += "            " + without.what + "\n";
      continue;
    }
    console.out << fmt::format("{:+9.3f} points", without.points);
    if (without.seconds) console.out << fmt::format(", {:+.2f} s", *without.seconds);
    console.out << "  without " << without.what << "\n            " << without.parts << '\n';
    tell_property(without.outcome, "            ");
  }
  if (!no_difference.empty())
    console.out << "the run stays the same, bit for bit, without any one of these:\n" << no_difference;
  console.out << std::flush;
}

}  // namespace

void add_blame(CLI::App& app, BlameOptions& blame) {
  CLI::App* command =
      app.add_subcommand("blame", "Show what each fault of a run cost: fly again without it, and compare");
  command->add_option("RUN", blame.what, "Results folder of a run with faults, or a capsule of `skein hunt`")
      ->required();
  command->add_option("--agent", blame.agent, "Agent program with planners of your own, as for `skein run`");
  command->add_option("--assets", blame.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command
      ->add_option("--dds", blame.dds,
                   "Fly as processes over this DDS vendor: cyclonedds, fastdds or mixed (default: in one process where "
                   "possible)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  command
      ->add_option(
          "--messages", blame.messages,
          "FROM UNTIL: also fly without the messages between these simulated times [s], one link after the other")
      ->expected(2);
  command->add_option("--out", blame.out,
                      "Folder of the flights (default: a new one: blame in RUN, or runs/blame for a capsule)");
  command->add_flag("--force", blame.force, "Use a folder that is not empty, and replace the flights in it");
  command->footer(
      "Examples:\n"
      "  skein blame runs/towers-kios-0\n"
      "  skein blame runs/hunt-towers-patrol/finds/all_fly_on-17.yaml --messages 12 14\n\n"
      "See docs/how-to-hunt.md.");
}

int blame(const BlameOptions& options, const Console& console) {
  const Subject subject = subject_of(options);
  if (subject.faults.empty() && options.messages.empty()) {
    throw InputError(options.what.string() +
                     ": this run has no faults; with --messages FROM UNTIL, Skein flies it without the messages of one "
                     "link at a time");
  }
  HuntPlan plan = plan_of(options, subject);
  check_window(options.messages, plan.fleet.scenario.duration_s);
  const std::unique_ptr<ResultsDir> out = take_folder(options);
  plan.out = out->given();
  TrialFlights flights(plan, console);
  Trial as_it_was{plan.fleet.options, subject.faults};
  as_it_was.run.out = out->path() / "as-it-was";
  const TrialOutcome outcome = flights.fly_and_keep(as_it_was);
  // Without this flight, there is nothing to compare the others with.
  if (!is_flown(outcome)) throw InputError("the run cannot be flown again: " + refusal(*as_it_was.run.out));
  std::vector<Without> all = flights_without(plan, subject, options, *as_it_was.run.out);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].trial.run.out = out->path() / ("without-" + std::to_string(i));
    console.err << i + 1 << " of " << all.size() << ": flying without " << all[i].what << std::endl;
    all[i].outcome = flights.fly_and_keep(all[i].trial);
    if (!is_flown(all[i].outcome)) {
      all[i].parts = "it could not be flown: " + refusal(*all[i].trial.run.out);
    } else if (all[i].outcome.fails(kCompletes)) {
      all[i].parts = all[i].outcome.findings[0].text;
    } else {
      compare(all[i], *as_it_was.run.out, *all[i].trial.run.out, outcome.score);
    }
  }
  std::ranges::stable_sort(all, [](const Without& a, const Without& b) { return a.points > b.points; });
  print(all, outcome, subject, console);
  const bool all_flown = std::ranges::all_of(all, [](const Without& one) { return is_flown(one.outcome); });
  return all_flown ? kExitDone : kExitProcessFailed;
}

}  // namespace skein::cli
