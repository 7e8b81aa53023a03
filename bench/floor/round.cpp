#include "bench/floor/round.hpp"

#include <algorithm>
#include <string>

#include "bus/lockstep/names.hpp"
#include "core/radio/radio_routes.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"

namespace skein::bench {
namespace {

constexpr Seat kServer{Role::server}, kRouter{Role::router}, kStation{Role::station};
constexpr Tick kSomeTick = 20'000;  // numbers have a fixed size on the wire, whatever their value
constexpr std::uint64_t kSomeCount = 1000;

std::string name_of(UavIndex uav) {
  const std::string digits = std::to_string(uav);
  return "uav" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

msg::TopicCount count_of(const topics::WireTopic& topic) {
  msg::TopicCount count;
  count.topic(topic.name);
  count.count(kSomeCount);
  return count;
}

Flow flow(int domain, const topics::WireTopic& topic, const Seat& writer, std::vector<Seat> readers,
          const auto& message) {
  return {domain, bus::spec(topic), writer, std::move(readers), encode(message)};
}

msg::Member member(std::string_view name) {
  msg::Member result;
  result.name(std::string(name));
  return result;
}

msg::Step step_with(std::vector<msg::Member> members, std::vector<msg::TopicCount> expected) {
  msg::Step step;
  step.tick(kSomeTick);
  step.members(std::move(members));
  step.expected(std::move(expected));
  return step;
}

msg::Done done_with(std::string_view name, std::vector<msg::TopicCount> sent) {
  msg::Done done;
  done.member(std::string(name));
  done.sent(std::move(sent));
  return done;
}

void add_agent(std::vector<Flow>& flows, UavIndex uav, std::size_t uavs, int base_domain) {
  const std::string id = name_of(uav);
  const int domain = uav_domain(base_domain, uav);
  const Seat agent{Role::agent, uav};
  const auto to_agent = [&](const topics::WireTopic& topic, const auto& message) {
    flows.push_back(flow(domain, topic, kServer, {agent}, message));
  };
  to_agent(topics::odometry(id), to_odometry(kSomeTick, id, {}));
  to_agent(topics::gimbal(id), to_gimbal(kSomeTick, id, {}));
  to_agent(topics::neighbour_odometry(id), to_cloud(kSomeTick, std::vector<NeighbourPoint>(uavs)));
  to_agent(topics::mission_duration_remained(id), to_duration(600.0));
  to_agent(topics::step(), step_with({member(id), member(bus::kRouterName)},
                                     {count_of(topics::odometry(id)), count_of(topics::gimbal(id)),
                                      count_of(topics::neighbour_odometry(id)),
                                      count_of(topics::mission_duration_remained(id)), count_of(topics::clock())}));

  flows.push_back(flow(domain, topics::trajectory_command(id), agent, {kServer}, to_trajectory(kSomeTick, {})));
  flows.push_back(flow(domain, topics::gimbal_command(id), agent, {kServer}, to_gimbal_command({})));
  flows.push_back(flow(domain, topics::done(), agent, {kServer, kRouter},
                       done_with(id, {count_of(topics::captures(id)), count_of(topics::trajectory_command(id)),
                                      count_of(topics::gimbal_command(id)), count_of(topics::camera_trigger(id)),
                                      count_of(topics::capture_stored())})));
}

void add_ground(std::vector<Flow>& flows, std::size_t uavs, int base_domain) {
  const int world = world_domain(base_domain), gcs = gcs_domain(base_domain);
  std::vector<msg::Member> everybody = {member(bus::kStationName), member(bus::kRouterName)};
  std::vector<msg::TopicCount> acknowledgements;
  for (std::size_t i = 0; i < uavs; ++i) {
    everybody.push_back(member(name_of(UavIndex(i))));
    acknowledgements.push_back(count_of(topics::captures_ack(name_of(UavIndex(i)))));
  }
  msg::Step world_step = step_with(everybody, {});
  world_step.links().resize((uavs + 1) * (uavs + 1));
  flows.push_back(flow(world, topics::step(), kServer, {kRouter}, world_step));
  flows.push_back(flow(gcs, topics::step(), kServer, {kStation},
                       step_with({member(bus::kStationName), member(bus::kRouterName)},
                                 {count_of(topics::clock()), count_of(topics::mission_duration_remained(bus::kGcsName)),
                                  count_of(topics::neighbour_odometry(bus::kGcsName))})));
  flows.push_back(
      flow(gcs, topics::done(), kStation, {kServer, kRouter}, done_with(bus::kStationName, acknowledgements)));
  flows.push_back(flow(world, topics::routed(), kRouter, {kServer}, msg::Routed()));
}

}  // namespace

std::vector<Seat> seats(std::size_t uavs) {
  std::vector<Seat> all = {kServer, kRouter, kStation};
  for (std::size_t i = 0; i < uavs; ++i) all.push_back({Role::agent, i});
  return all;
}

bool Flow::goes_to(const Seat& seat) const { return std::ranges::find(readers, seat) != readers.end(); }

std::vector<Flow> round_flows(std::size_t uavs, int base_domain) {
  std::vector<Flow> flows;
  for (std::size_t i = 0; i < uavs; ++i) add_agent(flows, UavIndex(i), uavs, base_domain);
  add_ground(flows, uavs, base_domain);
  return flows;
}

}  // namespace skein::bench
