// The interface between an agent and the shared object that contains Python (skein_python). The object links none of
// the agent's code: it asks maps through MapQueries, and the agent knows only one function of it.
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
  /// Lowest corners, in the order in which they became known.
  virtual std::vector<Vector3d> regions(const WorldMap& map) const = 0;

  virtual bool free(const FreeSpace& space, const Vector3d& p_W) const = 0;
  virtual bool segment_free(const FreeSpace& space, const Vector3d& a_W, const Vector3d& b_W) const = 0;
  virtual double cost(const FreeSpace& space, const Vector3d& p_W) const = 0;
  virtual bool sees(const FreeSpace& space, const Vector3d& a_W, const Vector3d& b_W, double radius) const = 0;
};

/// The implementation in this program.
const MapQueries& map_queries();

struct Order {
  PythonSpec planner;         ///< its file is absolute
  ConfigDocument parameters;  ///< of the planner
  AgentConfig agent;
  std::uint64_t seed = 0;                      ///< of the run: with the UAV's name it seeds Python's generators
  std::vector<std::string> radio_topics = {};  ///< that this UAV may send on
  std::optional<double> debug_from_s = {};     ///< pdb has the terminal, and stops at this simulated time first
  std::filesystem::path package_folder = {};   ///< that holds the package `skein`; empty: Python's own path has it
  const MapQueries* maps = nullptr;            ///< outlives all planners
};

/// The file, beside the programs or in lib/skein of where they are installed.
inline constexpr const char* kModule = "libskein_python.so";
/// Its function, extern "C"; it throws InputError for what is wrong in the order, the user's own code included.
inline constexpr const char* kMakePlanner = "skein_make_python_planner";
using MakePlanner = void(const Order& order, std::unique_ptr<Planner>& planner);
/// For which interface it was built, extern "C".
inline constexpr const char* kInterface = "skein_python_interface";
using Interface = const char*();
/// Rises with what is in this header or in a PlannerInput or PlannerOutput.
inline constexpr const char* kInterfaceVersion = "1";

}  // namespace skein::agent::python
