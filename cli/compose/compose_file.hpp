// A fleet as a file for docker-compose: a container a program, and for each DDS domain a network of its own, so that a
// UAV's container reaches the server and the router, and nobody else. docs/containers.md tells why each part is there.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/fleet_plan.hpp"
#include "view/endpoint.hpp"

namespace skein::cli {

/// An IPv4 network, as in "172.30.0.0/20".
struct Subnet {
  std::uint32_t address = 0;  ///< host byte order
  int prefix = 0;
};
/// @throws InputError for a text that is none.
Subnet parse_subnet(const std::string& text);

/// The page of a run that is watched, which the station serves in its container.
struct ComposeView {
  view::Endpoint published;        ///< of this host
  std::vector<std::string> names;  ///< by which browsers may ask for it, beside the loopback's
  std::string folder = "./view";   ///< of this host: key and script (write_for_station())
};

/// What containers need to know beside the plan. What is not set here is a variable that docker-compose fills in.
struct ComposeLayout {
  std::string command;                           ///< that made the file, for its first line
  std::map<std::string, std::string> chosen;     ///< images, by the variables that would name them
  std::map<std::string, std::string> images;     ///< of users, in the place of an agent's: by UAV, or "gcs"
  std::optional<std::string> run;                ///< the run's number
  std::optional<std::string> user;               ///< UID:GID of all programs
  std::optional<std::filesystem::path> results;  ///< folder of this host; else volumes keep the results
  std::string keys = "./keys";                   ///< of a secured fleet: a folder a program
  std::optional<Subnet> subnet;                  ///< whose parts the networks get; else the engine chooses
  std::optional<std::filesystem::path> build;    ///< folder whose bin/ flies instead of the images' programs
  std::optional<ComposeView> view;               ///< none: nobody watches
  bool stack = false;                            ///< for `docker stack`: several engines, one swarm
  std::map<std::string, std::string> nodes;      ///< of a stack, by program: on which it runs; else where there is room
  bool status_lines = false;                     ///< programs tell on stdout how the run goes (status_lines.hpp)
};

/// The base of the fleet's DDS domains: containers share them with nobody.
inline constexpr int kComposeBaseDomain = 1;

/// Where a program's container has its results on this host, below `results`: agents see nobody else's.
std::filesystem::path results_of(const std::string& program, const std::filesystem::path& results);

/// @throws InputError for what cannot fly in containers, and for a subnet with too little room.
std::string compose_file(const FleetPlan& plan, const ComposeLayout& layout);

}  // namespace skein::cli
