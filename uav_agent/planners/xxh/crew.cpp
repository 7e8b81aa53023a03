#include "uav_agent/planners/xxh/crew.hpp"

#include <algorithm>

namespace skein::agent {

bool XxhCrew::seek_assignment(const PlannerInput& in, bool in_flight) {
  if (assigned() || in.boxes.empty()) return false;
  if (talk_.plan()) {
    if (const XxhTeam* team = talk_.plan()->team_of(agent_.self)) {
      team_ = *team;
      return true;
    }
  }
  if (!in_flight && seconds(in.tick) <= config_.assignment_wait_s) return false;
  std::vector<XxhStart> starts;
  for (std::size_t uav = 0; uav < agent_.fleet.size(); ++uav) {
    const FleetMember& member = agent_.fleet[uav];
    const XxhWord* word = talk_.word(uav);
    const Vector3d start = word ? settled_start(word->start_W, member.p_WB_start) : member.p_WB_start;
    starts.push_back({uav, member.role, start});
  }
  team_ = *assign(std::move(starts), in.boxes, config_.split_tolerance).team_of(agent_.self);
  return true;
}

std::size_t XxhCrew::rank() const {
  return static_cast<std::size_t>(std::ranges::find(team_.members, agent_.self) - team_.members.begin());
}

bool XxhCrew::silent(std::size_t uav, Tick now) const { return talk_.silent_s(uav, now) > *config_.silence_s; }

std::size_t XxhCrew::awaited(Tick now) const {
  if (leader() != agent_.self) return leader();
  const auto found =
      std::ranges::find_if(team_.members, [&](std::size_t uav) { return uav != agent_.self && !silent(uav, now); });
  return found == team_.members.end() ? agent_.self : *found;
}

bool XxhCrew::ordered(std::size_t region) const {
  const XxhWord* word = talk_.word(leader());
  if (!word) return false;
  return word->region > region || (word->region == region && word->explored > section_of(rank()));
}

template <class Test>
bool XxhCrew::all_others(std::size_t region, Tick now, const Test& test) const {
  return std::ranges::all_of(team_.members, [&](std::size_t uav) {
    const XxhWord* word = talk_.word(uav);
    if (uav == agent_.self || silent(uav, now)) return true;
    return word && (word->region > region || (word->region == region && test(*word)));
  });
}

bool XxhCrew::all_ordered(std::size_t region, Tick now) const {
  return all_others(region, now, [](const XxhWord& word) { return word.acknowledged; });
}

bool XxhCrew::all_done(std::size_t region, Tick now) const {
  return all_others(region, now, [](const XxhWord& word) { return word.done; });
}

std::size_t XxhCrew::farthest_region() const {
  std::size_t farthest = 0;
  for (const std::size_t uav : team_.members) {
    if (const XxhWord* word = talk_.word(uav)) farthest = std::max<std::size_t>(farthest, word->region);
  }
  return farthest;
}

}  // namespace skein::agent
