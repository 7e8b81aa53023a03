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
// (lanes.hpp), the messages (talk.hpp), starts, safety and the way home at the end (sortie.hpp), and that
// waypoints around the boxes do where nobody has a LiDAR.
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/euler.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/proof.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/flight/sortie.hpp"
#include "uav_agent/flight/voxel_route.hpp"
#include "uav_agent/planners/kios/config.hpp"
#include "uav_agent/planners/kios/lanes.hpp"
#include "uav_agent/planners/kios/patience.hpp"
#include "uav_agent/planners/kios/stops.hpp"
#include "uav_agent/planners/kios/talk.hpp"
#include "uav_agent/planning/aiming.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {
namespace {

constexpr double kAutoVoxelRatio = 0.9, kSmallestVoxelM = 2.5, kLargestVoxelM = 6.0;  ///< of d*
constexpr double kLookAtMapS = 1.0;    ///< between two looks at what the LiDARs saw
constexpr double kRestS = 1.0;         ///< when there is nothing to do
constexpr double kAimPatienceS = 4.0;  ///< at a waypoint; some directions are out of the gimbal's reach
constexpr int kMaxLaneFailures = 4;
constexpr std::size_t kCandidates = 5;  ///< stops tried in one decision
constexpr int kFruitlessToBold = 2, kFruitlessToRetreat = 9;
constexpr double kBoldS = 40.0;                        ///< for so long it does with less proof of free space
constexpr double kLookAroundTurn = 0.8;                ///< in vain: a LiDAR that has turned makes a new key frame [rad]
constexpr int kMostMoreLanes = 3;                      ///< times, for explorers that have found nothing
constexpr double kBoxesComeS = 5.0, kLiftOffS = 20.0;  ///< to, and of, whoever is there from the beginning

}  // namespace

class KiosPlanner final : public Planner {
 public:
  using Config = KiosConfig;

  KiosPlanner(const Config& config, const AgentConfig& agent)
      : config_(config),
        agent_(agent),
        reach_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel)),
        sortie_({config.climb_mps, config.transit_mps, config.transit_mps, config.clearance_m, config.deliver_every_s,
                 config.return_margin_s},
                agent_),
        talk_({.share_s = config.share_s, .claim_s = config.claim_s}, agent_),
        patience_(agent_, talk_),
        stops_(stops_config()),
        mapper_({.min_hits = config.min_hits}) {}

  PlannerOutput plan(const PlannerInput& in) override;

 private:
  enum class Phase { map, wait, decide, fly, look };
  using Id = VoxelGrid::Id;

  KiosStops::Config stops_config() const;
  double clearance_m() const { return centre_clearance_m(agent_, config_.clearance_m); }
  FreeSpace::Config space_config() const;
  FreeSpace free_space(const PlannerInput& in) const { return {space_config(), in.boxes, in.map}; }

  void survey_site(const PlannerInput& in);
  void look_at_map(const PlannerInput& in);
  void blocked(const PlannerInput& in, PlannerOutput& out);
  void carry_on(const PlannerInput& in, PlannerOutput& out);
  void lay_lanes(const PlannerInput& in, int count);
  void next_lane(const PlannerInput& in, PlannerOutput& out);
  void lane_failed();
  void decide(const PlannerInput& in, PlannerOutput& out);
  void nothing_to_reach(const PlannerInput& in, bool stops_left, PlannerOutput& out);
  void fly_more_lanes(const PlannerInput& in, PlannerOutput& out);
  std::vector<KiosAgent> fleet_in_sight(const PlannerInput& in, std::size_t& self) const;
  bool fly_to(const KiosStop& stop, const FreeSpace& space, bool finely, const PlannerInput& in, PlannerOutput& out);
  void look(const PlannerInput& in);
  void rest(Tick until, PlannerOutput& out);
  KiosTalk::Word own_word(const PlannerInput& in) const;

  const Config config_;
  const AgentConfig agent_;
  const CameraReach reach_;
  Sortie sortie_;
  KiosTalk talk_;
  KiosPatience patience_;
  KiosStops stops_;
  VoxelMapper mapper_;

  Phase phase_ = Phase::map;
  Tick not_before_ = 0;               ///< of what comes next in this phase
  int failures_ = 0;                  ///< of this lane
  std::optional<VoxelGrid> grid_;     ///< once the boxes have come
  std::optional<VoxelGrid> hearsay_;  ///< of it, what this UAV did not see itself
  Site site_;
  std::deque<Vector3d> lanes_;                         ///< corners left
  Tick mapped_at_ = std::numeric_limits<Tick>::max();  ///< even if its program was away: the others have the map
  std::optional<KiosStop> stop_;
  std::vector<Vector3d> way_;          ///< to it
  std::optional<Tick> looking_since_;  ///< steady, aimed
  int fruitless_ = 0;                  ///< decisions in a row
  Proof proof_;                        ///< of free space
  int more_lanes_ = 0;                 ///< times that it has flown some more
};

PlannerOutput KiosPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  if (!in.boxes.empty() && !grid_) survey_site(in);
  if (grid_) {
    talk_.listen(in, *grid_);
    look_at_map(in);
  }
  switch (sortie_.step(in, space_config(), out)) {
    case Sortie::Turn::begin:
      next_lane(in, out);
      break;
    case Sortie::Turn::work:
      carry_on(in, out);
      break;
    case Sortie::Turn::blocked:
      blocked(in, out);
      break;
    case Sortie::Turn::leave:
      stop_.reset();
      break;
    case Sortie::Turn::nothing:
    case Sortie::Turn::detour:
      break;
  }
  if (grid_) talk_.speak(in, *grid_, own_word(in), out);
  return out;
}

KiosStops::Config KiosPlanner::stops_config() const {
  KiosStops::Config config;
  config.sharp_m = reach_.sharp_distance_m;
  config.standoff_ratio = config_.standoff_ratio;
  config.nearest_ratio = config_.nearest_ratio;
  config.clearance_m = clearance_m();
  config.speed_mps = config_.transit_mps;
  config.stop_s = config_.stop_s;
  config.max_tasks = static_cast<std::size_t>(config_.max_tasks);
  config.effort = static_cast<std::size_t>(config_.effort);
  return config;
}

FreeSpace::Config KiosPlanner::space_config() const {
  FreeSpace::Config config;
  config.clearance_m = clearance_m();
  config.jut_m = config_.jut_m;
  config.rays = proof_.of(Proof::rays(site_.roomy), agent_.me().role);
  config.blind_height_m = site_.blind_height_m;
  config.floor_m = std::max(config.floor_m, site_.lowest_m);
  config.hearsay = hearsay_ ? &*hearsay_ : nullptr;
  return config;
}

/// The operational volume and all that follows from the boxes.
void KiosPlanner::survey_site(const PlannerInput& in) {
  site_ = site_of(agent_, in.boxes, config_.blind_height_ratio);
  sortie_.know_site(site_.top_m, site_.blind_height_m);
  std::vector<Vector3d> starts;
  for (const FleetMember& member : agent_.fleet) starts.push_back(member.p_WB_start);
  const double by_camera = std::clamp(kAutoVoxelRatio * reach_.sharp_distance_m, kSmallestVoxelM, kLargestVoxelM);
  const double voxel = config_.voxel_m > 0.0 ? config_.voxel_m : by_camera;
  // One cube of free space around everything, to look at the outermost faces from.
  grid_.emplace(operational_volume(in.boxes, starts, voxel, 0.0, voxel));
  const bool came_back = seconds(in.tick) > kBoxesComeS;
  if (came_back) patience_.came_back();
  if (site_.blind_fleet) return fill_boxes(in.boxes, *grid_);
  lay_lanes(in, config_.lanes);
  if (!came_back || config_.faithful) return;
  const double lanes_m = path_length(in.tracking.setpoint.p_WB, {lanes_.begin(), lanes_.end()});
  mapped_at_ = ticks(kLiftOffS + lanes_m / config_.map_mps);
}

void KiosPlanner::lay_lanes(const PlannerInput& in, int count) {
  const auto corners = mapping_lanes(agent_, *grid_, in.boxes, site_.blind_height_m + 2.0, count);
  lanes_.assign(corners.begin(), corners.end());
}

void KiosPlanner::look_at_map(const PlannerInput& in) {
  if (!agent_.due(in.k, kLookAtMapS, agent_.self)) return;
  mapper_.update(in.map, *grid_);
  hearsay_ = mapper_.hearsay(*grid_);
}

/// Something came between this UAV and what it was about.
void KiosPlanner::blocked(const PlannerInput& in, PlannerOutput& out) {
  if (phase_ == Phase::map) {
    lane_failed();
    not_before_ = in.tick + ticks(kRestS);
    return;
  }
  if (stop_) stops_.failed(stop_->id, in.tick);
  rest(in.tick, out);
}

void KiosPlanner::carry_on(const PlannerInput& in, PlannerOutput& out) {
  switch (phase_) {
    case Phase::map:
      if (sortie_.pilot().arrived(in) && !lanes_.empty()) lanes_.pop_front();
      if (in.tracking.done && in.tick >= not_before_) next_lane(in, out);
      return;
    case Phase::wait:
      if (patience_.is_over(in, *grid_, config_)) return rest(in.tick, out);
      return sortie_.waits_for(*agent_.first_explorer(), in, out);
    case Phase::decide:
      if (in.tick >= not_before_ && in.tracking.done) decide(in, out);
      return;
    case Phase::fly:
      if (grid_->marked(stop_->id / VoxelGrid::kFaces, static_cast<int>(stop_->id % VoxelGrid::kFaces))) {
        rest(in.tick, out);  // somebody else was there
      } else if (in.tracking.done) {
        phase_ = Phase::look;
        not_before_ = in.tick + ticks(kAimPatienceS);
        looking_since_.reset();
      }
      return;
    case Phase::look:
      look(in);
      if (!stop_) decide(in, out);
      return;
  }
}

void KiosPlanner::rest(Tick until, PlannerOutput& out) {
  phase_ = Phase::decide;
  not_before_ = until;
  stop_.reset();
  sortie_.pilot().stop(out);
}

/// On to the next corner of a lane; one that cannot be reached is given up after some tries. After the last one, or
/// without any, to work.
void KiosPlanner::next_lane(const PlannerInput& in, PlannerOutput& out) {
  phase_ = Phase::map;
  if (!lanes_.empty()) {
    const FreeSpace space = free_space(in);
    const auto corners = find_path(space, in.boxes, in.tracking.setpoint.p_WB, lanes_.front());
    if (corners) {
      sortie_.pilot().follow(path_through(*corners, config_.map_mps), in, out);
      proof_.ask_all();
      return;
    }
    sortie_.pilot().no_way(lanes_.front(), space, out);
    not_before_ = in.tick + ticks(kRestS);
    proof_.ask_less();
    out.yaw = wrap_angle(in.tracking.setpoint.yaw + kLookAroundTurn);
    lane_failed();
    return;
  }
  patience_.begin(in.tick);
  proof_.ask_all();
  phase_ = agent_.me().role == Role::explorer ? Phase::decide : Phase::wait;
  not_before_ = in.tick;
}

void KiosPlanner::lane_failed() {
  if (++failures_ <= kMaxLaneFailures || lanes_.empty()) return;
  failures_ = 0;
  lanes_.pop_front();
}

std::vector<KiosAgent> KiosPlanner::fleet_in_sight(const PlannerInput& in, std::size_t& self) const {
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
    KiosAgent agent{peer.p_W, 0.0};
    if (word && word->stop != KiosTalk::kNoStop && seconds(in.tick - word->heard) < config_.claim_s) {
      agent.busy_s = (word->goal_W - peer.p_W).norm() / config_.transit_mps + config_.stop_s;
      agent.p_WB = word->goal_W;
    }
    agents.push_back(agent);
  }
  if (!added) own();
  return agents;
}

/// Shares out what is left among those in sight, and sets out for the first of its own that can be reached.
void KiosPlanner::decide(const PlannerInput& in, PlannerOutput& out) {
  proof_.settle(in.tick);
  const FreeSpace space = free_space(in);
  auto [open, out_of_reach] = stops_.open_stops(*grid_, mapper_, space, in.boxes, in.tick);
  const std::set<std::uint32_t> taken = talk_.taken(in.tick);
  std::erase_if(open, [&](const KiosStop& stop) { return taken.contains(stop.id); });
  std::size_t self = 0;
  const std::vector<KiosAgent> agents = fleet_in_sight(in, self);
  std::vector<std::size_t> tour = stops_.own_tour(open, agents, self);
  tour.resize(std::min<std::size_t>(tour.size(), kCandidates));
  const auto set_out = [&](std::size_t i, bool finely) { return fly_to(open[i], space, finely, in, out); };
  const bool found = std::ranges::any_of(tour, [&](std::size_t i) { return set_out(i, false); }) ||
                     (!tour.empty() && set_out(tour.front(), true));
  if (found) {
    fruitless_ = 0;
    return;
  }
  for (const std::size_t i : tour) stops_.failed(open[i].id, in.tick);
  nothing_to_reach(in, !tour.empty() || out_of_reach > 0, out);
}

void KiosPlanner::nothing_to_reach(const PlannerInput& in, bool stops_left, PlannerOutput& out) {
  rest(in.tick + ticks(kRestS), out);
  if (!stops_left) return fly_more_lanes(in, out);
  ++fruitless_;
  out.yaw = wrap_angle(in.tracking.setpoint.yaw + kLookAroundTurn);
  if (fruitless_ % kFruitlessToBold == 0) proof_.ask_less(in.tick + ticks(kBoldS));
  if (fruitless_ % kFruitlessToRetreat == 0) sortie_.pilot().retreat(in, out);
}

/// An explorer for which nobody has found anything to look at: its lanes were too far from what there is.
void KiosPlanner::fly_more_lanes(const PlannerInput& in, PlannerOutput& out) {
  if (agent_.me().role != Role::explorer || more_lanes_ >= kMostMoreLanes) return;
  lay_lanes(in, config_.lanes + 2 * ++more_lanes_);
  next_lane(in, out);
}

/// Through the graph; or, where cubes are too coarse to find a way, on the finer map.
bool KiosPlanner::fly_to(const KiosStop& stop, const FreeSpace& space, bool finely, const PlannerInput& in,
                         PlannerOutput& out) {
  const Vector3d here = in.tracking.setpoint.p_WB;
  const auto corners = finely ? find_path(space, in.boxes, here, stop.p_WB)
                              : find_voxel_route(*grid_, space, here, stop.p_WB, talk_.claimed(in.tick));
  if (!corners) {
    sortie_.pilot().no_way(stop.p_WB, space, out);
    return false;
  }
  sortie_.pilot().follow(path_through(*corners, config_.transit_mps), in, out);
  phase_ = Phase::fly;
  stop_ = stop;
  way_ = *corners;
  if (std::abs(stop.out_W.z()) < 0.5) out.yaw = std::atan2(-stop.out_W.y(), -stop.out_W.x());
  out.gimbal = stop.surface_W;
  return true;
}

/// At a waypoint: once it is steady and aimed, for as long as pictures take; then the face is done.
void KiosPlanner::look(const PlannerInput& in) {
  const bool steady = in.state.v_WB.norm() < config_.settle_mps;
  const bool aimed = aim_error(stop_->surface_W, in.state, in.gimbal, agent_.vehicle) < config_.aim_deg * kRadPerDeg;
  if (!steady || !aimed) looking_since_.reset();
  if (steady && aimed && !looking_since_) looking_since_ = in.tick;
  const bool looked = looking_since_ && seconds(in.tick - *looking_since_) >= config_.dwell_s;
  if (!looked && in.tick < not_before_) return;
  grid_->mark(stop_->id / VoxelGrid::kFaces, static_cast<int>(stop_->id % VoxelGrid::kFaces));
  stop_.reset();
}

/// Claims the cube that it is in and the next ones on its way.
KiosTalk::Word KiosPlanner::own_word(const PlannerInput& in) const {
  KiosTalk::Word word;
  const bool maps = phase_ == Phase::map || (agent_.me().role == Role::explorer && !lanes_.empty());
  word.mapping = maps && in.tick < mapped_at_;
  const Vector3d here = in.tracking.setpoint.p_WB;
  if (stop_) {
    word.stop = stop_->id;
    word.goal_W = stop_->p_WB;
  }
  const bool on_way = phase_ == Phase::fly && in.tracking.leg < way_.size();
  grid_->along(here, on_way ? way_[in.tracking.leg] : here, [&](Id id) {
    word.claims.push_back(id);
    return word.claims.size() <= static_cast<std::size_t>(config_.reserve);
  });
  return word;
}

SKEIN_REGISTER_PLANNER("kios", KiosPlanner);

}  // namespace skein::agent
