#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vehicle/airframe.hpp"
#include "scenes/wild/site.hpp"

namespace skein::sim::wild {
namespace {

constexpr double kRoom = 0.35;     ///< clearance around a body at its start
constexpr double kHeadroom = 4.5;  ///< free height above a start
constexpr int kTries = 300;        ///< for each place
constexpr double kStationRoom = 0.5;

double rounded_cm(double value) { return std::round(100.0 * value) / 100.0; }
Vector2d around(RandomStream& random, double least, double most) {
  const double heading = random.uniform(-std::numbers::pi, std::numbers::pi);
  return random.uniform(least, most) * Vector2d(std::cos(heading), std::sin(heading));
}
const Standing& any_of(const std::vector<Standing>& structures, RandomStream& random) {
  return structures[static_cast<std::size_t>(random.uniform() * static_cast<double>(structures.size()))];
}

/// Whether a body has room around and above a start.
bool has_room(const RayScene& world, const Vector2d& p_W, double radius) {
  const Vector3d foot(p_W.x(), p_W.y(), 0.3);
  for (const double z : {0.3, 0.9, 1.5}) {
    if (world.clearance({p_W.x(), p_W.y(), z}, 2.0) < radius + kRoom) return false;
  }
  return !world.first_hit(foot, Vector3d::UnitZ(), kHeadroom, {.ground = false, .uavs = false});
}

/// Arrangement of a fleet's starts.
enum class Manner { open, apart, wall, canopy, below };

Manner draw_manner(RandomStream& random, bool blind) {
  const double share = random.uniform();
  if (share < 0.35) return Manner::open;
  if (share < 0.55) return Manner::apart;
  if (blind) return Manner::open;
  if (share < 0.7) return Manner::wall;
  return share < 0.85 ? Manner::canopy : Manner::below;
}

/// Draws starts one by one. Each keeps the least distance from all earlier starts plus a random gap.
class Ground {
 public:
  Ground(const std::vector<VehicleConfig>& fleet, const std::vector<Standing>& structures, const TriangleMesh& mesh,
         RandomStream& random)
      : fleet_(fleet), structures_(structures), world_(mesh), random_(random) {
    gap_ = random.uniform() < 0.5 ? random.uniform(0.02, 0.3) : random.uniform(0.5, 4.0);
  }

  const RayScene& world() const { return world_; }

  /// A place around which the fleet's starts may be.
  Vector2d base(Manner manner) {
    for (int i = 0; i < kTries; ++i) {
      const Standing& near = any_of(structures_, random_);
      const bool below = manner == Manner::below;
      const Vector2d p_W =
          near.p_W + around(random_, below ? 0.0 : near.radius + 2.0, near.radius + (below ? 0.0 : 25.0));
      const bool covered =
          world_.first_hit({p_W.x(), p_W.y(), 0.3}, Vector3d::UnitZ(), 40.0, {.ground = false, .uavs = false})
              .has_value();
      if (has_room(world_, p_W, 0.7) && (!below || covered)) return {rounded_cm(p_W.x()), rounded_cm(p_W.y())};
    }
    return structures_.front().p_W + Vector2d(structures_.front().radius + 10.0, 0.0);
  }

  /// @returns whether all UAVs have a start.
  bool place_all(Manner manner, const Vector2d& base, Starts& starts) {
    for (std::size_t i = 0; i < fleet_.size(); ++i) {
      double reach = 0.5;
      bool placed = false;
      for (int t = 0; t < kTries && !placed; ++t, reach += 0.1) {
        const Vector2d about = manner == Manner::apart ? this->base(Manner::open) : base;
        const Vector2d offset = around(random_, 0.0, manner == Manner::apart ? 0.5 : reach);
        const Vector2d p_W(rounded_cm(about.x() + offset.x()), rounded_cm(about.y() + offset.y()));
        placed = is_free(starts.p_W, p_W, i);
        if (placed) starts.p_W.push_back(p_W);
      }
      if (!placed) return false;
      starts.yaw.push_back(random_.uniform(-std::numbers::pi, std::numbers::pi));
    }
    return true;
  }

 private:
  bool is_free(const std::vector<Vector2d>& taken, const Vector2d& p_W, std::size_t uav) const {
    for (std::size_t i = 0; i < taken.size(); ++i) {
      if ((taken[i] - p_W).norm() < least_start_distance(fleet_[i], fleet_[uav]) + gap_) return false;
    }
    return has_room(world_, p_W, body_radius(fleet_[uav]));
  }

  const std::vector<VehicleConfig>& fleet_;
  const std::vector<Standing>& structures_;
  const RayScene world_;
  RandomStream& random_;
  double gap_ = 0.0;
};

/// The station: near the first start, behind a structure, or on a roof.
Vector3d draw_station(const RayScene& world, const std::vector<Standing>& structures, const Starts& starts,
                      RandomStream& random) {
  const double kind = random.uniform();
  Vector3d station;
  for (int i = 0; i < kTries; ++i) {
    const Standing& near = any_of(structures, random);
    Vector2d p_W = starts.p_W.front() + around(random, 1.5, 12.0);
    if (kind >= 0.6 && kind < 0.8) {
      const Vector2d away = (near.p_W - starts.p_W.front()).normalized();
      p_W = near.p_W + (near.radius + random.uniform(2.0, 12.0)) * away;
    } else if (kind >= 0.8) {
      p_W = near.p_W + around(random, 0.0, 0.5 * near.radius);
    }
    double z = 0.3;
    constexpr double kAbove = 200.0;
    const auto roof =
        world.first_hit({p_W.x(), p_W.y(), kAbove}, -Vector3d::UnitZ(), kAbove, {.ground = false, .uavs = false});
    if (kind >= 0.8 && roof) z = kAbove - roof->distance + 0.8;
    station = {rounded_cm(p_W.x()), rounded_cm(p_W.y()), rounded_cm(z)};
    const bool apart = std::ranges::all_of(
        starts.p_W, [&](const Vector2d& start) { return (start - station.head<2>()).norm() > 1.3; });
    if (apart && world.clearance(station, 2.0) > kStationRoom) return station;
  }
  return station;
}

}  // namespace

Starts draw_starts(const Dice& dice, const std::vector<VehicleConfig>& fleet, const std::vector<Standing>& structures,
                   const TriangleMesh& mesh, bool blind) {
  RandomStream random = dice.stream("wild_starts");
  const Manner manner = draw_manner(random, blind);
  Starts starts;
  MeshBuilder beside;
  TriangleMesh all = mesh;
  const Vector2d base = Ground(fleet, structures, all, random).base(manner);
  if (manner == Manner::canopy) {
    const double width = 6.0 + 1.2 * static_cast<double>(fleet.size());
    const Vector3d size(width + random.uniform(0.0, 6.0), width, random.uniform(5.5, 9.0));
    add_canopy(beside, standing_at(base, random.uniform(-std::numbers::pi, std::numbers::pi)), size, random);
  } else if (manner == Manner::wall) {
    const int walls = draw_count(random, 1, 3);
    for (int i = 0; i < walls; ++i) {
      const double turn = random.uniform(-std::numbers::pi, std::numbers::pi), height = random.uniform(2.0, 7.0);
      const Isometry3d X_WS =
          standing_at(base, turn) * Eigen::Translation3d(random.uniform(1.6, 4.0), 0, 0.5 * height + kSunk);
      beside.add_box(X_WS, {random.uniform(0.15, 0.4), random.uniform(3.0, 10.0), height});
    }
  }
  starts.beside = beside.take();
  append(all, starts.beside);
  Ground ground(fleet, structures, all, random);
  if (!ground.place_all(manner, base, starts)) return {};
  starts.station_W = draw_station(ground.world(), structures, starts, random);
  return starts;
}

TriangleMesh draw_clutter(const Dice& dice, const std::vector<Standing>& structures,
                          const std::vector<OrientedBox>& boxes, const Starts& starts) {
  RandomStream random = dice.stream("wild_clutter");
  const auto free_of = [&](const TriangleMesh& item) {
    const RayScene alone(item);
    for (const Vector2d& start : starts.p_W) {
      if (alone.clearance({start.x(), start.y(), 0.5}, 3.0) < 1.6 ||
          alone.clearance({start.x(), start.y(), 4.0}, 3.0) < 1.6)
        return false;
    }
    return alone.clearance(starts.station_W, 3.0) > kStationRoom && !in_any_box(item, boxes);
  };
  TriangleMesh clutter;
  const auto add = [&](MeshBuilder& item) {
    if (free_of(item.mesh())) append(clutter, item.mesh());
  };
  const auto place = [&] {
    const Standing& near = any_of(structures, random);
    return Vector2d(near.p_W + around(random, near.radius, near.radius + 25.0));
  };
  const int trees = random.uniform() < 0.7 ? draw_count(random, 1, 14) : 0;
  for (int i = 0; i < trees; ++i) {
    MeshBuilder item;
    const Vector2d p_W = place();
    add_tree(item, p_W, random.uniform(3.0, 14.0), random);
    add(item);
  }
  const int lines = random.uniform() < 0.6 ? draw_count(random, 1, 3) : 0;
  for (int i = 0; i < lines; ++i) {
    MeshBuilder item;
    const Vector2d from = place(), to = from + around(random, 15.0, 50.0);
    add_cables(item, from, to, random.uniform(5.0, 18.0), random);
    add(item);
  }
  const int poles = random.uniform() < 0.4 ? draw_count(random, 1, 5) : 0;
  for (int i = 0; i < poles; ++i) {
    MeshBuilder item;
    const Vector2d p_W = place();
    item.add_cylinder(Vector3d(p_W.x(), p_W.y(), kSunk), Vector3d(p_W.x(), p_W.y(), random.uniform(4.0, 20.0)),
                      random.uniform(0.05, 0.2), 8);
    add(item);
  }
  return clutter;
}

}  // namespace skein::sim::wild
