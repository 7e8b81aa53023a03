// KIOS: the strategy of the team that won the first contest, rebuilt from its published description.
//
// 1. The operational volume is the smallest cuboid that holds all boxes and all starts; it is cut into cubes, which are
//    the places of a graph. 2. Mapping: explorers fly straight along its longest axis; photographers wait in the air.
// 3. Inspection: around the occupied cubes there is one waypoint for each exposed face, and all UAVs share them out:
//    each solves a multiple travelling salesmen problem for those in line of sight and flies the first leg of its own
//    tour; at every waypoint it stops, turns the camera to the surface, photographs, and solves again. Maps and what
//    was photographed are exchanged all the time with whoever is in line of sight. No two UAVs enter one cube.
//
// Its weaknesses are the published ones: photographers idle while the explorers map; one quick pass on coarse cubes
// misses thin members; without anybody in line of sight a UAV plans for itself alone and does others' work again.
// Not published, and so our choice: every number below, where in a free cube it stops (stops.hpp), the lanes
// (lanes.hpp), the messages (talk.hpp), and that waypoints around the boxes do where nobody has a LiDAR. The flight
// core does the flying (flight_core/flight_core.hpp).
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/euler.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/flight/voxel_route.hpp"
#include "uav_agent/planners/kios/config.hpp"
#include "uav_agent/planners/kios/lanes.hpp"
#include "uav_agent/planners/kios/mapping.hpp"
#include "uav_agent/planners/kios/patience.hpp"
#include "uav_agent/planners/kios/stops.hpp"
#include "uav_agent/planners/kios/talk.hpp"
#include "uav_agent/planning/aiming.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {
namespace {

constexpr double kAutoVoxelRatio = 0.9, kSmallestVoxelM = 2.5, kLargestVoxelM = 6.0;  ///< of d*
constexpr double kLaneHeight = 0.25, kLaneUpM = 2.0;   ///< of the site's: lanes lie higher than that, by so much
constexpr double kLookAtMapS = 1.0;                    ///< between two looks at the map
constexpr double kRestS = 1.0;                         ///< when there is nothing to do
constexpr double kStayS = 2.0;                         ///< who waits says again and again that it wants to stay
constexpr double kAimPatienceS = 3.0;                  ///< at a waypoint; some directions are out of the gimbal's reach
constexpr std::size_t kCandidates = 5;                 ///< stops tried in one decision
constexpr int kMostMoreLanes = 3;                      ///< times, for explorers that have found nothing
constexpr double kStandsMps = 1.0;                     ///< a way may begin where a UAV that is so slow is
constexpr double kBoxesComeS = 5.0, kLiftOffS = 20.0;  ///< to, and of, whoever is there from the beginning

}  // namespace

class KiosPlanner final : public Planner {
 public:
  using Config = KiosConfig;

  KiosPlanner(const Config& config, const AgentConfig& agent)
      : config_(config.resolved()),
        agent_(agent),
        reach_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel)),
        talk_({.share_s = config.share_s, .claim_s = config.claim_s}, agent_),
        patience_(agent_, talk_),
        stops_(stops_config()),
        mapping_(config.map_mps) {}

  const FlightConfig* flight() const override { return &config_.flight; }
  PlannerOutput plan(const PlannerInput& in) override;

 private:
  enum class Phase { map, wait, decide, fly, look };
  using Id = VoxelGrid::Id;
  /// A waypoint that it has asked the flight core to fly to.
  struct Candidate {
    std::int64_t goal = 0;
    KiosStop stop;
    std::vector<Vector3d> corners = {};  ///< on the way to it; empty: the flight core finds one
  };

  KiosStops::Config stops_config() const;
  void survey_site(const PlannerInput& in);
  void look_at_map(const PlannerInput& in);
  void carry_on(const PlannerInput& in, PlannerOutput& out);
  void lay_lanes(const PlannerInput& in, int count);
  void map(const PlannerInput& in, PlannerOutput& out);
  void wait(const PlannerInput& in, PlannerOutput& out);
  void decide(const PlannerInput& in, PlannerOutput& out);
  void nothing_to_reach(const PlannerInput& in, bool stops_left, PlannerOutput& out);
  void fly_more_lanes(const PlannerInput& in);
  std::vector<KiosAgent> fleet_in_sight(const PlannerInput& in, bool same_role, std::size_t& self) const;
  void propose(const std::vector<KiosStop>& stops, const PlannerInput& in, PlannerOutput& out);
  Goal goal_of(const Candidate& candidate, const PlannerInput& in) const;
  void fly(const PlannerInput& in, PlannerOutput& out);
  void look(const PlannerInput& in, PlannerOutput& out);
  void rest(Tick until, PlannerOutput& out);
  bool marked(const KiosStop& stop) const;
  KiosTalk::Word own_word(const PlannerInput& in) const;

  const Config config_;
  const AgentConfig agent_;
  const CameraReach reach_;
  KiosTalk talk_;
  KiosPatience patience_;
  KiosStops stops_;
  WorldVoxels voxels_;
  KiosMapping mapping_;

  Phase phase_ = Phase::map;
  Tick not_before_ = 0;                                ///< of what comes next in this phase
  std::int64_t id_ = 0;                                ///< of the last goal
  std::optional<VoxelGrid> grid_;                      ///< once the boxes have come
  Tick mapped_at_ = std::numeric_limits<Tick>::max();  ///< even if its program was away: the others have the map
  std::vector<Candidate> candidates_;                  ///< what it likes best first
  std::optional<KiosStop> stop_;                       ///< that it flies to, or looks from
  std::vector<Waypoint> way_;                          ///< to it
  std::optional<Tick> looking_since_;                  ///< steady, aimed
  int more_lanes_ = 0;                                 ///< times that it has flown some more
};

PlannerOutput KiosPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  if (!in.boxes.empty() && !grid_) survey_site(in);
  if (!grid_) return out;
  talk_.listen(in, *grid_);
  look_at_map(in);
  if (in.flight.working) {
    carry_on(in, out);
  } else if (phase_ == Phase::look) {
    rest(in.tick, out);  // away from its waypoint
  }
  talk_.speak(in, *grid_, own_word(in), out);
  return out;
}

KiosStops::Config KiosPlanner::stops_config() const {
  KiosStops::Config config;
  config.sharp_m = reach_.sharp_distance_m;
  config.standoff_ratio = config_.standoff_ratio;
  config.nearest_ratio = config_.nearest_ratio;
  config.min_hits = config_.min_hits;
  config.speed_mps = config_.flight.approach_mps;
  config.stop_s = config_.stop_s;
  config.max_tasks = static_cast<std::size_t>(config_.max_tasks);
  config.effort = static_cast<std::size_t>(config_.effort);
  return config;
}

/// The operational volume and all that follows from the boxes.
void KiosPlanner::survey_site(const PlannerInput& in) {
  std::vector<Vector3d> starts;
  for (const FleetMember& member : agent_.fleet) starts.push_back(member.p_WB_start);
  const double by_camera = std::clamp(kAutoVoxelRatio * reach_.sharp_distance_m, kSmallestVoxelM, kLargestVoxelM);
  const double voxel = config_.voxel_m > 0.0 ? config_.voxel_m : by_camera;
  // One cube of free space around everything, to look at the outermost faces from.
  grid_.emplace(operational_volume(in.boxes, starts, voxel, 0.0, voxel));
  const bool came_back = seconds(in.tick) > kBoxesComeS;
  if (came_back) patience_.came_back();
  patience_.begin(in.tick);
  if (!agent_.first_explorer()) return fill_boxes(in.boxes, *grid_);
  lay_lanes(in, config_.lanes);
  if (!came_back || *config_.maps_anew) return;
  const auto& left_W = mapping_.left_W();
  const double lanes_m = path_length(in.tracking.setpoint.p_WB, {left_W.begin(), left_W.end()});
  mapped_at_ = ticks(kLiftOffS + lanes_m / config_.map_mps);
}

void KiosPlanner::lay_lanes(const PlannerInput& in, int count) {
  mapping_.begin(mapping_lanes(agent_, *grid_, in.boxes, kLaneHeight * top_of(in.boxes) + kLaneUpM, count));
}

void KiosPlanner::look_at_map(const PlannerInput& in) {
  if (agent_.due(in.k, kLookAtMapS, agent_.self)) voxels_.update(*in.world_map, *grid_);
}

void KiosPlanner::carry_on(const PlannerInput& in, PlannerOutput& out) {
  switch (phase_) {
    case Phase::map:
      return map(in, out);
    case Phase::wait:
      return wait(in, out);
    case Phase::decide:
      if (in.tick >= not_before_) decide(in, out);
      return;
    case Phase::fly:
      return fly(in, out);
    case Phase::look:
      return look(in, out);
  }
}

void KiosPlanner::rest(Tick until, PlannerOutput& out) {
  phase_ = Phase::decide;
  not_before_ = until;
  candidates_.clear();
  stop_.reset();
  way_.clear();
  out.goals.emplace();
}

/// After the last lane, or without any, to work.
void KiosPlanner::map(const PlannerInput& in, PlannerOutput& out) {
  mapping_.step(in, id_, out);
  if (!mapping_.done()) return;
  patience_.begin(in.tick);
  phase_ = agent_.me().role == Role::explorer ? Phase::decide : Phase::wait;
  not_before_ = in.tick;
}

/// For the explorers' map, where it is.
void KiosPlanner::wait(const PlannerInput& in, PlannerOutput& out) {
  if (patience_.is_over(in, config_)) return rest(in.tick, out);
  out.waits_for = agent_.first_explorer();
  if (in.tick < not_before_) return;
  not_before_ = in.tick + ticks(kStayS);
  out.goals = {{.id = ++id_, .way = {{in.tracking.setpoint.p_WB, config_.flight.approach_mps}}}};
}

std::vector<KiosAgent> KiosPlanner::fleet_in_sight(const PlannerInput& in, bool same_role, std::size_t& self) const {
  std::vector<KiosAgent> agents;
  const auto own = [&] {
    self = agents.size();
    agents.push_back({in.tracking.setpoint.p_WB, 0.0});
  };
  bool added = false;
  for (const Peer& peer : in.peers.all()) {
    if (!added && peer.uav > agent_.self) {
      own();
      added = true;
    }
    const auto word = talk_.word(peer.uav);
    if (!peer.visible || (word && word->mapping)) continue;
    if (same_role && agent_.fleet[peer.uav].role != agent_.me().role) continue;
    KiosAgent agent{peer.p_W, 0.0};
    if (word && word->stop != KiosTalk::kNoStop && seconds(in.tick - word->heard) < config_.claim_s) {
      agent.busy_s = (word->goal_W - peer.p_W).norm() / config_.flight.approach_mps + config_.stop_s;
      agent.p_WB = word->goal_W;
    }
    agents.push_back(agent);
  }
  if (!added) own();
  return agents;
}

/// Shares out what is left among those in sight, and sets out for the first of its own that can be reached.
void KiosPlanner::decide(const PlannerInput& in, PlannerOutput& out) {
  auto [open, out_of_reach] = stops_.open_stops(*grid_, voxels_, *in.space, in.boxes, in.tick);
  const std::set<std::uint32_t> taken = talk_.taken(in.tick);
  std::erase_if(open, [&](const KiosStop& stop) { return taken.contains(stop.id); });
  const bool sees = agent_.me().role == Role::explorer;
  const bool unproved_left =
      sees ? std::ranges::any_of(open, [](const KiosStop& stop) { return !stop.proved; }) : out_of_reach > 0;
  if (sees && unproved_left) std::erase_if(open, [](const KiosStop& stop) { return stop.proved; });
  std::size_t self = 0;
  const std::vector<KiosAgent> agents = fleet_in_sight(in, unproved_left, self);
  const std::vector<std::size_t> tour = stops_.own_tour(open, agents, self, *grid_);
  std::vector<KiosStop> first;
  for (std::size_t i = 0; i < std::min(tour.size(), kCandidates); ++i) first.push_back(open[tour[i]]);
  if (first.empty()) return nothing_to_reach(in, out_of_reach > 0, out);
  propose(first, in, out);
}

void KiosPlanner::nothing_to_reach(const PlannerInput& in, bool stops_left, PlannerOutput& out) {
  rest(in.tick + ticks(kRestS), out);
  if (!stops_left) fly_more_lanes(in);
}

/// An explorer for which nobody has found anything to look at: its lanes were too far from what there is.
void KiosPlanner::fly_more_lanes(const PlannerInput& in) {
  if (agent_.me().role != Role::explorer || more_lanes_ >= kMostMoreLanes) return;
  lay_lanes(in, config_.lanes + 2 * ++more_lanes_);
  phase_ = Phase::map;
}

/// The first of them to which there is a way through the graph; where cubes are too coarse to find any, the flight
/// core looks for one.
void KiosPlanner::propose(const std::vector<KiosStop>& stops, const PlannerInput& in, PlannerOutput& out) {
  const std::set<Id> claimed = talk_.claimed(in.tick);
  candidates_.clear();
  for (const KiosStop& stop : stops) candidates_.push_back({++id_, stop});
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const KiosStop& stop = candidates_[i].stop;
    auto corners = find_voxel_route(*grid_, *in.space, in.tracking.setpoint.p_WB, stop.p_WB, claimed);
    if (!corners) continue;
    candidates_[i].corners = std::move(*corners);
    std::rotate(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(i),
                candidates_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    break;
  }
  std::vector<Goal>& goals = out.goals.emplace();
  for (const Candidate& candidate : candidates_) goals.push_back(goal_of(candidate, in));
  if (goals.front().yaw) out.yaw = goals.front().yaw;
  stop_ = candidates_.front().stop;
  way_ = goals.front().way;
  phase_ = Phase::fly;
}

Goal KiosPlanner::goal_of(const Candidate& candidate, const PlannerInput& in) const {
  const double speed_mps = config_.flight.approach_mps;
  Goal goal{.id = candidate.goal, .gimbal = candidate.stop.surface_W};
  goal.yaw = yaw_facing(candidate.stop.out_W);
  if (candidate.corners.size() < 2) {
    goal.way = {{candidate.stop.p_WB, speed_mps}};
    return goal;
  }
  // From where it is, so that it does not stop at the first corner.
  if (in.state.v_WB.norm() < kStandsMps) goal.way.push_back({in.tracking.setpoint.p_WB, speed_mps});
  for (const Vector3d& corner_W : candidate.corners) goal.way.push_back({corner_W, speed_mps});
  if (agent_.me().role == Role::explorer) goal.yaw.reset();  // its LiDAR proves most ahead
  return goal;
}

/// Until one of its waypoints is reached, none can be, or somebody else was there.
void KiosPlanner::fly(const PlannerInput& in, PlannerOutput& out) {
  for (const Outcome& outcome : in.flight.outcomes) {
    const auto found =
        std::ranges::find_if(candidates_, [&](const Candidate& candidate) { return candidate.goal == outcome.id; });
    if (found == candidates_.end()) continue;
    const KiosStop stop = found->stop;
    if (outcome.kind == Outcome::Kind::reached) {
      stop_ = stop;
      phase_ = Phase::look;
      not_before_ = in.tick + ticks(kAimPatienceS);
      looking_since_.reset();
      out.goals.emplace();  // not on to the next one
      return look(in, out);
    }
    stops_.failed(stop.id, in.tick);
    candidates_.erase(found);
    if (outcome.kind == Outcome::Kind::blocked) return rest(in.tick, out);
  }
  if (candidates_.empty()) return rest(in.tick + ticks(kRestS), out);
  if (!in.flight.goal) return;
  const auto current =
      std::ranges::find_if(candidates_, [&](const Candidate& candidate) { return candidate.goal == *in.flight.goal; });
  if (current == candidates_.end()) return;
  if (current->stop.id != stop_->id) {
    stop_ = current->stop;
    way_ = {{stop_->p_WB, config_.flight.approach_mps}};
  }
  if (marked(*stop_)) decide(in, out);
}

bool KiosPlanner::marked(const KiosStop& stop) const { return grid_->marked(stop.cube(), stop.face()); }

/// At a waypoint: once it is steady and aimed, for as long as pictures take; then the face is done.
void KiosPlanner::look(const PlannerInput& in, PlannerOutput& out) {
  const bool steady = in.state.v_WB.norm() < config_.settle_mps;
  const bool aimed = aim_error(stop_->surface_W, in.state, in.gimbal, agent_.vehicle) < config_.aim_deg * kRadPerDeg;
  if (!steady || !aimed) looking_since_.reset();
  if (steady && aimed && !looking_since_) looking_since_ = in.tick;
  const bool looked = looking_since_ && seconds(in.tick - *looking_since_) >= config_.dwell_s;
  if (!looked && in.tick < not_before_) {
    if (const auto yaw = yaw_facing(stop_->out_W)) out.yaw = yaw;
    out.gimbal = stop_->surface_W;
    return;
  }
  grid_->mark(stop_->cube(), stop_->face());
  stop_.reset();
  decide(in, out);
}

/// Claims the cube that it is in and the next ones on its way.
KiosTalk::Word KiosPlanner::own_word(const PlannerInput& in) const {
  KiosTalk::Word word;
  const bool maps = phase_ == Phase::map || !mapping_.done();
  word.mapping = maps && in.tick < mapped_at_;
  const Vector3d here = in.tracking.setpoint.p_WB;
  const bool flies = stop_ && in.flight.working;
  if (flies) {
    word.stop = stop_->id;
    word.goal_W = stop_->p_WB;
  }
  const bool on_way = flies && phase_ == Phase::fly && in.flight.leg < way_.size();
  grid_->along(here, on_way ? way_[in.flight.leg].p_WB : here, [&](Id id) {
    word.claims.push_back(id);
    return word.claims.size() <= static_cast<std::size_t>(config_.reserve);
  });
  return word;
}

SKEIN_REGISTER_PLANNER("kios", KiosPlanner);

}  // namespace skein::agent
