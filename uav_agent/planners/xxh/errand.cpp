#include "uav_agent/planners/xxh/errand.hpp"

#include <utility>

#include "uav_agent/planners/xxh/talk.hpp"

namespace skein::agent {

void XxhErrand::listen(const PlannerInput& in) {
  missed_.clear();
  ended_.reset();
  // When the flight core does something else, such as a return-to-link, the UAV chooses again afterwards.
  if (!in.flight.working) drop();
  for (const Outcome& outcome : in.flight.outcomes) {
    const auto i = index(outcome.id);
    if (!under_way_ || !i) continue;
    if (outcome.kind == Outcome::Kind::no_way) {
      missed_.push_back(*i);
      under_way_ = *i + 1 < choices_.size();
    } else {
      ended_ = End{*i, outcome.kind == Outcome::Kind::reached};
      under_way_ = false;
    }
  }
}

void XxhErrand::set_out(std::vector<Goal> choices, PlannerOutput& out) {
  choices_ = std::move(choices);
  first_id_ = next_id_;
  for (Goal& goal : choices_) goal.id = next_id_++;
  under_way_ = !choices_.empty();
  some_left_ = choices_.size() > 1;
  out.goals = choices_;
}

void XxhErrand::drop() {
  some_left_ |= under_way_;
  under_way_ = false;
  missed_.clear();
  ended_.reset();
}

void XxhErrand::conclude(PlannerOutput& out) {
  if (under_way_ || !some_left_ || out.goals) return;
  some_left_ = false;
  out.goals.emplace();
}

std::optional<std::size_t> XxhErrand::index(std::int64_t id) const {
  if (id < first_id_ || id >= next_id_) return std::nullopt;
  return static_cast<std::size_t>(id - first_id_);
}

std::optional<std::size_t> XxhErrand::flies_to(const PlannerInput& in) const {
  return under_way_ && in.flight.goal ? index(*in.flight.goal) : std::nullopt;
}

std::vector<Vector3d> XxhErrand::ahead(const PlannerInput& in) const {
  std::vector<Vector3d> ahead = {in.tracking.setpoint.p_WB};
  const auto flown = flies_to(in);
  if (!flown) return ahead;
  const std::vector<Waypoint>& way = choices_[*flown].way;
  for (std::size_t i = in.flight.on_way ? in.flight.leg : 0; i < way.size() && ahead.size() < XxhWord::kMaxWay; ++i) {
    ahead.push_back(way[i].p_WB);
  }
  return ahead;
}

}  // namespace skein::agent
