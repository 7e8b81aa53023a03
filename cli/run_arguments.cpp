// A run's options as words of a command line.
#include <spdlog/fmt/fmt.h>

#include "cli/options.hpp"

namespace skein::cli {

std::vector<std::string> arguments_of(const RunOptions& run) {
  std::vector<std::string> arguments = {"run",
                                        run.scenario,
                                        "--planner=" + run.planner,
                                        "--seed=" + std::to_string(run.seed),
                                        run.one_process ? "--one-process" : "--dds=" + run.dds,
                                        "--clock=" + run.clock,
                                        "--record=" + run.record};
  const auto add = [&](const std::string& option, const auto& value, const auto& text) {
    if (value) arguments.push_back(option + "=" + text(*value));
  };
  const auto as_it_is = [](const std::string& text) { return text; };
  const auto path = [](const std::filesystem::path& file) { return file.string(); };
  const auto number = [](const auto& value) { return fmt::format("{}", value); };
  add("--agent", run.agent, path);
  add("--scene-seed", run.scene_seed, number);
  add("--uavs", run.uavs, number);
  add("--assets", run.assets, path);
  add("--duration", run.duration_s, number);
  add("--rules", run.rules, as_it_is);
  add("--conditions", run.conditions, as_it_is);
  add("--network", run.network, as_it_is);
  add("--faults", run.faults, path);
  add("--break-at", run.break_at_s, number);
  add("--break-on", run.break_on, as_it_is);
  add("--break-from", run.break_from, path);
  for (const std::string& value : run.log) arguments.push_back("--log=" + value);
  for (const std::string& value : run.debug) arguments.push_back("--debug=" + value);
  add("--domain", run.domain, number);
  add("--stop-at", run.stop_at_s, number);
  add("--lease", run.lease_s, number);
  add("--agent-timeout", run.agent_timeout_s, number);
  add("--keep-maps", run.keep_maps_s, number);
  add("--out", run.out, path);
  for (const auto& [flag, set] : {std::pair("--native", run.native),
                                  {"--cores", run.cores},
                                  {"--secure", run.secure},
                                  {"--force", run.force},
                                  {"--no-check", !run.check},
                                  {"--no-oracle", !run.attainable},
                                  {"--no-report", !run.report}}) {
    if (set) arguments.push_back(flag);
  }
  return arguments;
}

}  // namespace skein::cli
