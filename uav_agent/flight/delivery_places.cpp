#include "uav_agent/flight/delivery_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein::agent {
namespace {

constexpr double kDetour = 1.5;     ///< length of the path, in straight distances; chosen
constexpr double kFixedS = 6.0;     ///< to brake, turn and accelerate; chosen
constexpr double kLayerM = 3.0;     ///< height difference between the places of two UAVs; chosen
constexpr std::size_t kLayers = 8;  ///< different heights of the UAVs' places; chosen
/// Radius about the line of sight that must be clear of occupied cells. Chosen.
constexpr double kSightRadiusM = 0.8;
/// Occupied cells nearer to the station do not count: its own surroundings. Chosen.
constexpr double kStationM = 3.0;
/// Least height above the station: a roof under it may hide it from below. Chosen.
constexpr double kAboveStationM = 3.0;
constexpr int kDirections = 12;                               ///< places at each distance; chosen
constexpr double kOutwards[] = {4.0, 8.0, 14.0, 22.0, 32.0};  ///< distances from the station [m]; chosen

}  // namespace

std::vector<Vector3d> delivery_places(const AgentConfig& agent, const FreeSpace& space, double lowest_m) {
  struct Candidate {
    double cost;
    Vector3d p_W;
  };
  std::vector<Candidate> candidates;
  const double lowest_in_sight_m = std::max(lowest_m, agent.station_position.z() + kAboveStationM);
  const double height = lowest_in_sight_m + delivery_layer_m(agent);
  const double own_direction =
      2.0 * std::numbers::pi * static_cast<double>(agent.self) / static_cast<double>(agent.fleet.size());
  for (const double outwards : kOutwards) {
    for (int i = 0; i < kDirections; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kDirections;
      const Vector3d p(agent.station_position.x() + outwards * std::cos(own_direction + turn),
                       agent.station_position.y() + outwards * std::sin(own_direction + turn), height);
      const Vector3d above_station = agent.station_position + (p - agent.station_position).normalized() * kStationM;
      if (!space.free(p) || !space.sees(p, above_station, kSightRadiusM)) continue;
      candidates.push_back({outwards * (1.0 + std::min(i, kDirections - i)), p});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  std::vector<Vector3d> places;
  for (const Candidate& candidate : candidates) places.push_back(candidate.p_W);
  return places;
}

double delivery_layer_m(const AgentConfig& agent) { return kLayerM * static_cast<double>(agent.self % kLayers); }

double time_home_s(const Vector3d& from_W, const Vector3d& place_W, double speed_mps) {
  return kDetour * (place_W - from_W).norm() / speed_mps + kFixedS;
}

}  // namespace skein::agent
