#include "cli/oracle_command.hpp"

#include <iomanip>
#include <sstream>

#include "cli/environment.hpp"
#include "cli/fleet_plan.hpp"
#include "cli/preflight.hpp"
#include "core/program.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// `skein run` asks for what is not in the cache only where it takes no longer [s].
constexpr double kPatienceS = 10.0;
constexpr std::size_t kMostLines = 20;  ///< of what the program said

/// What the oracle is asked about a scenario.
struct Question {
  std::string scenario;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::filesystem::path> assets;
  std::optional<double> clearance_m, patience_s;
};

struct Asked {
  Json answer;  ///< null when the program left none
  ExitStatus exit;
  std::string said;
};

Asked ask(const Question& question) {
  const ScratchDir scratch;
  const std::filesystem::path answer = scratch.path() / "oracle.json", log = scratch.path() / "oracle.log";
  std::vector<std::string> argv = {program_dir() / "sim_server", "--scenario", question.scenario, "--oracle", answer};
  if (question.scene_seed) argv.insert(argv.end(), {"--scene-seed", std::to_string(*question.scene_seed)});
  if (question.assets) argv.insert(argv.end(), {"--assets", *question.assets});
  if (question.clearance_m) argv.insert(argv.end(), {"--clearance", std::to_string(*question.clearance_m)});
  if (question.patience_s) argv.insert(argv.end(), {"--oracle-patience", std::to_string(*question.patience_s)});
  Asked asked;
  // As in a run: the same libm gives the same answer.
  asked.exit = run_to_end({"sim_server", argv, fleet_environment(false), log});
  asked.answer = read_json(answer);
  for (const std::string& line : last_lines(log, kMostLines)) asked.said += (asked.said.empty() ? "" : "\n") + line;
  return asked;
}

Json points_and_score(const Json& part) {
  return {{"points", value_or(part, "points", nullptr)}, {"score", value_or(part, "score", nullptr)}};
}

std::string metres(double value) {
  std::ostringstream text;
  text << value << " m";
  return text.str();
}

}  // namespace

Json attainable_from(const Json& answer) {
  const Json reachable = value_or(answer, "reachable", nullptr);
  if (!reachable.is_object()) return nullptr;
  Json attainable = points_and_score(reachable);
  attainable["clearance_m"] = value_or(answer, "clearance_m", nullptr);
  attainable["outside"] = points_and_score(value_or(answer, "outside", nullptr));
  return attainable;
}

AttainableAnswer attainable_of(const RunOptions& run) try {
  const Asked asked = ask({run.scenario, run.scene_seed, run.assets, {}, kPatienceS});
  if (!asked.exit.ok()) return {nullptr, "the oracle failed: " + asked.exit.text() + "\n" + asked.said};
  const Json attainable = attainable_from(asked.answer);
  const bool too_long = asked.answer.is_object() && attainable.is_null();
  return {attainable, too_long ? "what is attainable here takes a while to compute: `skein oracle " +
                                     run.scenario + "` does it once"
                               : ""};
} catch (const Interrupted&) {
  return {};
} catch (const std::exception& error) {
  return {nullptr, std::string("the oracle failed: ") + error.what()};
}

void print_oracle(std::ostream& out, const std::string& scenario, const Json& answer, bool outside_only) {
  const double clearance = value_or(answer, "clearance_m", 0.0), berth = value_or(answer, "outside_berth_m", 0.0);
  out << scenario << ": " << value_or(answer, "points_total", 0) << " interest points, cameras "
      << metres(clearance) << " clear of the structure\n\n"
      << "              points       score   twice as many viewpoints changed it by\n";
  const auto row = [&](const char* name, const Json& part) {
    out << std::left << std::setw(10) << name << std::right << std::setw(10)
        << value_or(part, "points", 0).get<std::size_t>() << std::fixed << std::setprecision(1) << std::setw(12)
        << value_or(part, "score", 0.0).get<double>() << std::setprecision(2) << std::showpos << std::setw(10)
        << value_or(part, "change_percent", 0.0).get<double>() << std::noshowpos << std::defaultfloat << " %\n";
  };
  if (!outside_only) row("reachable", value_or(answer, "reachable", Json::object()));
  row("outside", value_or(answer, "outside", Json::object()));
  out << '\n';
  if (!outside_only) {
    out << "reachable  from all places that a UAV can get to from the sky or its start, always that clear\n";
  }
  out << "outside    from where openings less than " << metres(2.0 * berth) << " wide keep it out" << std::endl;
}

int consult_oracle(const OracleOptions& options, const Console& console) {
  const Asked asked = ask({options.scenario, options.scene_seed, options.assets, options.clearance_m, {}});
  if (asked.exit.code == kExitBadInput) throw InputError(asked.said);
  if (!asked.exit.ok() || !asked.answer.is_object()) {
    throw std::runtime_error("sim_server --oracle ended with " + asked.exit.text() + "\n" + asked.said);
  }
  if (!asked.said.empty()) console.err << asked.said << std::endl;
  if (options.json) {
    console.out << asked.answer.dump(2) << std::endl;
  } else {
    print_oracle(console.out, options.scenario, asked.answer, options.outside_only);
  }
  return kExitDone;
}

}  // namespace skein::cli
