// Manual flight: carries out the commands of a user on the web page of a watched run (docs/view.md), or replays the
// commands in the file that such a run leaves. The planner triggers no pictures: the camera works as the scenario
// configures it, and the on-board software delivers the captures when the station is in line of sight.
//
// The same commands at the same ticks give the same flight: the planner knows nothing else about the user.
#include <optional>
#include <utility>
#include <vector>

#include "core/planners/hand_file.hpp"
#include "uav_agent/planners/hand/hand_flight.hpp"

namespace skein::agent {

class HandPlanner final : public Planner {
 public:
  using Config = HandConfig;

  HandPlanner(const Config& config, const AgentConfig& agent) : config_(config), agent_(agent) {
    if (!config.file.empty()) rows_ = hand_file::read(config.file);
  }
  HandPlanner(const HandPlanner&) = delete;  // parts refer to each other
  HandPlanner& operator=(const HandPlanner&) = delete;

  PlannerOutput plan(const PlannerInput& in) override {
    listen(in);
    PlannerOutput out{.gimbal = GimbalCommand{GimbalMode::rate, wanted_.gimbal_pitch_rate, wanted_.gimbal_yaw_rate}};
    if (auto command = flight_.fly(wanted_, in)) out.motion = *command;
    out.going_to_W = flight_.going_to_W();
    if (const HeldBack held = flight_.held_back(); std::exchange(told_, held) != held) {
      out.debug.push_back({kHeldSignal, static_cast<double>(held)});
    }
    return out;
  }

  bool wants_world_map() const override { return config_.safe; }
  std::vector<std::string> debug_names() const override { return {kHeldSignal}; }

 private:
  /// Takes the newest command, from the user or from the file. So a program that was restarted or suspended goes on
  /// with the command in force by then.
  void listen(const PlannerInput& in) {
    if (!rows_) {
      if (in.hand) wanted_ = *in.hand;
      return;
    }
    for (; next_ < rows_->size() && (*rows_)[next_].tick <= in.tick; ++next_) wanted_ = (*rows_)[next_].command;
  }

  const Config config_;
  const AgentConfig agent_;
  HandFlight flight_{config_, agent_};
  std::optional<std::vector<HandRow>> rows_;  ///< recorded commands, if the user gave a file
  std::size_t next_ = 0;
  HandCommand wanted_;
  std::optional<HeldBack> told_;
};

SKEIN_REGISTER_PLANNER("hand", HandPlanner);

}  // namespace skein::agent
