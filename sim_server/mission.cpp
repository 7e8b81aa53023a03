#include "sim_server/mission.hpp"

#include <algorithm>
#include <utility>

namespace skein::sim {

Mission::Mission(const Scenario& scenario, std::vector<double> rest_heights)
    : duration_(ticks(scenario.duration_s)),
      takeoff_timeout_(ticks(scenario.takeoff_timeout_s)),
      takeoff_height_(scenario.rules.takeoff_height_m),
      takeoff_speed_(scenario.rules.takeoff_speed_mps),
      collision_kills_both_(scenario.rules.collision_kills_both),
      batteries_are_swapped_(scenario.conditions.battery.swaps()) {
  for (double height : rest_heights) uavs_.push_back({.rest_height = height});
}

std::vector<Collision> Mission::update(Tick tick, const std::vector<RigidBodyState>& states,
                                       const std::vector<Contact>& contacts) {
  if (phase_ == Phase::ended) return {};
  update_airborne(tick, states, contacts);
  std::vector<Collision> collisions = find_collisions(tick, contacts);
  update_phase(tick);
  return collisions;
}

void Mission::update_airborne(Tick tick, const std::vector<RigidBodyState>& states,
                              const std::vector<Contact>& contacts) {
  for (const UavIndex i : FirstUavs(uavs_.size())) {
    Member& uav = uavs_[i];
    if (!uav.alive) continue;
    const bool high = states[i].p_WB.z() > uav.rest_height + takeoff_height_;
    const bool fast = states[i].v_WB.norm() > takeoff_speed_;
    if (high && fast && !uav.airborne) {
      uav.airborne = uav.has_flown = true;
      if (phase_ == Phase::waiting) {
        phase_ = Phase::flying;
        start_tick_ = tick;
      }
    } else if (uav.airborne && !fast) {
      // A UAV that fell may come to rest on a rotor, higher than when it stands on its feet.
      const bool on_ground = std::any_of(contacts.begin(), contacts.end(), [i](const Contact& contact) {
        return contact.uav == i && contact.other.kind == BodyId::Kind::ground;
      });
      if (!high || on_ground) uav.airborne = uav.falls;  // a falling UAV stays airborne: its impact counts
    }
  }
}

std::vector<Collision> Mission::find_collisions(Tick tick, const std::vector<Contact>& contacts) {
  // Judge all contacts on the state before the first of them, so that their order cannot matter.
  std::vector<bool> was_alive, was_flying;
  for (const Member& uav : uavs_) {
    was_alive.push_back(uav.alive);
    was_flying.push_back(uav.alive && uav.airborne);
  }
  std::vector<Collision> collisions;
  const auto kill = [&](UavIndex i, const BodyId& with, const Vector3d& p_W) {
    if (!was_alive[i] || !uavs_[i].alive) return;
    uavs_[i].alive = uavs_[i].airborne = false;
    collisions.push_back({tick, i, with, p_W, uavs_[i].falls});
  };
  for (const Contact& contact : contacts) {
    const BodyId& other = contact.other;
    if (other.kind == BodyId::Kind::ground && !uavs_[contact.uav].falls) continue;
    const bool pair = other.kind == BodyId::Kind::uav, first_flies = was_flying[contact.uav];
    const bool second_flies = pair && was_flying[other.uav];
    const bool both = collision_kills_both_ && pair && (first_flies || second_flies);
    if (first_flies || both) kill(contact.uav, other, contact.p_W);
    if (second_flies || both) kill(other.uav, {BodyId::Kind::uav, contact.uav}, contact.p_W);
  }
  std::stable_sort(collisions.begin(), collisions.end(),
                   [](const Collision& a, const Collision& b) { return a.uav < b.uav; });
  return collisions;
}

void Mission::update_phase(Tick tick) {
  if (phase_ == Phase::waiting) {
    if (tick >= takeoff_timeout_) finish(tick, MissionEnd::takeoff_timeout);
    return;
  }
  const bool none_flies = std::ranges::all_of(uavs_, [this](const Member& uav) {
    return !uav.alive || (uav.has_flown && !uav.airborne && !batteries_are_swapped_);
  });
  if (tick >= *start_tick_ + duration_) {
    finish(tick, MissionEnd::duration);
  } else if (none_flies) {
    finish(tick, MissionEnd::no_uav_flies);
  }
}

void Mission::finish(Tick tick, MissionEnd why) {
  phase_ = Phase::ended;
  end_ = why;
  end_tick_ = tick;
}

double Mission::remaining_s(Tick tick) const {
  switch (phase_) {
    case Phase::waiting:
      return seconds(duration_);
    case Phase::flying:
      return seconds(*start_tick_ + duration_ - tick);
    case Phase::ended:
      break;
  }
  return 0.0;
}

}  // namespace skein::sim
