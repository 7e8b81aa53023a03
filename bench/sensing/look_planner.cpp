// A planner that takes off and hovers, with or without the beams of its LiDAR, to measure what beams cost a fleet.
#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class LookPlanner final : public Planner {
 public:
  struct Config {
    bool beams = false;
    double height_m = 5.0;

    void describe(auto& r) {
      r.field("beams", beams);
      r.field("height_m", height_m, within(0.2, 200.0));
    }
  };

  explicit LookPlanner(const Config& config) : config_(config) {}

  bool wants_beams() const override { return config_.beams; }

  PlannerOutput plan(const PlannerInput& input) override {
    if (started_) return {};
    started_ = true;
    return {.motion = Path{{{input.state.p_WB + config_.height_m * Vector3d::UnitZ(), 2.0}}}};
  }

 private:
  const Config config_;
  bool started_ = false;
};

SKEIN_REGISTER_PLANNER("look", LookPlanner);

}  // namespace skein::agent
