#include "scenes/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace skein::sim {
namespace {

constexpr double kHorizon = 1e6;  ///< beyond any structure
constexpr int kDirections = 256;
constexpr std::size_t kMostOfARoom = 1000;  ///< places of one room: enough to find a narrow way out of a large one
constexpr std::size_t kMostPlaces = 2000, kMostRooms = 30;  ///< a search that would need more proves nothing
constexpr double kPlaceSpacing = 1.0;
constexpr double kFromWall = 0.5;  ///< distance of the next place from the hit of a ray, towards the ray's start

/// Directions that cover the sphere evenly, from up to down: points on a spiral with steps of the golden angle. Each
/// place has different directions, so that another place may find a narrow way out that one place misses.
Vector3d direction(std::size_t place, int i) {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double turn = golden_angle * (i + static_cast<double>(place) * kDirections);
  const double whole = static_cast<double>(place) * std::numbers::phi + 0.5;
  const double z = 1.0 - 2.0 * (i + whole - std::floor(whole)) / kDirections;
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// The places of a search for a way out. A place in sight of a room's first place belongs to that room: a hall is one
/// room, however large, and a maze has many.
class VisitedPlaces {
 public:
  VisitedPlaces(const RayScene& world, const Vector3d& p_W) : world_(world), places_{{p_W, 0}}, rooms_{{p_W, 1}} {}

  std::size_t count() const { return places_.size(); }
  const Vector3d& operator[](std::size_t i) const { return places_[i].p_W; }
  /// Whether places were left out of which nothing is known: then the search proves nothing.
  bool gave_up() const { return gave_up_; }

  /// Adds a place that the i-th one sees, unless it is close to another one, or in a room that has enough.
  void add(const Vector3d& p_W, std::size_t i) {
    const bool known =
        std::ranges::any_of(places_, [&](const Place& place) { return (place.p_W - p_W).norm() < kPlaceSpacing; });
    if (known) return;
    const std::size_t room = room_of(p_W, places_[i].room);
    if (room < rooms_.size() && rooms_[room].places == kMostOfARoom) return;
    gave_up_ = room == kMostRooms || places_.size() == kMostPlaces;
    if (gave_up_) return;
    if (room == rooms_.size()) rooms_.push_back({p_W, 0});
    ++rooms_[room].places;
    places_.push_back({p_W, room});
  }

 private:
  struct Place {
    Vector3d p_W;
    std::size_t room;
  };
  struct Room {
    Vector3d first_W;
    std::size_t places;
  };

  /// @param likely  a room that is tried first. @returns the number of rooms if the place is in none.
  std::size_t room_of(const Vector3d& p_W, std::size_t likely) const {
    const auto sees = [&](const Room& room) { return !world_.first_hit_distance(room.first_W, p_W, {.uavs = false}); };
    if (sees(rooms_[likely])) return likely;
    return static_cast<std::size_t>(std::ranges::find_if(rooms_, sees) - rooms_.begin());
  }

  const RayScene& world_;
  std::vector<Place> places_;
  std::vector<Room> rooms_;
  bool gave_up_ = false;
};

}  // namespace

bool is_enclosed(const RayScene& world, const Vector3d& p_W) {
  RayFilter filter;
  filter.uavs = false;
  VisitedPlaces places(world, p_W);
  for (std::size_t seen = 0; seen < places.count(); ++seen) {
    const Vector3d from_W = places[seen];
    for (int i = 0; i < kDirections; ++i) {
      const Vector3d d_W = direction(seen, i);
      const std::optional<Hit> hit = world.first_hit(from_W, d_W, kHorizon, filter);
      if (!hit) return false;
      places.add(from_W + std::max(0.0, hit->distance - kFromWall) * d_W, seen);
      if (places.gave_up()) return false;
    }
  }
  return true;
}

double world_reach_m(const Scenario& scenario, const Scene& scene) {
  constexpr double kFast_mps = 50.0, kRoom_m = 1000.0;
  double farthest_m = scenario.station_position.norm();
  for (const UavConfig& uav : scenario.fleet) farthest_m = std::max(farthest_m, uav.start.norm());
  for (const auto& vertex : scene.mesh.vertices) {
    farthest_m = std::max(farthest_m, static_cast<double>(vertex.norm()));
  }
  return farthest_m + kFast_mps * (scenario.takeoff_timeout_s + scenario.duration_s) + kRoom_m;
}

}  // namespace skein::sim
