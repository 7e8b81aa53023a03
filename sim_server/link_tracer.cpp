#include "sim_server/link_tracer.hpp"

#include <algorithm>

namespace skein::sim {

Links LinkTracer::trace(Tick tick, const RayScene& rays, const std::vector<Place>& uavs) {
  Links links(uavs.size() + 1);
  const auto body_of = [](Node node) { return uav_of_node(node).value_or(kNobody); };
  const auto antenna = [&](Node node) {
    const auto uav = uav_of_node(node);
    if (!uav) return AntennaNode{scenario_.station_position, scenario_.station_antenna_offset_m};
    return AntennaNode{uavs[*uav].p_WB, scenario_.fleet[*uav].vehicle.antenna_offset_m};
  };
  const auto on_air = [&](Node node) { return node == kStationNode || uavs[*uav_of_node(node)].alive; };
  std::vector<UavIndex> about;
  for (const Node a : scenario_.nodes()) {
    for (const Node b : scenario_.nodes()) {
      if (b <= a || !on_air(a) || !on_air(b)) continue;
      const AntennaNode from = antenna(a), to = antenna(b);
      rays.body_spheres().about(from.p_W, to.p_W, std::max(antenna_reach(from), antenna_reach(to)), about);
      const RayFilter filter{.except_uav = body_of(a), .except_other_uav = body_of(b), .among = about};
      const bool linked = sights_.at(a, b).linked(from, to, rays, filter);
      const double distance_m = (from.p_W - to.p_W).norm();
      links.at(a, b) = linked && in_range(tick, a, b, distance_m);
      links.at(b, a) = linked && in_range(tick, b, a, distance_m);
    }
  }
  return links;
}

Links LinkTracer::open(Tick tick, const Links& links) const {
  Links open = links;
  const auto cut = cut_links(faults_, scenario_, tick);
  if (!cut) return open;
  for (const Node from : scenario_.nodes()) {
    for (const Node to : scenario_.nodes()) open.at(from, to) &= static_cast<std::uint8_t>(cut->at(from, to) == 0);
  }
  return open;
}

bool LinkTracer::in_range(Tick tick, Node from, Node to, double distance_m) const {
  const auto ends_before = [&](const LinkEffect& effect) {
    return effect.range_m && distance_m > *effect.range_m && names_node(effect.from, scenario_.node_name(from)) &&
           names_node(effect.to, scenario_.node_name(to));
  };
  const auto fails_before = [&](const Fault& fault) {
    const auto* effect = std::get_if<LinkEffect>(&fault.action);
    return effect != nullptr && fault.active(tick) && ends_before(*effect);
  };
  return std::none_of(scenario_.links.begin(), scenario_.links.end(), ends_before) &&
         std::none_of(faults_.faults.begin(), faults_.faults.end(), fails_before);
}

}  // namespace skein::sim
