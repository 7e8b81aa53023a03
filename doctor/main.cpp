// skein_doctor: finds what prevents a fleet from running on this machine or, with --net, on several hosts. `skein
// doctor` hands over to this program.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "bus/bus.hpp"
#include "core/text/number_checks.hpp"
#include "core/topics.hpp"
#include "doctor/checks_program.hpp"
#include "doctor/net_program.hpp"
#include "process/host/environment.hpp"

namespace skein::doctor {
namespace {

constexpr const char* kNet = "--net";

struct Options {
  bool net = false, json = false, base_given = false, until_heard = false;
  std::string name;
  std::vector<std::string> only;
  double seconds = 5.0;
};

void add_options(CLI::App& app, Options& options) {
  app.add_flag(kNet, options.net,
               "Test which hosts receive each other's messages, instead of the limits of this machine");
  app.add_flag("--json", options.json, "Print JSON, for programs");
  app.add_option("--as", options.name, "Name under which this host reports (default: its host name)");
  app.add_option("--only", options.only, "Domains in which this host takes part")->delimiter(',');
  app.add_option("--seconds", options.seconds, "How long to send and receive [s]")
      ->check(CLI::Validator(number_within(0.1, 36000.0), ""));
  app.add_flag("--until-heard", options.until_heard, "End sooner, once all named peers receive each other's messages");
  app.callback([&] { options.base_given = app.count("--domain") > 0; });
}

int say(const auto& result, bool json) {
  if (json) {
    std::cout << as_json(result).dump(2) << std::endl;
  } else {
    print(std::cout, result);
    std::cout.flush();
  }
  return exit_code(result);
}

int run(const ProgramOptions& program, const Options& options, StopSignal& stop) {
  // The findings contain what the bus would warn of, in more detail.
  if (program.log_level.empty() && std::getenv("SKEIN_LOG") == nullptr) spdlog::set_level(spdlog::level::err);
  const Scenario scenario = load_scenario(program.scenario, program.load_options_without_scene());
  const std::vector<std::string> domains = domain_names(scenario);
  NetworkConfig network;
  if (program.network) network = read_network(*program.network);
  network.check_names(domains);
  if (!options.net) {
    const std::optional<int> base = options.base_given ? std::optional(program.domain) : std::nullopt;
    return say(examine({.uavs = scenario.fleet.size(),
                        .domains = domains,
                        .network = network,
                        .base = base,
                        .results = program.out}),
               options.json);
  }
  NetVisit visit{.network = network, .domains = domains, .only = options.only};
  visit.vendors = program.dds == "mixed" ? bus::dds_vendors() : std::vector{program.dds};
  visit.base = program.domain;
  visit.name = options.name;
  visit.until_heard = options.until_heard;
  visit.time = std::chrono::milliseconds(static_cast<long>(1000.0 * options.seconds));
  return meet(visit, stop, [&](const Meetings& all) { return say(all, options.json); });
}

}  // namespace
}  // namespace skein::doctor

int main(int argc, char** argv) {
  using namespace skein;
  // The machine is checked in the user's own environment. With --net, the doctor joins domains, so it uses the
  // environment of a fleet's programs.
  const bool net =
      std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word) == doctor::kNet; });
  if (net) take_fleet_environment(argv);
  doctor::Options options;
  return run_program(
      "skein_doctor", argc, argv, [&](CLI::App& app) { doctor::add_options(app, options); },
      [&](const ProgramOptions& program, StopSignal& stop) { return doctor::run(program, options, stop); });
}
