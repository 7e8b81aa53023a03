#include "cli/place_options.hpp"

#include <CLI/CLI.hpp>

namespace skein::cli {

void add_place_options(CLI::App& command, PlaceOptions& place) {
  CLI::Option* const at =
      command
          .add_option("--place", place.at,
                      "UAV=HOST,...: fly these UAVs' programs on other hosts, over ssh (gcs: the program at the ground "
                      "station); slurm: on the nodes of the allocation that this is in")
          ->type_name("UAV=HOST,...");
  command.add_option("--ssh", place.ssh, "Of --place: the command that logs in, with options of its own if any")
      ->capture_default_str()
      ->needs(at);
  command
      .add_option("--skein-path", place.skein,
                  "Of --place: the skein of those hosts (default: where this one is on this host)")
      ->needs(at);
  command.add_flag("--print", place.print, "Of --place: print the commands that start the programs by hand, and end")
      ->needs(at);
}

}  // namespace skein::cli
