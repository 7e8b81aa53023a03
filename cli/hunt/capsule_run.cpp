#include "cli/hunt/capsule_run.hpp"

#include <array>
#include <set>
#include <sstream>

#include "cli/fault_tests/fault_test.hpp"
#include "cli/hunt/trial.hpp"
#include "cli/run_command.hpp"
#include "core/config/config_node.hpp"
#include "core/text/text.hpp"
#include "host/domain_block.hpp"
#include "host/preflight.hpp"
#include "process/json_fields.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "results/run_record.hpp"
#include "run/inputs_outlast.hpp"
#include "run/results_dir.hpp"
#include "signals/judge.hpp"
#include "signals/run_signals.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

std::string digest_in(const fs::path& dir) { return text_in(read_json(dir / run_folder::kResult), "digest"); }

/// Flies a second run for comparison, in a scratch folder. `look` reads the folder before it is deleted.
/// @param how  describes the second run to the user, who sees the messages of both runs
void fly_aside(RunOptions run, const std::string& how, const Console& console, const auto& look) {
  const ScratchDir scratch;
  run.out = scratch.path() / "run";
  run.check = run.report = false;
  std::ostringstream unseen;
  console.err << "second run, " << how << ", for comparison only; the score of the find is that of the first run"
              << std::endl;
  if (run_fleet(run, {unseen, console.err, false}) == kExitInterrupted) throw Interrupted{};
  console.err << "the second run has ended; Skein compares it with the first and deletes its files" << std::endl;
  look(*run.out);
}

struct Replayed {
  bool fails = false;
  std::string text;
};

Replayed judge_property(const FaultTest& test, const fs::path& dir, const Console& console) {
  const results::RunRecord run = results::read_run(dir);
  std::optional<results::RunRecord> without;
  if (signals::needs_undisturbed(test.property_set)) {
    RunOptions undisturbed = test.plan.options;
    undisturbed.faults.reset();
    fly_aside(undisturbed, "without the faults", console,
              [&](const fs::path& aside) { without = results::read_run(aside); });
  }
  signals::FolderSignals signals(run, test.plan.scenario, without ? &*without : nullptr, &test.plan.faults);
  Replayed verdict{false, "the capsule's properties have none of this name"};
  for (const signals::PropertyFinding& found : signals::judge_properties(test.property_set, signals)) {
    if (found.name != test.capsule->property) continue;
    verdict = {found.verdict.outcome == properties::Verdict::Outcome::fails, found.text()};
  }
  return verdict;
}

Replayed judge_digest(const FaultTest& test, const fs::path& dir, const Console& console) {
  Replayed verdict;
  RunOptions other = test.plan.options;
  other.one_process = !other.one_process;
  const std::string digest = digest_in(dir);
  fly_aside(other, other.one_process ? "in one process" : "over DDS", console, [&](const fs::path& aside) {
    const std::string there = digest_in(aside);
    verdict.fails = digest.empty() || there != digest;
    verdict.text = "digest " + digest + ", and " + there + (other.one_process ? " in one process" : " over DDS");
  });
  return verdict;
}

/// A capsule defines all that is flown, and its flights are not watched.
/// @throws InputError for an option that would change this.
void check_options(const RunOptions& options) {
  static const std::set<std::string> kTaken = {"scenario", "dds",   "one-process", "agent",         "assets",
                                               "out",      "force", "record",      "report",        "domain",
                                               "oracle",   "check", "log",         "agent-timeout", "keep-maps"};
  static const std::set<std::string> kDebugging = {"debug", "break-at", "break-on", "break-from", "cores"};
  const Json given = json_of(options), usual = json_of(RunOptions{});
  for (const auto& [name, value] : given.items()) {
    if (kTaken.contains(name) || value == value_or(usual, name.c_str(), nullptr)) continue;
    if (kDebugging.contains(name)) {
      throw InputError("--" + name + " cannot be used with a capsule: fly the capsule, then its results folder again " +
                       "with `skein rerun FOLDER --uav UAV --debug UAV`");
    }
    throw InputError("--" + name + " cannot be used with a capsule, which itself defines the flight; change the " +
                     "flight in a copy of " + options.scenario);
  }
  const std::array others = {std::pair("--place", options.place.at.has_value() || options.place.print),
                             std::pair("--ros-env", options.ros_env.has_value()),
                             std::pair("--view", options.view.at.has_value())};
  for (const auto& [name, is_given] : others) {
    if (is_given)
      throw InputError(std::string(name) +
                       " cannot be used with a capsule, which flies on this host and without a page");
  }
}

}  // namespace

bool is_capsule(const RunOptions& options) {
  const fs::path file = options.scenario;
  if (file.extension() != ".yaml" || !fs::is_regular_file(file)) return false;
  return read_config_document(file).root.find("capsule") != nullptr;
}

std::string comparison_text(const CapsuleMark& mark, const std::string& digest) {
  const std::string found = "found with skein " + mark.skein + (mark.build.empty() ? "" : ", build " + mark.build);
  const std::string here = "this build (skein " SKEIN_VERSION ") ";
  const std::string now = digest.empty() ? "no digest" : "the digest " + digest;
  if (mark.digest.empty() && mark.property == kCompletes) {
    return found + ", in a run without a digest; this run has " + now;
  }
  if (mark.digest.empty()) {
    return found + "; the digest of that run is not known, so Skein cannot tell whether " + here +
           "repeats it: this run has " + now;
  }
  if (digest == mark.digest) return "this is the run that was found, bit for bit (" + found + ")";
  return found + "; " + here + "flies it differently: this run has " + now + ", and that one had " + mark.digest;
}

int run_capsule(const RunOptions& options, const Console& console) {
  check_options(options);
  FaultTest test = load_fault_test(options.scenario, options.assets, options.agent, options.one_process);
  RunOptions& run = test.plan.options;
  const bool over_dds = options.domain || options.dds != RunOptions{}.dds;
  if (over_dds && !options.one_process) check_uavs_over_dds(test.plan.scenario.fleet.size());
  run.dds = options.dds;
  run.out = options.out;
  run.usual_out = fs::path("runs") / test.name;
  run.record = options.record == "none" ? "run" : options.record;  // properties may be about messages
  run.report = options.report;
  run.check = options.check;
  run.domain = options.domain;
  run.threads = options.threads;
  run.log = options.log;
  run.agent_timeout_s = options.agent_timeout_s;
  run.keep_maps_s = options.keep_maps_s;
  run.attainable = run.attainable && options.attainable;
  run.force = options.force;
  run.command = options.command;
  check_outlast({test.file, test.property_file}, results_dir_of(run, test.plan.scenario.name));
  console.err << "first run, the find itself, with its faults" << std::endl;
  const auto [code, dir] = fly_fleet(run, console);
  if (code == kExitInterrupted) throw Interrupted{};
  const CapsuleMark& mark = *test.capsule;
  Replayed verdict{code != kExitDone, "skein run ended with exit code " + std::to_string(code)};
  if (mark.property == kSameDigest) {
    verdict = judge_digest(test, dir, console);
  } else if (mark.property != kCompletes) {
    verdict = judge_property(test, dir, console);
  }
  if (const auto score = number_if_any(read_json(dir / run_folder::kResult), "score")) {
    console.out << "this run, with its faults: score " << fixed(*score, 3) << ", results in " << dir.string() << '\n';
  }
  console.out << mark.property << (verdict.fails ? " fails: " : " holds: ") << verdict.text << '\n';
  console.out << comparison_text(mark, digest_in(dir)) << std::endl;
  return verdict.fails ? kExitCheckFailed : kExitDone;
}

}  // namespace skein::cli
