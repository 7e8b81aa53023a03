#include "cli/actions.hpp"

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "host/preflight.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

int consult_doctor(const DoctorOptions& options) {
  std::vector<std::string> argv = {
      program_dir() / programs::kDoctor, "--scenario", options.scenario, "--dds", options.dds, "--out", options.out};
  const auto add = [&](const std::string& option, const auto& value) {
    if (value) argv.insert(argv.end(), {option, *value});
  };
  add("--assets", options.assets);
  add("--network", options.network);
  add("--as", options.name);
  if (options.domain) argv.insert(argv.end(), {"--domain", std::to_string(*options.domain)});
  if (options.seconds) argv.insert(argv.end(), {"--seconds", shortest(*options.seconds)});
  if (!options.only.empty()) argv.insert(argv.end(), {"--only", joined(options.only, ",")});
  if (options.net) argv.push_back("--net");
  if (options.json) argv.push_back("--json");
  return hand_over({programs::kDoctor, argv, environment_with({}), {}});
}

}  // namespace skein::cli
