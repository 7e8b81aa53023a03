#include "sim_server/link_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace skein::sim {
namespace {

/// With fewer nodes, sharing the work takes more time than the work itself.
constexpr std::size_t kSharedNodes = 16;

/// The shortest range of the effects that limit every link between UAVs; nullopt: none does.
std::optional<double> common_range(const std::vector<LinkEffect>& links) {
  const auto names_all = [](const std::vector<std::string>& nodes) {
    return nodes == std::vector<std::string>{"all"} || nodes == std::vector<std::string>{"uavs"};
  };
  std::optional<double> range_m;
  for (const LinkEffect& effect : links) {
    if (!effect.range_m || !names_all(effect.from) || !names_all(effect.to)) continue;
    range_m = std::min(range_m.value_or(*effect.range_m), *effect.range_m);
  }
  return range_m;
}

/// The nodes of a step by squares of the ground plane, whose side is about the range of the radio: a link between UAVs
/// connects nodes of the same or of adjacent squares. The ground station may have a link with every UAV.
class NodeSquares {
 public:
  /// @param range_m  of every link between UAVs; nullopt: all nodes are in one square. @param places  antennas, by
  /// node.
  NodeSquares(std::optional<double> range_m, const std::vector<Vector3d>& places) : range_m_(range_m) {
    for (std::size_t node = 0; node < places.size(); ++node) {
      own_.push_back(square_of(places[node]));
      nodes_[own_.back()].push_back(node);
    }
  }

  /// Calls `visit` with each node of a greater number that may have a link with this node.
  void visit_pairs(std::size_t node, const auto& visit) const {
    if (node == kStationNode) {
      for (std::size_t uav = node + 1; uav < own_.size(); ++uav) visit(uav);
      return;
    }
    const auto [x, y] = own_[node];
    for (const std::int64_t column : {x - 1, x, x + 1}) {
      for (const std::int64_t row : {y - 1, y, y + 1}) {
        const auto square = nodes_.find({column, row});
        if (square == nodes_.end()) continue;
        const auto& others = square->second;  // ascending
        for (auto other = std::ranges::upper_bound(others, node); other != others.end(); ++other) visit(*other);
      }
    }
  }

 private:
  using Square = std::pair<std::int64_t, std::int64_t>;

  Square square_of(const Vector3d& p_W) const {
    if (!range_m_) return {0, 0};
    const double side_m = 1.001 * *range_m_;  // greater than the range by more than rounding errors
    return {std::llround(std::floor(p_W.x() / side_m)), std::llround(std::floor(p_W.y() / side_m))};
  }

  const std::optional<double> range_m_;
  std::vector<Square> own_;  ///< by node
  std::map<Square, std::vector<std::size_t>> nodes_;
};

}  // namespace

LinkTracer::LinkTracer(const Scenario& scenario, const FaultPlan& faults, std::uint64_t seed)
    : scenario_(scenario),
      faults_(faults),
      range_m_(common_range(scenario.links)),
      sights_(scenario.fleet.size() + 1),
      unfailed_(scenario.fleet.size() + 1) {
  if (!scenario.conditions.radio.on()) return;
  path_loss_.emplace(scenario.conditions.radio, seed);
  fields_.resize(scenario.fleet.size() + 1);
  received_dbm_ = LinkMatrix<double>(scenario.fleet.size() + 1);
}

Links LinkTracer::trace(Tick tick, const RayScene& rays, const std::vector<Place>& uavs, const ForEach& for_each) {
  Links links(uavs.size() + 1);
  unfailed_ = links;
  const auto body_of = [](Node node) { return uav_of_node(node).value_or(kNoUav); };
  const auto antenna = [&](Node node) {
    const auto uav = uav_of_node(node);
    if (!uav) return AntennaNode{scenario_.station_position, scenario_.station_antenna_offset_m};
    return AntennaNode{uavs[*uav].p_WB, scenario_.fleet[*uav].vehicle.antenna_offset_m};
  };
  const auto on_air = [&](Node node) { return node == kStationNode || uavs[*uav_of_node(node)].alive; };
  const auto field_of = [this](Node node) { return *fields_[node].value; };
  const auto trace_pair = [&](Node a, Node b, std::vector<UavIndex>& about) {
    if (!on_air(a) || !on_air(b)) return;
    const AntennaNode from = antenna(a), to = antenna(b);
    const double distance_m = (from.p_W - to.p_W).norm();
    if (!in_range(a, b, distance_m) && !in_range(b, a, distance_m)) return;
    rays.body_spheres().about(from.p_W, to.p_W, std::max(antenna_reach(from), antenna_reach(to)), about);
    const RayFilter filter{.except_uav = body_of(a), .except_other_uav = body_of(b), .among = about};
    const bool linked = sights_[a][b].linked(from, to, rays, filter);
    std::uint8_t level = linked ? 1 : 0;
    if (linked && path_loss_) {
      const double received_dbm = path_loss_->received_dbm(from.p_W, to.p_W, field_of(a) + field_of(b));
      received_dbm_.at(a, b) = received_dbm_.at(b, a) = received_dbm;
      level = PathLoss::level(received_dbm);
    }
    for (const auto& [source, target] : {std::pair(a, b), std::pair(b, a)}) {
      const std::uint8_t unfailed = in_range(source, target, distance_m) ? level : 0;
      unfailed_.at(source, target) = unfailed;
      links.at(source, target) = fails(tick, source, target, distance_m) ? 0 : unfailed;
    }
  };
  // A piece of work is a row and its counterpart from the end of the matrix, so that all pieces have the same size.
  const std::size_t nodes = links.nodes();
  std::vector<Vector3d> places;
  for (const Node node : scenario_.nodes()) places.push_back(antenna(node).p_W);
  const NodeSquares squares(range_m_, places);
  const auto trace_rows = [&](std::size_t piece) {
    std::vector<UavIndex> about;
    for (const std::size_t row : std::set<std::size_t>{piece, nodes - 1 - piece}) {
      squares.visit_pairs(row, [&](std::size_t other) { trace_pair(Node{row}, Node{other}, about); });
    }
  };
  const ForEach share = nodes < kSharedNodes ? one_after_another : for_each;
  share(fields_.size(), [&](std::size_t node) {
    if (on_air(Node{node})) update(fields_[node], antenna(Node{node}).p_W);
  });
  share((nodes + 1) / 2, trace_rows);
  return links;
}

void LinkTracer::update(NodeField& field, const Vector3d& p_W) const {
  if (field.value && field.p_W == p_W) return;  // the station, and UAVs that stand still
  field = {p_W, path_loss_->field_at(p_W)};
}

Links LinkTracer::open(Tick tick, const Links& links) const {
  Links open = links;
  const auto cut = cut_links(faults_, scenario_, tick);
  if (!cut) return open;
  for (const Node from : scenario_.nodes()) {
    for (const Node to : scenario_.nodes()) {
      if (cut->at(from, to) != 0) open.at(from, to) = 0;
    }
  }
  return open;
}

std::optional<LinkQuality> LinkTracer::quality(std::uint8_t level, Node from, Node to) const {
  if (level == 0 || !path_loss_) return std::nullopt;
  return LinkQuality{received_dbm_.at(from, to),
                     scenario_.conditions.radio.rate_share * kRadioRates.at(level - 1U).rate_bit_s};
}

bool LinkTracer::ends_before(const LinkEffect& effect, Node from, Node to, double distance_m) const {
  return effect.range_m && distance_m > *effect.range_m && names_node(effect.from, scenario_.node_name(from)) &&
         names_node(effect.to, scenario_.node_name(to));
}

bool LinkTracer::in_range(Node from, Node to, double distance_m) const {
  return std::none_of(scenario_.links.begin(), scenario_.links.end(),
                      [&](const LinkEffect& effect) { return ends_before(effect, from, to, distance_m); });
}

bool LinkTracer::fails(Tick tick, Node from, Node to, double distance_m) const {
  return std::any_of(faults_.faults.begin(), faults_.faults.end(), [&](const Fault& fault) {
    const auto* effect = std::get_if<LinkEffect>(&fault.action);
    return effect != nullptr && fault.active(tick) && ends_before(*effect, from, to, distance_m);
  });
}

}  // namespace skein::sim
