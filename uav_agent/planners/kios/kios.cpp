// KIOS: the strategy of the team that won the first contest, rebuilt from its published description.
//
// 1. The operational volume is the smallest cuboid that holds all boxes and all starts; it is cut into cubes, which are
//    the nodes of a graph. 2. Mapping: explorers fly straight along its longest axis; photographers wait in the air.
// 3. Inspection: each exposed face of an occupied cube has one waypoint, and the UAVs divide the waypoints: each UAV
//    solves a multiple travelling salesmen problem for all UAVs in line of sight, and flies the first leg of its own
//    tour. At the waypoint it stops, turns the camera to the surface, photographs, and solves again. UAVs in line of
//    sight of each other continually exchange maps and photographed faces. No two UAVs enter one cube.
//
// Its weaknesses are the published ones: photographers idle while the explorers map; one quick pass on coarse cubes
// misses thin members; a UAV without another one in line of sight plans for itself alone and repeats others' work.
// Not published, and so our choice: every number below, where in a free cube a UAV stops (stops.hpp), the lanes
// (lanes.hpp), the messages (talk.hpp), and that a fleet without LiDAR takes the boxes for solid. The flight core does
// the flying (flight_core/flight_core.hpp).
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/euler.hpp"
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

constexpr double kAutoVoxelRatio = 0.9;                        ///< edge of a cube by the camera, in units of d*; chosen
constexpr double kSmallestVoxelM = 2.5, kLargestVoxelM = 6.0;  ///< limits of this edge; chosen
/// Lanes lie at least kLaneUpM above this share of the site's height. Chosen.
constexpr double kLaneHeight = 0.25, kLaneUpM = 2.0;
constexpr double kRestS = 1.0;          ///< wait when no stop can be reached; chosen
constexpr double kStayS = 2.0;          ///< interval at which a waiting UAV renews its goal, its own place; chosen
constexpr double kAimPatienceS = 3.0;   ///< longest stay at a stop: the gimbal cannot reach some directions; chosen
constexpr std::size_t kCandidates = 5;  ///< most stops proposed to the flight core at once; chosen
constexpr int kMostMoreLanes = 3;       ///< how often an explorer without stops may fly more lanes; chosen
constexpr double kStandsMps = 1.0;      ///< the way of a UAV slower than this begins where it is; chosen
constexpr double kBoxesComeS = 5.0;     ///< boxes come by then, unless the program was restarted; chosen
constexpr double kLiftOffS = 20.0;      ///< assumed time to take off; chosen

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
  /// A stop that is proposed to the flight core.
  struct Candidate {
    std::int64_t goal = 0;
    KiosStop stop;
    std::vector<Vector3d> corners = {};  ///< of the path to it; empty: the flight core searches a path
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
  Tick not_before_ = 0;                                ///< of the next action in this phase
  std::int64_t id_ = 0;                                ///< id of the last goal
  std::optional<VoxelGrid> grid_;                      ///< set when the boxes have arrived
  Tick mapped_at_ = std::numeric_limits<Tick>::max();  ///< after a restart: when it stops reporting `mapping`
  std::vector<Candidate> candidates_;                  ///< best first
  std::optional<KiosStop> stop_;                       ///< the stop that it flies to or photographs from
  std::vector<Waypoint> way_;                          ///< to this stop
  std::optional<Tick> looking_since_;                  ///< since when the UAV is steady and its camera aimed
  int more_lanes_ = 0;                                 ///< how often this explorer has flown more lanes
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
    rest(in.tick, out);  // the flight core has taken the UAV away from its stop
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

/// Sets up the operational volume and everything else that depends on the boxes.
void KiosPlanner::survey_site(const PlannerInput& in) {
  std::vector<Vector3d> starts;
  for (const FleetMember& member : agent_.fleet) starts.push_back(member.p_WB_start);
  const double by_camera = std::clamp(kAutoVoxelRatio * reach_.sharp_distance_m, kSmallestVoxelM, kLargestVoxelM);
  const double asked = config_.voxel_m > 0.0 ? config_.voxel_m : by_camera;
  // One more cube of free space on all sides, for the stops in front of the outermost faces.
  const auto size_of = [&](double edge) { return operational_size(in.boxes, starts, edge, 0.0, edge); };
  const double voxel = fitting_voxel_m(asked, size_of);
  if (voxel > asked) spdlog::warn("kios: {}", coarse_voxels_text(asked, voxel, size_of(asked)));
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
  const PartTimer timer(in.parts, "planner/map");
  if (agent_.due(in.k, WorldVoxels::kUpdateS, agent_.self)) voxels_.update(*in.world_map, *grid_);
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

/// Flies the lanes. After the last one, or without lanes, an explorer begins its inspection; a photographer waits.
void KiosPlanner::map(const PlannerInput& in, PlannerOutput& out) {
  mapping_.step(in, id_, out);
  if (!mapping_.done()) return;
  patience_.begin(in.tick);
  phase_ = agent_.me().role == Role::explorer ? Phase::decide : Phase::wait;
  not_before_ = in.tick;
}

/// Waits for the explorers' map, in the place where the UAV is.
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

/// Divides the open stops among the UAVs in line of sight, and proposes the first ones of its own tour.
void KiosPlanner::decide(const PlannerInput& in, PlannerOutput& out) {
  auto [open, out_of_reach] = timed(in.parts, "planner/stops",
                                    [&] { return stops_.open_stops(*grid_, voxels_, *in.space, in.boxes, in.tick); });
  const std::set<std::uint32_t> taken = talk_.taken(in.tick);
  std::erase_if(open, [&](const KiosStop& stop) { return taken.contains(stop.id); });
  const bool sees = agent_.me().role == Role::explorer;
  const bool unproved_left =
      sees ? std::ranges::any_of(open, [](const KiosStop& stop) { return !stop.proved; }) : out_of_reach > 0;
  if (sees && unproved_left) std::erase_if(open, [](const KiosStop& stop) { return stop.proved; });
  std::size_t self = 0;
  const std::vector<KiosAgent> agents = fleet_in_sight(in, unproved_left, self);
  const std::vector<std::size_t> tour =
      timed(in.parts, "planner/tours", [&, &open = open] { return stops_.own_tour(open, agents, self, *grid_); });
  std::vector<KiosStop> first;
  for (std::size_t i = 0; i < std::min(tour.size(), kCandidates); ++i) first.push_back(open[tour[i]]);
  if (first.empty()) return nothing_to_reach(in, out_of_reach > 0, out);
  propose(first, in, out);
}

void KiosPlanner::nothing_to_reach(const PlannerInput& in, bool stops_left, PlannerOutput& out) {
  rest(in.tick + ticks(kRestS), out);
  if (!stops_left) fly_more_lanes(in);
}

/// For an explorer without any open stop: its lanes may have been too far from the structure.
void KiosPlanner::fly_more_lanes(const PlannerInput& in) {
  if (agent_.me().role != Role::explorer || more_lanes_ >= kMostMoreLanes) return;
  lay_lanes(in, config_.lanes + 2 * ++more_lanes_);
  phase_ = Phase::map;
}

/// Proposes the stops to the flight core, beginning with the first one to which the graph has a path. For the others,
/// and where the cubes are too coarse for any path, the flight core searches.
void KiosPlanner::propose(const std::vector<KiosStop>& stops, const PlannerInput& in, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/ways");
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
  // The way begins where the UAV is, so that the UAV does not stop at the first corner.
  if (in.state.v_WB.norm() < kStandsMps) goal.way.push_back({in.tracking.setpoint.p_WB, speed_mps});
  for (const Vector3d& corner_W : candidate.corners) goal.way.push_back({corner_W, speed_mps});
  if (agent_.me().role == Role::explorer) goal.yaw.reset();  // it faces ahead, where its LiDAR proves most space
  return goal;
}

/// Flies until one of the stops is reached, none can be, or another UAV has photographed the face.
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
      out.goals.emplace();  // so that the core does not go on to the next stop
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

/// At a stop: marks the face when the UAV was steady and its camera aimed for dwell_s, or when patience is at its end.
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

/// Claims the cube that the UAV is in and the next ones on its way.
KiosTalk::Word KiosPlanner::own_word(const PlannerInput& in) const {
  const PartTimer timer(in.parts, "planner/claims");
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
