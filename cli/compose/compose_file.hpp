// Writes a fleet as a file for docker-compose: one container for each program, and one network for each DDS domain, so
// that a UAV's container reaches only the server and the router. docs/containers.md explains each part.
// Threads: any.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "run/fleet_plan.hpp"
#include "view/endpoint.hpp"

namespace skein::cli {

/// An IPv4 network, as in "172.30.0.0/20".
struct Subnet {
  std::uint32_t address = 0;  ///< host byte order
  int prefix = 0;
};
/// @throws InputError for any other text, and for a prefix that is not within 8 to 28.
Subnet parse_subnet(const std::string& text);

/// The web page of a watched run, which the station serves in its container.
struct ComposeView {
  view::Endpoint published;        ///< endpoint on this host
  std::vector<std::string> names;  ///< of hosts in browsers' requests, besides the loopback's
  std::string folder = "./view";   ///< on this host: key and script (write_for_station())
};

/// What a file needs in addition to the plan. For a text that is not set, the file has a variable, which docker-compose
/// substitutes.
struct ComposeLayout {
  std::string command;                           ///< the command that made the file, for its first line
  std::map<std::string, std::string> chosen;     ///< Skein's images, by the variables that would name them
  std::map<std::string, std::string> images;     ///< users' images in place of an agent's, by UAV or "gcs"
  std::optional<std::string> run;                ///< the run's id
  std::optional<std::string> user;               ///< UID:GID of all programs
  std::optional<std::filesystem::path> results;  ///< folder on this host; nullopt: volumes keep the results
  std::string keys = "./keys";                   ///< of a secured fleet: has a folder for each program
  std::optional<Subnet> subnet;                  ///< divided among the networks; nullopt: the engine chooses
  std::optional<std::filesystem::path> build;    ///< folder whose bin/ replaces the images' programs
  std::optional<ComposeView> view;               ///< nullopt: the run has no page
  bool stack = false;                            ///< for `docker stack`: several engines in one swarm
  std::map<std::string, std::string> nodes;      ///< of a stack: node, by program; none: any with room
  bool status_lines = false;                     ///< programs write status lines to stdout (status_lines.hpp)
};

/// The fleet's first DDS domain, always the same: no other fleet is in the containers' networks.
inline constexpr int kComposeBaseDomain = 1;

/// Folder on this host for the results of a program's container: `results`, but for each agent a folder of its own
/// below it, so that an agent does not see the results of others.
std::filesystem::path results_of(const std::string& program, const std::filesystem::path& results);

/// @returns the text of the file. @throws InputError as check_layout().
std::string compose_file(const FleetPlan& plan, const ComposeLayout& layout);

}  // namespace skein::cli
