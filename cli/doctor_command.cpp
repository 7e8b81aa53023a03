#include "cli/doctor_command.hpp"

#include <CLI/CLI.hpp>

#include "cli/flight_options.hpp"
#include "cli/option_checks.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

/// Refuses the options that only `skein doctor net` uses. @throws InputError
void check_doctor(const DoctorOptions& doctor) {
  if (doctor.net) return;
  const auto refuse = [](bool given, const std::string& option) {
    if (given) throw InputError(option + ": only `skein doctor net` takes this option");
  };
  refuse(doctor.name.has_value(), "--as");
  refuse(!doctor.only.empty(), "--only");
  refuse(doctor.seconds.has_value(), "--seconds");
}

}  // namespace

void add_doctor(CLI::App& app, DoctorOptions& doctor) {
  CLI::App* command = app.add_subcommand(
      "doctor", "Find problems of this machine or network that would disturb a fleet, and how to fix them");
  const auto set_net = [&doctor](const std::string&) { doctor.net = true; };
  command
      ->add_option_function<std::string>(
          "WHAT", set_net,
          "net: test which hosts receive each other's messages; run this command on all of them at the same time")
      ->check(CLI::IsMember({"net"}));
  add_network(*command, doctor.network);
  command
      ->add_option("--scenario", doctor.scenario,
                   "Scenario of the fleet: a name under config/scenarios/ or a YAML file")
      ->capture_default_str();
  command->add_option("--assets", doctor.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--domain", doctor.domain, "First DDS domain of the fleet (default: the first free block)");
  command->add_option("--dds", doctor.dds, "DDS vendor: cyclonedds, fastdds or mixed")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}))
      ->capture_default_str();
  command->add_option("--out", doctor.out, "Folder for results, to check that a run can write there")
      ->capture_default_str();
  command->add_flag("--json", doctor.json, "Print JSON, for programs");
  command->add_option("--as", doctor.name, "net: name under which this host reports (default: its host name)");
  command
      ->add_option(
          "--only", doctor.only,
          "net: domains in which this host takes part: world,gcs,UAV,... (default: all domains that leave the host)")
      ->delimiter(',');
  command->add_option("--seconds", doctor.seconds, "net: how long to send and receive [s] (default 5)")
      ->check(CLI::Validator(check_seconds, ""));
  command->callback([&doctor] { check_doctor(doctor); });
  command->footer(
      "Examples:\n"
      "  skein doctor --scenario towers\n"
      "  skein doctor net --network network.yaml --only world,gcs --seconds 30\n\n"
      "Exit codes: 0 all checks pass, 1 a check fails, or no message of a peer arrived. See docs/doctor.md.");
}

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
