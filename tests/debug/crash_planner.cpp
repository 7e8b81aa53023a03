// A planner for tests: hovers until a simulated time, then crashes, asks for too high a speed, or flies into a block.
#include <spdlog/spdlog.h>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class CrashPlanner final : public Planner {
 public:
  struct Config {
    double at_s = 2.0;
    bool reckless = false;  ///< asks for more speed than the UAV can fly, instead of crashing
    bool rams = false;      ///< flies into the block of the small scene, instead of both

    void describe(auto& r) {
      r.field("at_s", at_s, within(0.0, 100.0));
      r.field("reckless", reckless);
      r.field("rams", rams);
    }
  };

  CrashPlanner(const Config& config, const AgentConfig&) : config_(config) {}

  PlannerOutput plan(const PlannerInput& in) override {
    spdlog::debug("step {}", in.k);
    if (seconds(in.tick) < config_.at_s) return {};
    PlannerOutput out;
    if (config_.rams) {
      out.motion = TrajectoryCommand{.p_WB = {30.0, 0.0, 5.0}};
      return out;
    }
    if (!config_.reckless) *nothing_ = 1;  // HERE
    out.motion = TrajectoryCommand{.v_WB = {0.0, 0.0, 1000.0}};
    return out;
  }

 private:
  const Config config_;
  volatile int* volatile nothing_ = nullptr;
};

SKEIN_REGISTER_PLANNER("crash", CrashPlanner);

}  // namespace skein::agent
