#include "sim_server/plan/legs.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "core/vehicle/airframe.hpp"
#include "sim_server/sensors/antenna_link.hpp"

namespace skein::sim {
namespace {

constexpr double kAround = 12.0;  ///< margin around the structure in which paths may go [m]
constexpr double kTurnSettleS = 0.1;

Eigen::AlignedBox3d space_of_ways(const Scenario& scenario, const Eigen::AlignedBox3d& structure) {
  Eigen::AlignedBox3d space(structure.min() - Vector3d::Constant(kAround),
                            structure.max() + Vector3d::Constant(kAround));
  for (const UavConfig& uav : scenario.fleet) space.extend(Vector3d(uav.start.x(), uav.start.y(), kTakeoffHeight));
  space.min().z() = kLeastHeight + 0.3;
  space.max().z() = std::max(space.max().z(), space.min().z() + 1.0);
  return space;
}

/// Whether a distance is within the range that the scenario sets for this direction of the link.
bool in_range(const Scenario& scenario, const std::string& from, const std::string& to, double distance) {
  return std::ranges::none_of(scenario.links, [&](const LinkEffect& effect) {
    return effect.range_m && distance > *effect.range_m && names_node(effect.from, from) && names_node(effect.to, to);
  });
}

}  // namespace

Legs::Legs(const Scenario& scenario, const RayScene& world, const Eigen::AlignedBox3d& structure, const Team& team,
           const std::vector<View>& views, const PlanConfig& config)
    : scenario_(scenario),
      world_(world),
      team_(team),
      views_(views),
      picture_s_(config.settle_s + kPictureS),
      linked_nodes_(team.kinds.size()),
      tails_(views.size(), -1.0) {
  for (const View& view : views) {
    places_.push_back(view.p_WB);
    kinds_.push_back(view.kind);
  }
  for (const TeamKind& kind : team.kinds) {
    ways_.emplace_back(world, space_of_ways(scenario, structure), kind.clearance, config.most_nodes);
  }
  for (const UavIndex uav : scenario.uavs()) {
    const UavConfig& uav_config = scenario.fleet[uav];
    const std::size_t kind = team.kind_of[static_cast<std::size_t>(uav)];
    const Vector2d& start = uav_config.start;
    const Vector3d rest(start.x(), start.y(), rest_height(uav_config.vehicle)),
        up(start.x(), start.y(), kTakeoffHeight);
    places_.push_back(up);
    kinds_.push_back(kind);
    const double climb_s = kSpinUpS + team.kinds[kind].travel_s(up - rest);
    takeoff_s_.push_back(ways_[kind].clear(rest, up) ? climb_s : kNever);
  }
  anchors_.resize(places_.size());
}

const std::vector<std::size_t>& Legs::anchors(std::size_t place) {
  if (!anchors_[place]) anchors_[place] = ways_[kinds_[place]].anchors(places_[place]);
  return *anchors_[place];
}

double Legs::flight_s(std::size_t kind, const Vector3d& from_W, const std::vector<Vector3d>& corners) const {
  double time = 0.0;
  const Vector3d* at = &from_W;
  for (const Vector3d& corner : corners) {
    time += team_.kinds[kind].travel_s(corner - *at);
    at = &corner;
  }
  return time;
}

double Legs::turn_s(std::size_t from, std::size_t to) const {
  if (from >= views_.size()) return 0.0;  // the camera turns during the takeoff
  const double turn = std::max(std::abs(wrap_angle(views_[from].yaw - views_[to].yaw)),
                               std::abs(views_[from].pitch - views_[to].pitch));
  return turn / (team_.kinds[kinds_[to]].vehicle.gimbal.rate_limit_deg_s * kRadPerDeg) + kTurnSettleS;
}

double Legs::least_leg_s(std::size_t from, std::size_t to) const {
  const double flight = team_.kinds[kinds_[to]].travel_s(places_[from] - places_[to]);
  return std::max(flight, turn_s(from, to)) + picture_s_;
}

double Legs::leg_s(std::size_t from, std::size_t to) {
  const std::uint64_t pair = static_cast<std::uint64_t>(std::min(from, to)) * places_.size() + std::max(from, to);
  const auto [known, fresh] = flights_.try_emplace(pair, kNever);
  if (fresh) {
    const std::vector<Vector3d> corners = way(std::min(from, to), std::max(from, to));
    if (!corners.empty()) known->second = flight_s(kinds_[to], places_[std::min(from, to)], corners);
  }
  return std::max(known->second, turn_s(from, to)) + picture_s_;
}

std::vector<Vector3d> Legs::way(std::size_t from, std::size_t to) {
  // The search always begins at the lower number, so that the path is the same in both directions.
  const std::size_t a = std::min(from, to), b = std::max(from, to);
  Ways& ways = ways_[kinds_[to]];
  if (ways.clear(places_[a], places_[b])) return {places_[to]};
  std::vector<Vector3d> corners = ways.way(places_[a], anchors(a), places_[b], anchors(b));
  if (a == from || corners.empty()) return corners;
  std::ranges::reverse(corners);
  corners.erase(corners.begin());
  corners.push_back(places_[a]);
  return corners;
}

bool Legs::linked(std::size_t kind, const Vector3d& p_WB) const {
  const AntennaNode station{scenario_.station_position, scenario_.station_antenna_offset_m};
  const AntennaNode antenna{p_WB, team_.kinds[kind].vehicle.antenna_offset_m};
  const LinkResult link = trace_link(
      station, antenna, [&](const Vector3d& a, const Vector3d& b) { return world_.first_hit_distance(a, b); });
  if (!link.linked) return false;
  // A kind stands for several UAVs, so a range limit of one of them applies to all of its kind.
  for (const UavIndex uav : scenario_.uavs()) {
    if (team_.kind_of[static_cast<std::size_t>(uav)] != kind) continue;
    const std::string& name = scenario_.fleet[uav].name;
    const std::string& station_name = scenario_.node_name(kStationNode);
    const bool both_ways =
        in_range(scenario_, name, station_name, link.range) && in_range(scenario_, station_name, name, link.range);
    if (!both_ways) return false;
  }
  return true;
}

const std::vector<std::uint8_t>& Legs::linked_nodes(std::size_t kind) {
  std::vector<std::uint8_t>& flags = linked_nodes_[kind];
  const std::vector<Vector3d>& nodes = ways_[kind].nodes();
  if (flags.size() != nodes.size()) {
    flags.clear();
    for (const Vector3d& node : nodes) flags.push_back(linked(kind, node) ? 1 : 0);
  }
  return flags;
}

std::optional<std::size_t> Legs::linked_node_for(std::size_t view) {
  const std::size_t kind = kinds_[view];
  const std::vector<std::uint8_t>& flags = linked_nodes(kind);
  float least = std::numeric_limits<float>::infinity();
  std::optional<std::size_t> best;
  for (const std::size_t anchor : anchors(view)) {
    const std::vector<float>& lengths = ways_[kind].lengths_from(anchor);
    const auto first = static_cast<float>((ways_[kind].nodes()[anchor] - places_[view]).norm());
    for (std::size_t node = 0; node < flags.size(); ++node) {
      if (flags[node] == 0 || first + lengths[node] >= least) continue;
      least = first + lengths[node];
      best = node;
    }
  }
  return best;
}

std::vector<Vector3d> Legs::tail(std::size_t view) {
  if (linked(kinds_[view], places_[view])) return {};
  const auto node = linked_node_for(view);
  if (!node) return {};
  Ways& ways = ways_[kinds_[view]];
  const std::vector<std::size_t> there = {*node};
  return ways.way(places_[view], anchors(view), ways.nodes()[*node], there);
}

double Legs::tail_s(std::size_t view) {
  double& known = tails_[view];
  if (known >= 0.0) return known;
  const std::vector<Vector3d> corners = tail(view);
  if (!corners.empty()) return known = flight_s(kinds_[view], places_[view], corners);
  return known = linked(kinds_[view], places_[view]) ? 0.0 : kNever;
}

}  // namespace skein::sim
