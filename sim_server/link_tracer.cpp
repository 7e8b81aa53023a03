#include "sim_server/link_tracer.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace skein::sim {
namespace {

/// With fewer nodes, sharing the work takes more time than the work itself.
constexpr std::size_t kSharedNodes = 16;

}  // namespace

LinkTracer::LinkTracer(const Scenario& scenario, const FaultPlan& faults, std::uint64_t seed)
    : scenario_(scenario), faults_(faults), sights_(scenario.fleet.size() + 1), unfailed_(scenario.fleet.size() + 1) {
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
    rays.body_spheres().about(from.p_W, to.p_W, std::max(antenna_reach(from), antenna_reach(to)), about);
    const RayFilter filter{.except_uav = body_of(a), .except_other_uav = body_of(b), .among = about};
    const bool linked = sights_.at(a, b).linked(from, to, rays, filter);
    const double distance_m = (from.p_W - to.p_W).norm();
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
  const auto trace_rows = [&](std::size_t piece) {
    std::vector<UavIndex> about;
    for (const std::size_t row : std::set<std::size_t>{piece, nodes - 1 - piece}) {
      for (std::size_t other = row + 1; other < nodes; ++other) trace_pair(Node{row}, Node{other}, about);
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
