#include "cli/sweep/this_machine.hpp"

#include <cstdlib>
#include <fstream>
#include <memory>
#include <ostream>

#include "cli/study/figures.hpp"
#include "cli/study/figures_json.hpp"
#include "cli/study/flights.hpp"
#include "cli/study/made_under.hpp"
#include "cli/study/side_by_side.hpp"
#include "cli/sweep_options.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "host/machine.hpp"
#include "host/preflight.hpp"
#include "process/host/host_name.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"
#include "run/run_options.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// An id that changes with each boot. A node with a known name but another id may be another machine.
std::string boot_id() {
  std::ifstream in("/proc/sys/kernel/random/boot_id");
  std::string id;
  std::getline(in, id);
  return id;
}

/// Compares this machine's programs and files with those that the plan of the sweep records (`made_under`). It compares
/// only once for all flights that differ only in seed or case.
class Likeness {
 public:
  std::string unlike(const SweepFlight& flight) {
    Json then = flight.made_under;
    for (const char* own : {"seed", "case"}) then.erase(own);
    const auto [known, is_new] = known_.try_emplace(then.dump());
    if (is_new) known->second = differences(then, flight.run);
    return known->second;
  }

 private:
  std::string differences(const Json& then, const RunOptions& run) try {
    const Json now = made_under_.of(plan_fleet(run, program_dir()));
    std::vector<std::string> what;
    const auto differs = [&](const char* key) { return value_or(now, key, nullptr) != value_or(then, key, nullptr); };
    if (differs("skein_version") || differs("programs"))
      what.emplace_back("the programs here are not of the build that flies the study");
    if (differs("agent")) what.emplace_back("the agent program here is not of the build that flies the study");
    if (differs("input")) what.emplace_back("the generated world or a file of the scenario differs here");
    if (what.empty() && now != then) what.emplace_back("the flight here would have other settings: " + now.dump());
    return what.empty() ? "" : joined(what, "; ") + " (" + run.scenario + ", " + run.planner + ")";
  } catch (const InputError& error) {
    return error.what();
  }

  MadeUnder made_under_;
  std::map<std::string, std::string> known_;
};

}  // namespace

std::string node_name() {
  for (const char* variable : {"SKEIN_NODE", "SLURMD_NODENAME"}) {
    if (const char* name = ::getenv(variable); name != nullptr && *name != '\0') return name;
  }
  return host_name("host");
}

SweepNode this_machine(const Console& console) {
  const auto likeness = std::make_shared<Likeness>();
  SweepNode node{node_name(), boot_id(), cpu_model(), {}, {}, {}, {}};
  node.fly = [&console](const SweepFlight& flight, const fs::path& out) {
    SideBySide side_by_side(1, console);
    ExitStatus end;
    RunOptions run = flight.run;
    run.out = out;
    run.force = true;
    const auto start = [&](std::size_t) { return flight_program(run); };
    if (!side_by_side.fly({0}, start, [&](std::size_t, const ExitStatus& exit) { end = exit; })) throw Interrupted{};
    return end;
  };
  node.unlike = [likeness](const SweepFlight& flight) { return likeness->unlike(flight); };
  node.figures = [](const Json& result) { return to_json(figures_of(result)); };
  node.reason = [](const fs::path& out, const ExitStatus& exit) {
    return problem_of(out, read_json(out / run_folder::kResult), exit);
  };
  return node;
}

int run_unit(const UnitOptions& options, const Console& console) try {
  const SweepFolder folder(options.study);
  fly_unit(folder, options.unit, this_machine(console), console.out);
  return kExitDone;
} catch (const NodeTrouble& trouble) {
  console.err << node_name() << ": " << trouble.what() << std::endl;
  return kExitProcessFailed;
} catch (const Interrupted&) {
  console.err << node_name() << ": ended by a signal; the study keeps the flights completed so far" << std::endl;
  return kExitInterrupted;
}

}  // namespace skein::cli
