// A planner for tests: climbs for 5 s with velocity commands only, then follows a path. It examines every scan, key
// frame and detection, and once a second logs as JSON what it has received so far.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class ProbePlanner final : public Planner {
 public:
  struct Config {
    double east_m = 0.0;  // length of the path to the east
    double up_m = 3.0;    // length of the path upwards

    void describe(auto& r) {
      r.field("east_m", east_m, within(0.0, 100.0));
      r.field("up_m", up_m, within(0.0, 100.0));
    }
  };

  ProbePlanner(const Config& config, const AgentConfig& agent) : config_(config), own_node_(node_of_uav(agent.self)) {}

  bool wants_scans() const override { return true; }

  PlannerOutput plan(const PlannerInput& in) override {
    for (const Scan& scan : in.scans) {
      ++scans_;
      late_ += scan.tick > in.tick || scan.tick + 20 <= in.tick;
      points_ += scan.points_W.size();
    }
    if (!first_detected_) first_detected_ = in.detected.size();
    for (const DetectedPoint& point : in.detected) {
      gaps_ += point.order > named_;
      named_ += point.order == named_;
    }
    for (const KeyFrame& frame : in.key_frames) ++(frame.source == own_node_ ? own_frames_ : others_frames_);
    if (in.k % 20 == 0) {
      const nlohmann::json news = {{"t", seconds(in.tick)},
                                   {"scans", scans_},
                                   {"late", late_},
                                   {"points", points_},
                                   {"own_frames", own_frames_},
                                   {"others_frames", others_frames_},
                                   {"named", named_},
                                   {"gaps", gaps_},
                                   {"first_detected", *first_detected_}};
      spdlog::info("probe {}", news.dump());
    }
    if (in.k < 100) return {.motion = TrajectoryCommand{.v_WB = {0.0, 0.0, 1.5}}};
    if (in.k > 100) return {};
    return {.motion = Path{{{in.state.p_WB + Vector3d(config_.east_m, 0.0, config_.up_m), 1.0}}}};
  }

 private:
  const Config config_;
  const Node own_node_;
  long scans_ = 0, own_frames_ = 0, others_frames_ = 0;
  long late_ = 0;  // number of scans that are not from the last exchange (20 ticks)
  std::size_t points_ = 0;
  long gaps_ = 0;            // number of detected points that arrived although a point with a lower number had not
  std::uint32_t named_ = 0;  // number of points detected so far without a gap; they are numbered from 0
  std::optional<std::size_t> first_detected_;
};

SKEIN_REGISTER_PLANNER("probe", ProbePlanner);

}  // namespace skein::agent
