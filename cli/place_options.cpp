#include "cli/place_options.hpp"

#include <CLI/CLI.hpp>

namespace skein::cli {

void add_place_options(CLI::App& command, PlaceOptions& place) {
  CLI::Option* const at =
      command
          .add_option("--place", place.at,
                      "Run the programs of these UAVs on other hosts, over ssh (gcs: the program at the "
                      "ground station); slurm: distribute the UAVs over the other nodes of this Slurm allocation")
          ->type_name("UAV=HOST,...");
  command.add_option("--ssh", place.ssh, "With --place: the command that logs in, with its options")
      ->capture_default_str()
      ->needs(at);
  command
      .add_option("--skein-path", place.skein,
                  "With --place: path of skein on those hosts (default: the path on this host)")
      ->needs(at);
  command
      .add_flag("--print", place.print,
                "With --place: print the commands with which you start the programs by hand, and do not fly")
      ->needs(at);
}

}  // namespace skein::cli
