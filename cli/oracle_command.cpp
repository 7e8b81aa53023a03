#include "cli/oracle_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <iomanip>

#include "core/text/number_checks.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/drawn_world.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

/// `skein run` asks for an answer that is not in the cache only if computing it takes no longer than this [s].
constexpr double kPatienceS = 10.0;
constexpr std::size_t kMostLines = 20;  ///< lines of the program's output that are kept

/// What the oracle is asked about a scenario.
struct Question {
  std::string scenario;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::size_t> uavs;
  std::optional<std::filesystem::path> assets;
  std::optional<std::string> rules;
  std::vector<double> clearances_m;  ///< empty: the oracle's own
  bool vehicle = false;
  std::optional<double> patience_s;
  bool plan = false;
};

struct Asked {
  Json answers;  ///< one for each clearance; empty when the program left none
  ExitStatus exit;
  std::string said;
};

Asked ask(const Question& question) {
  const ScratchDir scratch;
  const std::filesystem::path answer = scratch.path() / "oracle.json", log = scratch.path() / "oracle.log";
  std::vector<std::string> argv = {program_dir() / programs::kSimServer, "--scenario",
                                   scenario_source(question.scenario, question.scene_seed, question.uavs), "--oracle",
                                   answer};
  if (question.scene_seed) argv.insert(argv.end(), {"--scene-seed", std::to_string(*question.scene_seed)});
  if (question.uavs) argv.insert(argv.end(), {"--uavs", std::to_string(*question.uavs)});
  if (question.assets) argv.insert(argv.end(), {"--assets", *question.assets});
  if (question.rules) argv.insert(argv.end(), {"--rules", *question.rules});
  std::string clearances;
  for (const double clearance_m : question.clearances_m)
    clearances += (clearances.empty() ? "" : ",") + number_text(clearance_m);
  if (!clearances.empty()) argv.insert(argv.end(), {"--clearance", clearances});
  if (question.vehicle) argv.emplace_back("--vehicle");
  if (question.plan) argv.emplace_back("--plan");
  if (question.patience_s) argv.insert(argv.end(), {"--oracle-patience", std::to_string(*question.patience_s)});
  Asked asked;
  // With a run's environment, hence the same libm and the same answer.
  asked.exit = run_to_end({programs::kSimServer, argv, fleet_environment(false), log});
  asked.answers = value_or(read_json(answer), "rows", Json::array());
  for (const std::string& line : last_lines(log, kMostLines)) asked.said += (asked.said.empty() ? "" : "\n") + line;
  return asked;
}

Json points_and_score(const Json& part) {
  return {{"points", value_or(part, "points", nullptr)}, {"score", value_or(part, "score", nullptr)}};
}

std::string metres(double value) { return number_text(value) + " m"; }

/// Points, score, and the change of the score with twice as many viewpoints [%].
std::string figures(const Json& part) {
  return fmt::format("{:>10}{:>12.1f}{:>+10.2f} %", value_or(part, "points", 0).get<std::size_t>(),
                     number_in(part, "score"), number_in(part, "change_percent"));
}

void print_one(std::ostream& out, const Json& answer, bool outside_only) {
  out << "              points       score   change with twice as many viewpoints\n";
  const auto row = [&](const char* name) {
    out << std::left << std::setw(10) << name << std::right << figures(value_or(answer, name, Json::object())) << '\n';
  };
  if (!outside_only) row("reachable");
  row("outside");
}

/// A share of the estimate, as text for the user.
std::string share_of(double score, double estimate) {
  return estimate > 0.0 ? fmt::format(" ({:.1f} % of reachable)", 100.0 * score / estimate) : std::string();
}

std::size_t number_of(const Json& object, const char* key) { return value_or(object, key, 0).get<std::size_t>(); }

std::string score_line(const char* name, const Json& part, double estimate) {
  return fmt::format("{:<8}{:>9.1f}{}, {} points", name, number_in(part, "score"),
                     share_of(number_in(part, "score"), estimate), number_of(part, "points"));
}

/// Prints the score that a plan with full knowledge reaches in the mission time.
void print_plan(std::ostream& out, const Json& answer) {
  const Json plan = value_or(answer, "plan", Json::object()), flown = value_or(plan, "flown", Json::object());
  const double estimate = number_in(value_or(answer, "reachable", Json::object()), "score");
  out << "\nWith full knowledge in the mission's time, a lower bound found by search:\n"
      << score_line("planned", plan, estimate) << fmt::format(" from {} views\n", number_of(plan, "views"))
      << score_line("flown", flown, estimate)
      << fmt::format(", collisions: {}, at most {:.2f} m off the plan\n", number_of(flown, "collisions"),
                     number_in(flown, "astray_m"));
  for (const Json& uav : value_or(plan, "uavs", Json::array())) {
    out << fmt::format("  {:<12}{:>5} views{:>8.1f} s{:>9.1f} m\n", text_in(uav, "name"), number_of(uav, "views"),
                       number_in(uav, "time_s"), number_in(uav, "distance_m"));
  }
  out << std::flush;
}

/// The part of an answer that --json prints: without the values of each point, and with the plan only on request.
Json for_programs(Json answer, bool plan) {
  if (!plan) answer.erase("plan");
  answer.erase("estimate");
  answer.erase("flyable");
  return answer;
}

void print_several(std::ostream& out, const Json& answers, bool outside_only) {
  const std::string gap(3, ' ');
  out << "          " << (outside_only ? "" : " reachable                           " + gap) << "   outside\n"
      << "clearance ";
  for (int part = outside_only ? 1 : 0; part < 2; ++part)
    out << "    points       score      change" << (part == 0 ? gap : "");
  out << '\n';
  for (const Json& answer : answers) {
    out << std::right << std::setw(7) << number_text(value_or(answer, "clearance_m", 0.0)) << " m ";
    if (!outside_only) out << figures(value_or(answer, "reachable", Json::object())) << ' ';
    out << figures(value_or(answer, "outside", Json::object())) << '\n';
  }
  out << "\nchange     by twice as many viewpoints";
}

/// The command with which the user asks about the scene of a run.
std::string oracle_line(const RunOptions& run) {
  std::vector<std::string> words = {"skein", "oracle", run.scenario};
  if (run.scene_seed) words.insert(words.end(), {"--scene-seed", std::to_string(*run.scene_seed)});
  if (run.assets) words.insert(words.end(), {"--assets", *run.assets});
  if (run.rules) words.insert(words.end(), {"--rules", *run.rules});
  return shell_line(words);
}

}  // namespace

void add_oracle(CLI::App& app, OracleOptions& oracle) {
  CLI::App* command =
      app.add_subcommand("oracle", "Compute the score that is attainable with full knowledge of the scene");
  command->add_option("SCENARIO", oracle.scenario, "A name under config/scenarios/ or a YAML file")->required();
  command->add_option("--scene-seed", oracle.scene_seed, "Number of the variant of a procedural scenario")
      ->check(CLI::Validator(check_seed, ""));
  command->add_option("--assets", oracle.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--rules", oracle.rules,
                      "Preset of rules, instead of the scenario's: contest, paper or reference");
  command
      ->add_option("--clearance", oracle.clearances_m,
                   "Least distance of the cameras from the structure [m] (default 0.5); several values, such as "
                   "0.5,0.8,1.2, give a table")
      ->delimiter(',')
      ->check(CLI::Validator(number_within(0.0, 100.0), ""));
  command->add_flag(
      "--vehicle", oracle.vehicle,
      "Apply the clearance to a sphere around body and rotors, not to the camera (--clearance is then 0 m by default)");
  command->add_flag("--outside", oracle.outside_only,
                    "Count only what is attainable from outside the structure, not through windows");
  command->add_flag("--plan", oracle.plan,
                    "Also compute what this fleet could score in the mission's time with full knowledge: a lower bound "
                    "found by search, which Skein flies once as proof");
  command->add_flag("--json", oracle.json, "Print all figures as JSON, for programs");
  command->footer("Example:\n  skein oracle towers --clearance 0.5,0.8,1.2");
}

Json attainable_from(const Json& answer) {
  const Json reachable = value_or(answer, "reachable", nullptr);
  if (!reachable.is_object()) return nullptr;
  Json attainable = points_and_score(reachable);
  attainable["clearance_m"] = value_or(answer, "clearance_m", nullptr);
  attainable["outside"] = points_and_score(value_or(answer, "outside", nullptr));
  if (const Json plan = value_or(answer, "plan", nullptr); plan.is_object()) {
    attainable["plan"] = points_and_score(plan);
    attainable["plan"]["flown_score"] = value_or(value_or(plan, "flown", Json::object()), "score", nullptr);
  }
  return attainable;
}

AttainableAnswer attainable_of(const RunOptions& run) try {
  const Asked asked =
      ask({run.scenario, run.scene_seed, run.uavs, run.assets, run.rules, {}, false, kPatienceS, false});
  if (!asked.exit.ok()) return {nullptr, nullptr, "the oracle failed: " + asked.exit.text() + "\n" + asked.said};
  if (asked.answers.empty()) return {};
  const Json attainable = attainable_from(asked.answers.front());
  if (attainable.is_null()) {
    return {nullptr, nullptr,
            "what is attainable here takes a while to compute: `" + oracle_line(run) + "` does it once"};
  }
  return {attainable, asked.answers.front(), ""};
} catch (const Interrupted&) {
  return {};
} catch (const std::exception& error) {
  return {nullptr, nullptr, std::string("the oracle failed: ") + error.what()};
}

void print_oracle(std::ostream& out, const std::string& scenario, const Json& answers, bool outside_only) {
  const Json& first = answers.front();
  const bool vehicle = value_or(first, "vehicle", false);
  out << scenario << ": " << value_or(first, "points_total", 0) << " interest points, "
      << (vehicle ? "UAVs" : "cameras") << ' '
      << (answers.size() == 1 ? metres(value_or(first, "clearance_m", 0.0)) + " clear" : std::string("keeping clear"))
      << " of the structure\n\n";
  if (answers.size() == 1) {
    print_one(out, first, outside_only);
  } else {
    print_several(out, answers, outside_only);
    out << '\n';
  }
  out << '\n';
  if (!outside_only) {
    out << "reachable  from all places that a " << (vehicle ? "whole UAV" : "camera")
        << " can reach from above or from its start without coming nearer to the structure\n";
  }
  const double berth = value_or(first, "outside_berth_m", 0.0);
  out << "outside    only from outside all openings less than " << metres(2.0 * berth) << " wide" << std::endl;
}

int consult_oracle(const OracleOptions& options, const Console& console) {
  const Asked asked = ask({options.scenario,
                           options.scene_seed,
                           {},
                           options.assets,
                           options.rules,
                           options.clearances_m,
                           options.vehicle,
                           {},
                           options.plan});
  if (asked.exit.code == kExitBadInput) throw InputError(asked.said);
  if (!asked.exit.ok() || asked.answers.empty()) {
    throw std::runtime_error("sim_server --oracle ended with " + asked.exit.text() + "\n" + asked.said);
  }
  if (!asked.said.empty()) console.err << asked.said << std::endl;
  if (!options.json) {
    print_oracle(console.out, options.scenario, asked.answers, options.outside_only);
    if (options.plan) print_plan(console.out, asked.answers.front());
    return kExitDone;
  }
  Json rows = Json::array();
  for (const Json& answer : asked.answers) rows.push_back(for_programs(answer, options.plan));
  console.out << (rows.size() == 1 ? rows.front() : Json{{"rows", rows}}).dump(2) << std::endl;
  return kExitDone;
}

}  // namespace skein::cli
