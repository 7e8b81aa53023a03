// XXH's program at the ground station: collects the UAVs' starts, closes the list, assigns teams and regions
// (plan.hpp), and sends the assignment until all UAVs have it. `--planner xxh` starts it beside the UAVs.
// Source: paper, "Task Assignment" of Team XXH. Our choice: a complete list is closed at once, since no report is
// missing; and a UAV that could not report counts as standing at its nominal start, because it assumes the same.
#include <map>

#include "uav_agent/api/ground_program.hpp"
#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/talk.hpp"

namespace skein::agent {

class XxhGround final : public GroundProgram {
 public:
  using Config = XxhConfig;

  XxhGround(const Config& config, const AgentConfig& ground) : config_(config.resolved()), ground_(ground) {}

  std::vector<RadioMessage> work(const GroundInput& in) override {
    bool one_lacks_it = false;
    for (const RadioMessage& message : in.radio) {
      const auto heard = open_word(message, ground_.fleet.size());
      if (!heard) continue;
      const auto& [uav, word] = *heard;
      one_lacks_it |= !word.has_plan;
      if (plan_ || !reports_.emplace(uav, word.start_W).second) continue;
      last_new_ = in.tick;
    }
    if (!plan_ && list_is_closed(in)) make_plan(in);
    lacking_ |= one_lacks_it;
    if (!plan_ || !lacking_ || !ground_.due(in.k, config_.assign_every_s, 0)) return {};
    lacking_ = false;
    return {plan_message(*plan_, ground_.fleet.size())};
  }

 private:
  bool list_is_closed(const GroundInput& in) const {
    if (in.boxes.empty() || reports_.empty()) return false;
    const bool complete = reports_.size() == ground_.fleet.size() && !*config_.reported_only;
    return complete || seconds(in.tick - last_new_) >= config_.freeze_s;
  }

  void make_plan(const GroundInput& in) {
    std::vector<XxhStart> starts;
    for (std::size_t uav = 0; uav < ground_.fleet.size(); ++uav) {
      const FleetMember& member = ground_.fleet[uav];
      const auto report = reports_.find(uav);
      if (report != reports_.end()) {
        starts.push_back({uav, member.role, settled_start(report->second, member.p_WB_start)});
      } else if (!*config_.reported_only) {
        starts.push_back({uav, member.role, member.p_WB_start});
      }
    }
    plan_ = assign(std::move(starts), in.boxes, config_.split_tolerance);
  }

  const Config config_;
  const AgentConfig ground_;
  std::map<std::size_t, Vector3d> reports_;  ///< starts, by UAV
  Tick last_new_ = 0;
  std::optional<XxhPlan> plan_;
  bool lacking_ = false;  ///< a UAV has reported since the last publication that it lacks the assignment
};

SKEIN_REGISTER_GROUND_PROGRAM("xxh", XxhGround);

}  // namespace skein::agent
