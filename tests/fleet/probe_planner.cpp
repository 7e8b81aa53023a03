// A planner of a test: climbs by bare velocities, then follows a path; it looks at every scan and
// key frame, and logs once a second what it has got so far, as JSON.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "uav_agent/planner.hpp"

namespace skein::agent {

class ProbePlanner final : public Planner {
 public:
  struct Config {
    template <class R>
    void describe(R&) {}
  };

  ProbePlanner(const Config&, const AgentConfig& agent) : own_node_(node_of_uav(agent.self)) {}

  bool wants_scans() const override { return true; }

  PlannerOutput plan(const PlannerInput& in) override {
    for (const Scan& scan : in.scans) {
      ++scans_;
      late_ += scan.tick > in.tick || scan.tick + 20 <= in.tick;
      points_ += scan.points_W.size();
    }
    for (const KeyFrame& frame : in.key_frames) ++(frame.source == own_node_ ? own_frames_ : others_frames_);
    if (in.k % 20 == 0) {
      const nlohmann::json news = {
          {"t", seconds(in.tick)}, {"scans", scans_},         {"late", late_},
          {"points", points_},     {"own_frames", own_frames_}, {"others_frames", others_frames_}};
      spdlog::info("probe {}", news.dump());
    }
    if (in.k < 100) return {.motion = TrajectoryCommand{.v_WB = {0.0, 0.0, 1.5}}};
    if (in.k > 100) return {};
    return {.motion = Path{{{in.state.p_WB + Vector3d(0.0, 0.0, 3.0), 1.0}}}};
  }

 private:
  const Node own_node_;
  long scans_ = 0, late_ = 0, own_frames_ = 0, others_frames_ = 0;
  std::size_t points_ = 0;
};

SKEIN_REGISTER_PLANNER("probe", ProbePlanner);

}  // namespace skein::agent
