// Flies by the orders of an external program, such as Python code with skein.Fleet (docs/how-to-python.md): writes an
// observation, waits for the orders of the step, and carries them out. An ordered velocity is flown as by the planner
// `hand`; an ordered way becomes a goal of the flight core or, without the safety filter, a path for the tracker.
#include <cstddef>
#include <optional>
#include <vector>

#include "uav_agent/api/learner.hpp"
#include "uav_agent/planners/hand/hand_flight.hpp"
#include "uav_agent/planners/learner/observation.hpp"
#include "uav_agent/planners/learner/orders.hpp"

namespace skein::agent {

class LearnerPlanner final : public Planner, public Learner {
 public:
  using Config = LearnerConfig;

  LearnerPlanner(const Config& config, const AgentConfig& agent) : config_(config), agent_(agent) {
    BlockLayout layout;
    LearnerPlanner::lay_out(layout, "");
    own_.resize(layout.bytes());
    LearnerPlanner::use(own_.data());
  }

  PlannerOutput plan(const PlannerInput& in) override {
    note(in);
    const bool news = orders_.is_news(serial_);
    serial_ = orders_.serial();
    PlannerOutput out = config_.flies == Flies::velocity ? by_velocity(in) : by_way(news);
    out.gimbal = orders_.gimbal();
    out.trigger = news && orders_.trigger();
    return out;
  }

  bool wants_scans() const override { return config_.scans; }
  bool wants_world_map() const override { return config_.safe; }
  const FlightConfig* flight() const override {
    return config_.flies == Flies::way && config_.safe ? &config_.flight : nullptr;
  }

  Learner* learner() override { return this; }
  void lay_out(BlockLayout& layout, const std::string& prefix) override {
    observation_.lay_out(layout, prefix + "sees.");
    orders_.lay_out(layout, prefix + "does.");
  }
  void use(std::byte* block) override {
    observation_.use(block);
    orders_.use(block);
  }
  void look(const PlannerInput& input) override {
    note(input);
    observation_.write(input);
  }

 private:
  void note(const PlannerInput& in) {
    if (noted_ == in.k) return;
    noted_ = in.k;
    observation_.note(in);
  }

  PlannerOutput by_velocity(const PlannerInput& in) {
    PlannerOutput out;
    if (auto command = flight_.fly(orders_.velocity(), in)) out.motion = *command;
    out.going_to_W = flight_.going_to_W();
    return out;
  }

  /// A new order becomes a new goal; without one, the last goal stays.
  PlannerOutput by_way(bool news) {
    PlannerOutput out;
    if (!news) return out;
    const std::vector<Waypoint> way = orders_.way();
    if (flight() != nullptr) {
      out.goals.emplace();
      if (!way.empty()) out.goals->push_back({.id = serial_, .way = way, .yaw = orders_.yaw()});
    } else if (way.empty()) {
      out.motion = Hold{};
    } else {
      out.motion = Path{way};
    }
    out.yaw = orders_.yaw();
    return out;
  }

  const Config config_;
  const AgentConfig agent_;
  const HandConfig hand_{config_.by_velocity()};
  HandFlight flight_{hand_, agent_};
  Observation observation_{config_, agent_};
  Orders orders_;
  std::vector<std::byte> own_;          ///< the block until use() is called with a shared one
  std::int64_t serial_ = 0;             ///< serial number of the last order
  std::optional<std::uint64_t> noted_;  ///< number of the last exchange that was noted
};

SKEIN_REGISTER_PLANNER("learner", LearnerPlanner);

}  // namespace skein::agent
