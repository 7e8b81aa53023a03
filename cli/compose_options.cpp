#include "cli/compose_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/flight_options.hpp"
#include "cli/view_options.hpp"
#include "core/text/text.hpp"

namespace skein::cli {

void add_compose(CLI::App& app, ComposeOptions& compose) {
  CLI::App* command =
      app.add_subcommand("compose", "Write a docker-compose file for a fleet in containers, or fly this fleet");
  add_flight_options(*command, compose.run);
  CLI::Option* up = command->add_flag("--up", compose.up,
                                      "Start the containers, follow the run, and remove the containers at its end");
  command->add_option("--file", compose.file, "File to write (default: standard output)")->excludes(up);
  CLI::Option* const stack =
      command
          ->add_flag("--stack", compose.stack,
                     "Write a file for `docker stack`, which spreads the fleet over several engines")
          ->excludes(up);
  command->add_option("--place", compose.run.place.at, "With --stack: the nodes of the swarm on which these UAVs fly")
      ->type_name("UAV=NODE,...")
      ->needs(stack);
  command->add_option("--image", compose.images, "UAV=IMAGE: run this image of yours instead of the UAV's agent")
      ->allow_extra_args(false);
  command->add_option("--subnet", compose.subnet,
                      "IPv4 network that Skein divides among the fleet's networks, such as 172.30.0.0/20 (default: the "
                      "engine's address pools)");
  command
      ->add_option("--debug", compose.run.debug,
                   "Stop this program (UAV, gcs or a server) before its first step while the fleet waits: gdb opens "
                   "gdb in its container, in this terminal (needs --up); wait waits until you attach a debugger "
                   "(default: gdb with --up in a terminal)")
      ->type_name("UAV[=gdb|wait]")
      ->allow_extra_args(false)
      ->excludes("--agent-timeout");
  command->add_option("--build-folder", compose.build, "Fly the programs of this build, not those of the images");
  add_result_options(*command, compose.run);
  add_view_options(*command, compose.run.view);
  command->footer(
      "Examples:\n"
      "  skein compose towers --planner kios --up\n"
      "  skein compose towers --planner kios --view 8080 --up\n"
      "  skein compose towers --planner kios --file compose.yaml\n"
      "  skein compose towers --planner hover,jurong=orbit --image jurong=my-agent --up\n\n"
      "docs/how-to-containers.md shows how to build images; docs/containers.md explains each part of the file.");
}

void finish_compose(ComposeOptions& compose, const std::vector<std::string>& arguments) {
  check_view(compose.run);
  compose.run.command = "skein " + shell_line(arguments);
}

}  // namespace skein::cli
