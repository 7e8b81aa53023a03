// Takes off to a height and hovers there: the smallest planner, and a measure of what a run costs without planning.
#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent {

class HoverPlanner final : public Planner {
 public:
  struct Config {
    double height_m = 3.0;   ///< above the start; chosen
    double climb_mps = 1.0;  ///< chosen

    void describe(auto& r) {
      r.field("height_m", height_m, within(0.2, 200.0));
      r.field("climb_mps", climb_mps, within(0.1, 5.0));
    }
  };

  HoverPlanner(const Config& config, const AgentConfig& agent) : config_(config), agent_(agent) {}

  PlannerOutput plan(const PlannerInput& input) override {
    if (started_) return {};
    started_ = true;
    const Vector3d here = input.state.p_WB;
    Vector3d top = here + config_.height_m * Vector3d::UnitZ();
    // A UAV whose program is restarted in flight must not climb once more.
    if (here.z() > kBeginsInFlightM) top.z() = agent_.me().p_WB_start.z() + config_.height_m;
    return {.motion = Path{{{top, config_.climb_mps}}}, .gimbal = GimbalCommand{GimbalMode::angle, 0.0, 0.0}};
  }

 private:
  const Config config_;
  const AgentConfig agent_;
  bool started_ = false;
};

SKEIN_REGISTER_PLANNER("hover", HoverPlanner);

}  // namespace skein::agent
