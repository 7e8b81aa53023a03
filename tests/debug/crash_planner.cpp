// A planner of a test: hovers, and crashes at a simulated time.
#include <spdlog/spdlog.h>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class CrashPlanner final : public Planner {
 public:
  struct Config {
    double at_s = 2.0;

    template <class R>
    void describe(R& r) {
      r.field("at_s", at_s, within(0.0, 100.0));
    }
  };

  CrashPlanner(const Config& config, const AgentConfig&) : config_(config) {}

  PlannerOutput plan(const PlannerInput& in) override {
    spdlog::debug("step {}", in.k);
    if (seconds(in.tick) >= config_.at_s) *nothing_ = 1;  // HERE
    return {};
  }

 private:
  const Config config_;
  volatile int* volatile nothing_ = nullptr;
};

SKEIN_REGISTER_PLANNER("crash", CrashPlanner);

}  // namespace skein::agent
