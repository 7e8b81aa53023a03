#include "sim_server/look_node.hpp"

#include <algorithm>

#include "bus/lockstep/names.hpp"
#include "core/messages/view_topics.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "view/cube_runs.hpp"

namespace skein::sim {
namespace {

using std::chrono::milliseconds;

/// Least time between two maps of a UAV. After a large map it is longer, so that the maps stay within the budget.
constexpr milliseconds kShownMapPeriod{1000};
/// If a UAV's map has no writer for this time, the page is told that there is no map.
constexpr milliseconds kMapPatience{3000};
constexpr const char* kFlightMap = "what it flies on";

std::optional<UavIndex> uav_of(const Scenario& scenario, const std::string& name) {
  for (const UavIndex uav : scenario.uavs()) {
    if (scenario.fleet[uav].name == name) return uav;
  }
  return std::nullopt;
}

}  // namespace

LookNode::LookNode(const Scenario& scenario, const Simulation& simulation, bus::Participant& world,
                   std::span<const std::unique_ptr<bus::Participant>> uavs)
    : scenario_(scenario),
      simulation_(simulation),
      uavs_(uavs),
      budget_(view::look_budget(scenario.fleet.size())),
      clouds_(world.create_writer(bus::spec(topics::view_cloud()))) {}

Json LookNode::offer() const {
  Json lidar = Json::array();
  for (const UavConfig& uav : scenario_.fleet) {
    if (uav.vehicle.lidar) lidar.push_back(uav.name);
  }
  return {{"lidar", std::move(lidar)}, {"maps", scenario_.uav_names()}};
}

void LookNode::obey(const view::LookOrder& order, Clock::time_point now) {
  for (const std::string& name : order.lidar) {
    const auto uav = uav_of(scenario_, name);
    if (uav && scenario_.fleet[*uav].vehicle.lidar) lidars_[*uav].until = now + view::kLookLease;
  }
  if (const auto uav = uav_of(scenario_, order.map)) look_at_map(*uav, now);
}

void LookNode::look_at_map(UavIndex uav, Clock::time_point now) {
  Map& map = maps_[uav];
  map.until = now + view::kLookLease;
  if (map.reader) return;
  map.since = now;
  map.arrived = std::make_shared<Arrived>();
  map.reader = uavs_[uav]->create_reader(bus::spec(topics::flight_map(scenario_.fleet[uav].name)),
                                         [arrived = map.arrived](bus::Sample&& sample) {
                                           const std::scoped_lock lock(arrived->mutex);
                                           arrived->payload = std::move(sample.payload);
                                         });
}

bool LookNode::wants_scan(UavIndex uav, Clock::time_point now) const {
  const auto lidar = lidars_.find(uav);
  return lidar != lidars_.end() && now < lidar->second.until && now >= points_due_;
}

void LookNode::begin_step() {
  for (const LidarEvent& event : simulation_.events().scans) {
    const auto lidar = lidars_.find(event.uav);
    if (lidar == lidars_.end()) continue;
    lidar->second.points.add(event.scan.points_W);
    lidar->second.tick = event.scan.tick;
  }
}

void LookNode::tell(Clock::time_point now) {
  std::erase_if(lidars_, [now](const auto& one) { return now >= one.second.until; });
  std::erase_if(maps_, [now](const auto& one) { return now >= one.second.until; });
  if (now >= points_due_) tell_points(now);
  for (auto& [uav, map] : maps_) {
    if (now >= map.due) tell_map(uav, map, now);
  }
}

void LookNode::tell_points(Clock::time_point now) {
  for (auto& [uav, lidar] : lidars_) {
    if (lidar.points.empty()) continue;
    const std::size_t most = std::max<std::size_t>(1, budget_.points / lidars_.size());
    const view::PointsStep step{seconds(lidar.tick), lidar.points.take(most)};
    write(view::lidar_text(scenario_.fleet[uav].name, std::span(&step, 1)));
    points_due_ = now + view::LookBudget::kPointsPeriod;
  }
}

void LookNode::tell_map(UavIndex uav, Map& map, Clock::time_point now) {
  std::optional<std::vector<std::uint8_t>> payload;
  {
    const std::scoped_lock lock(map.arrived->mutex);
    payload.swap(map.arrived->payload);
  }
  if (payload) {
    const std::size_t size = write(shown(uav, *payload));
    map.due = now + std::max(kShownMapPeriod, milliseconds(1000 * size / budget_.map_bytes_per_s));
    map.told = true;
  } else if (!map.told && now >= map.since + kMapPatience && map.reader->matched().empty()) {
    write(view::no_map_text(scenario_.fleet[uav].name, seconds(simulation_.tick()), "its program shows none"));
    map.told = true;
  }
}

/// A UAV's map as text for the page. @param payload  of a sample of its map.
std::string LookNode::shown(UavIndex uav, std::span<const std::uint8_t> payload) const {
  const std::string& name = scenario_.fleet[uav].name;
  msg::Octomap message;
  std::optional<view::ShownMap> map;
  double time_s = seconds(simulation_.tick());
  if (decode(payload, message) && message.binary() && message.id() == "OcTree") {
    const std::string_view bytes(reinterpret_cast<const char*>(message.data().data()), message.data().size());
    map = view::shown_map(bytes, message.resolution(), simulation_.uav(uav).state.p_WB.z());
    time_s = seconds(from_time(message.header().stamp()));
  }
  return map ? view::map_text(name, time_s, *map, kFlightMap)
             : view::no_map_text(name, time_s, "its program shows one that is damaged");
}

/// @returns the size of the text [bytes].
std::size_t LookNode::write(const std::string& text) {
  msg::String message;
  message.data(text);
  clouds_->write(encode(message));
  return text.size();
}

}  // namespace skein::sim
