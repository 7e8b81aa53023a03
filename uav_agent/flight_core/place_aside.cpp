#include "uav_agent/flight_core/place_aside.hpp"

#include <algorithm>
#include <numbers>
#include <tuple>

namespace skein::agent {
namespace {

constexpr double kAwayM[] = {0.75, 1.5, 2.5, 4.0};  ///< distances of the places that are tried; chosen
constexpr int kDirections = 16;                     ///< places tried at each distance; chosen
constexpr double kStepM = 0.5;   ///< between two heights at which the room is determined; chosen: a cube of the map
constexpr double kGainsM = 0.2;  ///< least gain of room that makes a place worth the flight; chosen

double room_above(const Vector3d& p_W, double top_m, const WorldMap& map) {
  double room_m = map.structure_distance_m(p_W);
  for (double z = p_W.z() + kStepM; z < top_m; z += kStepM) {
    room_m = std::min(room_m, map.structure_distance_m({p_W.x(), p_W.y(), z}));
  }
  return room_m;
}

}  // namespace

std::vector<Vector3d> places_aside_W(const Vector3d& p_W, double top_m, double room_m, const WorldMap& map) {
  struct Place {
    Vector3d p_W;
    double away_m = 0.0, room_m = 0.0;
  };
  const double here_m = room_above(p_W, top_m, map);
  std::vector<Place> places;
  for (const double away_m : kAwayM) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kDirections;
      const Vector3d place_W = p_W + away_m * Vector3d(std::cos(angle), std::sin(angle), 0.0);
      const double its_m = room_above(place_W, top_m, map);
      if (its_m > here_m + kGainsM) places.push_back({place_W, away_m, its_m});
    }
  }
  std::ranges::stable_sort(
      places, {}, [&](const Place& place) { return std::tuple(place.room_m < room_m, place.away_m, -place.room_m); });
  std::vector<Vector3d> sorted_W;
  for (const Place& place : places) sorted_W.push_back(place.p_W);
  return sorted_W;
}

}  // namespace skein::agent
