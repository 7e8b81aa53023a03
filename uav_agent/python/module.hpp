// The interface between an agent and the shared object that contains Python (skein_python). The shared object links
// none of the agent's code: it queries maps through MapQueries. The agent calls only the two functions named below.
// Frame W.   Units: SI and radians.   Threads: one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.hpp"
#include "core/planners/python_spec.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/maps/map_level.hpp"

namespace skein::agent::python {

/// The queries of the maps of a PlannerInput, as the headers of these maps document them.
class MapQueries {
 public:
  virtual ~MapQueries() = default;

  virtual double resolution_m(const OccupancyMap& map) const = 0;
  virtual std::uint64_t occupied_cells(const OccupancyMap& map) const = 0;
  virtual std::uint64_t revision(const OccupancyMap& map) const = 0;
  virtual std::uint64_t key_frames(const OccupancyMap& map) const = 0;
  virtual bool occupied(const OccupancyMap& map, const Vector3d& p_W) const = 0;
  virtual bool known_free(const OccupancyMap& map, const Vector3d& p_W, int rays) const = 0;
  virtual std::optional<double> distance_to_occupied(const OccupancyMap& map, const Vector3d& p_W,
                                                     double max_distance) const = 0;
  virtual bool segment_clear(const OccupancyMap& map, const Vector3d& a_W, const Vector3d& b_W,
                             double radius) const = 0;
  virtual std::optional<double> cast(const OccupancyMap& map, const Vector3d& from_W, const Vector3d& direction,
                                     double max_distance, double radius) const = 0;
  virtual std::vector<Vector3d> occupied_in(const OccupancyMap& map, const OrientedBox& box) const = 0;
  virtual std::string octomap_bytes(const OccupancyMap& map, int rays) const = 0;

  virtual double cell_m(const WorldMap& map) const = 0;
  virtual Space at(const WorldMap& map, const Vector3d& p_W) const = 0;
  virtual double structure_distance_m(const WorldMap& map, const Vector3d& p_W) const = 0;
  virtual bool tube_free(const WorldMap& map, const Vector3d& a_W, const Vector3d& b_W, double radius_m) const = 0;
  virtual bool ball_free(const WorldMap& map, const Vector3d& p_W, double radius_m, double lowest_m) const = 0;
  virtual double clear_way_m(const WorldMap& map, const Vector3d& from_W, const Vector3d& direction_W,
                             double reach_m) const = 0;
  /// Reads cubes[0] * cubes[1] * cubes[2] cubes, beginning with the one that contains `lowest_W`; x varies slowest.
  virtual void read_window(const WorldMap& map, const Vector3d& lowest_W, const Eigen::Vector3i& cubes,
                           std::uint8_t* spaces) const = 0;
  /// Lowest corners of the known regions, in the order in which they became known.
  virtual std::vector<Vector3d> regions(const WorldMap& map) const = 0;

  virtual bool free(const FreeSpace& space, const Vector3d& p_W) const = 0;
  virtual bool segment_free(const FreeSpace& space, const Vector3d& a_W, const Vector3d& b_W) const = 0;
  virtual double cost(const FreeSpace& space, const Vector3d& p_W) const = 0;
  virtual bool sees(const FreeSpace& space, const Vector3d& a_W, const Vector3d& b_W, double radius) const = 0;
};

/// The implementation in the agent.
const MapQueries& map_queries();

/// All that the shared object needs to make a planner.
struct Order {
  PythonSpec planner;         ///< its file is absolute
  ConfigDocument parameters;  ///< of the planner
  AgentConfig agent;
  std::uint64_t seed = 0;                      ///< of the run: with the UAV's name it seeds Python's generators
  std::vector<std::string> radio_topics = {};  ///< topics on which this UAV may send
  std::optional<double> debug_from_s = {};     ///< pdb uses the terminal, and first stops at this simulated time
  std::filesystem::path package_folder = {};   ///< contains the package `skein`; empty: it is on Python's own path
  const MapQueries* maps = nullptr;            ///< outlives all planners
};

/// File name of the shared object. It is in the folder of the programs, or in lib/skein beside that folder.
inline constexpr const char* kModule = "libskein_python.so";
/// Its function (extern "C") that makes a planner. It throws InputError for errors in the order and in the user's code.
inline constexpr const char* kMakePlanner = "skein_make_python_planner";
using MakePlanner = void(const Order& order, std::unique_ptr<Planner>& planner);
/// Its function (extern "C") that returns the version of the interface for which the shared object was built.
inline constexpr const char* kInterface = "skein_python_interface";
using Interface = const char*();
/// Raise it when you change this header, PlannerInput or PlannerOutput.
inline constexpr const char* kInterfaceVersion = "1";

}  // namespace skein::agent::python
