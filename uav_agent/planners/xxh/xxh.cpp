// XXH: the strategy of the second team of the first contest, rebuilt from its published description.
//
// 1. The ground station (ground.cpp) forms a team around each explorer and gives it boxes, in the order of a best-
// first path (plan.hpp). 2. Region by region, the explorer flies a spiral around the box, layer by layer, and maps
// it in cells (region.hpp); its photographers wait at the region's entry. 3. The layers are shared out: as soon as
// a section is explored, the explorer orders its photographer to begin; the last one it inspects itself
// (inspect.hpp). 4. When all are done, the team goes on to the next region. Trajectories and maps are shared
// (talk.hpp); who has less priority, by role and name, keeps clear of what others are about to fly.
//
// Its weaknesses are the published ones: the exploration is slow, and photographers are idle meanwhile; a share by
// volume says little about the work; nobody helps another team. What the sources leave open and we had to invent: the
// numbers that config.hpp does not give a source for, that an assignment that never comes is made by the UAV
// itself, that silent leaders and followers are not waited for, that every way is checked against the finer map
// (free_space.hpp), that upright regions begin at the top (what is low may only be entered once it was seen), that the
// leader's part of the layers is smaller (it begins last), starts and safety (pilot.hpp), the way home (delivery.hpp).
// `faithful` brings back defects of the public code: only the first turn of the spiral in each section, what others
// said they would fly is kept clear of for ever, searches of 1,000 cells, waiting without end. Not modelled: its
// commands at the edge of the controller's time-out (here they go out once an exchange), and the name that its code
// does not know.
#include <algorithm>
#include <cmath>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/sortie.hpp"
#include "uav_agent/planners/xxh/crew.hpp"
#include "uav_agent/planners/xxh/explore.hpp"
#include "uav_agent/planners/xxh/inspect.hpp"
#include "uav_agent/planners/xxh/post.hpp"
#include "uav_agent/planning/strips.hpp"

namespace skein::agent {
namespace {

constexpr double kSpareM = 0.3;       ///< of stops, beside the clearance
constexpr double kLookAtMapS = 1.0;   ///< between two looks at what the LiDARs saw
constexpr double kRestS = 1.0;        ///< when there is nothing to do
constexpr double kShortRestS = 0.25;  ///< when another cell may be tried
constexpr double kLowestM = 2.5;      ///< of places on the spiral and of stops
constexpr int kTries = 3;             ///< searches for a way in one exchange
constexpr int kFruitlessToRetreat = 40;
constexpr double kHandOverS = 25.0;     ///< to find somebody who has not heard its order
constexpr double kExploreShare = 0.4;   ///< of the time left, for all sections together: others wait meanwhile
constexpr std::size_t kMostRounds = 8;  ///< through all regions: early ones may have found no way
constexpr double kFreshS = 10.0;        ///< after a start in flight: others may know how far the team is

Sortie::Config sortie_config(const XxhConfig& config) {
  return {.climb_mps = config.climb_mps,
          .transit_mps = config.transit_mps,
          .retreat_mps = config.transit_mps,
          .clearance_m = config.clearance_m,
          .deliver_every_s = config.deliver_every_s,
          .return_margin_s = config.return_margin_s};
}

}  // namespace

class XxhPlanner final : public Planner {
 public:
  using Config = XxhConfig;

  XxhPlanner(const Config& config, const AgentConfig& agent)
      : config_(config),
        agent_(agent),
        reach_(camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel)),
        sortie_(sortie_config(config), agent_),
        talk_({.share_s = config.share_s, .claim_s = config.claim_s, .forever = config.faithful}, agent_),
        crew_(config_, agent_, talk_),
        ways_(config_, agent_, talk_, sortie_.pilot()),
        explorer_(config_, ways_),
        inspector_(config_, agent_),
        post_(config_, agent_, ways_) {}

  PlannerOutput plan(const PlannerInput& in) override;

 private:
  /// explore: leads, maps. hand_over: leads, finds those who have not heard their order. wait: for that order. inspect:
  /// its section. regroup: done, waits for the team. finished: no region is left.
  enum class Stage { none, explore, hand_over, wait, inspect, regroup, finished };

  void prepare(const PlannerInput& in);
  void fly(const PlannerInput& in, PlannerOutput& out);
  void enter_region(std::size_t index, const PlannerInput& in);
  XxhRegionMap::Config map_config() const;
  void begin_section(std::size_t section, const PlannerInput& in);
  XxhRegionMap::Section section_layers(std::size_t section) const;
  void change(Stage stage, const PlannerInput& in);
  void work(const PlannerInput& in, PlannerOutput& out);
  void explore(const PlannerInput& in, PlannerOutput& out);
  void recover(const PlannerInput& in, PlannerOutput& out);
  void next_section(const PlannerInput& in);
  void hand_over(const PlannerInput& in, PlannerOutput& out);
  void wait(const PlannerInput& in, PlannerOutput& out);
  void inspect(const PlannerInput& in, PlannerOutput& out);
  void choose_cell(const PlannerInput& in, PlannerOutput& out);
  void look_at(const XxhTarget& target, PlannerOutput& out) const;
  void section_done(const PlannerInput& in);
  void regroup(const PlannerInput& in, PlannerOutput& out);
  void stay_at_post(const PlannerInput& in, PlannerOutput& out);
  void go_home(const PlannerInput& in, PlannerOutput& out);
  void assume_solid();
  bool free_for_something(const PlannerInput& in) const { return in.tracking.done && in.tick >= not_before_; }
  VoxelGrid* shared_grid() { return region_ && !solid_ ? &region_->grid() : nullptr; }
  XxhWord own_word(const PlannerInput& in) const;

  const Config config_;
  const AgentConfig agent_;
  const CameraReach reach_;
  Sortie sortie_;
  XxhTalk talk_;
  XxhCrew crew_;
  XxhWays ways_;
  XxhExplorer explorer_;
  XxhInspector inspector_;
  XxhPost post_;

  bool site_known_ = false;
  Tick assigned_at_ = 0;
  bool restarted_ = false;  ///< in flight
  Stage stage_ = Stage::none;
  Tick stage_since_ = 0, not_before_ = 0;
  std::size_t region_index_ = 0;  ///< counts on through the rounds
  std::optional<XxhRegionMap> region_;
  bool solid_ = false;  ///< goes by the box, not by a map
  Vector3d entry_W_ = Vector3d::Zero();
  Vector3d came_from_W_ = Vector3d::Zero();  ///< end of the region before
  std::size_t explored_ = 0;                 ///< sections
  bool exploring_ = false;                   ///< the next one
  std::vector<std::size_t> begun_;           ///< sections that this UAV inspects or has inspected
  bool ordered_ = false;                     ///< knows that its section is explored
};

PlannerOutput XxhPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  prepare(in);
  // On the ground until there is something to do; without boxes, there may never be.
  const bool waited = restarted_ || seconds(in.tick) > config_.assignment_wait_s;
  if (crew_.assigned() || waited) fly(in, out);
  talk_.speak(in, shared_grid(), own_word(in), out);
  return out;
}

/// What is known of the site, the team and the map.
void XxhPlanner::prepare(const PlannerInput& in) {
  if (!in.boxes.empty() && !site_known_) {
    site_known_ = true;
    ways_.know_site(in.boxes);
    sortie_.know_site(ways_.site().top_m, ways_.site().blind_height_m);
  }
  talk_.listen(in, shared_grid());
  restarted_ |= !crew_.assigned() && in.state.p_WB.z() > Sortie::kAirborneM;
  if (crew_.seek_assignment(in, restarted_)) {
    assigned_at_ = in.tick;
    came_from_W_ = agent_.fleet[crew_.leader()].p_WB_start;
    enter_region(0, in);
  }
  if (region_ && !solid_ && agent_.due(in.k, kLookAtMapS, agent_.self)) region_->update(in.map);
}

void XxhPlanner::fly(const PlannerInput& in, PlannerOutput& out) {
  ways_.believe(region_ && !solid_ ? &region_->hearsay() : nullptr);
  ways_.dare(stage_ == Stage::inspect ? inspector_.pass() : 0);
  switch (sortie_.step(in, ways_.space(), out)) {
    case Sortie::Turn::begin:
      post_.leave();
      not_before_ = in.tick;
      return;
    case Sortie::Turn::blocked:
      inspector_.give_up();
      post_.leave();
      explorer_.give_up();
      not_before_ = in.tick + ticks(kRestS);
      return;
    case Sortie::Turn::leave:
      return inspector_.give_up();
    case Sortie::Turn::work:
      return work(in, out);
    case Sortie::Turn::detour:
      return ways_.forget_corners();
    case Sortie::Turn::nothing:
      return;
  }
}

void XxhPlanner::enter_region(std::size_t index, const PlannerInput& in) {
  const std::size_t count = crew_.regions().size(), all = config_.faithful ? count : kMostRounds * count;
  region_index_ = std::min(index, all);
  talk_.new_map();
  solid_ = false;
  ordered_ = false;
  explored_ = 0;
  exploring_ = false;
  explorer_.stop();
  begun_.clear();
  region_.reset();
  ways_.believe(nullptr);
  if (region_index_ == all) return change(Stage::finished, in);
  const XxhRegion& region = crew_.regions()[region_index_ % count];
  if (region_index_ > 0) {
    const XxhRegion& last = crew_.regions()[(region_index_ - 1) % count];
    came_from_W_ = far_end(last, in.boxes[last.box]);
  }
  const OrientedBox& whole = in.boxes[region.box];
  region_.emplace(map_config(), region_box(region, whole), longest_axis(whole), mapped_from_high_end(region, whole));
  const auto first_turn = region_->spiral(region_->section(0, 1, 1.0), came_from_W_);
  entry_W_ = first_turn.empty() ? region_->box().center : first_turn.front();
  if (crew_.led()) return change(crew_.leads() ? Stage::explore : Stage::wait, in);
  assume_solid();
  begin_section(crew_.rank(), in);
}

XxhRegionMap::Config XxhPlanner::map_config() const {
  XxhRegionMap::Config map;
  map.voxel_m = config_.voxel_m;
  map.margin_m = config_.margin_m;
  map.min_hits = config_.min_hits;
  map.rim_m = config_.rim_m;
  map.spiral_step = config_.spiral_step;
  map.lowest_m = kLowestM;
  map.nearest_m = ways_.clearance_m() + kSpareM;
  map.farthest_m = std::max(map.nearest_m, config_.standoff_ratio * reach_.sharp_distance_m);
  return map;
}

/// Without anybody's map there is only the box to go by. That is not shared: it is no knowledge.
void XxhPlanner::assume_solid() {
  solid_ = true;
  region_->assume_solid();
}

void XxhPlanner::begin_section(std::size_t section, const PlannerInput& in) {
  begun_.push_back(section);
  inspector_.begin(section_layers(section));
  change(Stage::inspect, in);
}

XxhRegionMap::Section XxhPlanner::section_layers(std::size_t section) const {
  return region_->section(section, crew_.size(), crew_.led() && !config_.faithful ? config_.leader_share : 1.0);
}

void XxhPlanner::change(Stage stage, const PlannerInput& in) {
  stage_ = stage;
  stage_since_ = in.tick;
  not_before_ = in.tick;
  post_.leave_for_good();
}

void XxhPlanner::work(const PlannerInput& in, PlannerOutput& out) {
  const bool fresh = restarted_ && seconds(in.tick - assigned_at_) < kFreshS;
  if (fresh && crew_.assigned() && crew_.farthest_region() > region_index_) enter_region(crew_.farthest_region(), in);
  switch (stage_) {
    case Stage::none:
      return;
    case Stage::explore:
      return explore(in, out);
    case Stage::hand_over:
      return hand_over(in, out);
    case Stage::wait:
      return wait(in, out);
    case Stage::inspect:
      return inspect(in, out);
    case Stage::regroup:
      return regroup(in, out);
    case Stage::finished:
      return go_home(in, out);
  }
}

/// Around the section, turn by turn.
void XxhPlanner::explore(const PlannerInput& in, PlannerOutput& out) {
  const auto turn = out.yaw;  // if the sortie looks around
  explorer_.look_inwards(*region_, in, out);
  if (sortie_.looks_around(in.tick)) out.yaw = turn;
  if (!free_for_something(in)) return;
  if (explorer_.finished(*region_, in)) return next_section(in);
  if (!explorer_.set_out(in, out)) recover(in, out);
}

/// Nothing could be reached: a moment for the map to grow and for others to pass; after many, back the way it came,
/// but who explores has to go on from where it is (Sortie sees to that).
void XxhPlanner::recover(const PlannerInput& in, PlannerOutput& out) {
  not_before_ = in.tick + ticks(stage_ == Stage::inspect ? kShortRestS : kRestS);
  if (ways_.fruitless() < kFruitlessToRetreat) return;
  ways_.start_anew();
  if (stage_ != Stage::explore) sortie_.pilot().retreat(in, out);
}

/// The section that was explored may be inspected from now on; on to the next one.
void XxhPlanner::next_section(const PlannerInput& in) {
  if (exploring_) ++explored_;
  exploring_ = explored_ < crew_.size();
  if (!exploring_) return change(Stage::hand_over, in);
  const double left_s = in.mission_remaining_s.value_or(agent_.duration_s);
  const double at_most_s = kExploreShare * left_s / static_cast<double>(crew_.size() - explored_);
  explorer_.begin(*region_, section_layers(explored_), at_most_s, in);
}

/// Everybody has to hear its order: back to the entry, where they wait.
void XxhPlanner::hand_over(const PlannerInput& in, PlannerOutput& out) {
  const bool gone_on =
      crew_.all_ordered(region_index_, in.tick) || (!config_.faithful && seconds(in.tick - stage_since_) > kHandOverS);
  gone_on ? begin_section(crew_.section_of(0), in) : stay_at_post(in, out);
}

void XxhPlanner::wait(const PlannerInput& in, PlannerOutput& out) {
  ordered_ = crew_.ordered(region_index_);
  const bool on_its_own = !ordered_ && crew_.silent(crew_.leader(), in.tick);
  if (!ordered_ && !on_its_own) return stay_at_post(in, out);
  if (on_its_own && !region_->anything_known()) assume_solid();
  begin_section(crew_.section_of(crew_.rank()), in);
}

void XxhPlanner::inspect(const PlannerInput& in, PlannerOutput& out) {
  if (inspector_.visit()) {
    if (sortie_.pilot().arrived(in)) {
      inspector_.look(in, region_->grid());
      if (inspector_.visit()) look_at(inspector_.target(), out);
    } else if (in.tracking.done || inspector_.obsolete(*region_)) {
      inspector_.give_up();
      sortie_.pilot().stop(out);
    }
    return;
  }
  if (!free_for_something(in)) return;
  inspector_.finished() ? section_done(in) : choose_cell(in, out);
}

void XxhPlanner::choose_cell(const PlannerInput& in, PlannerOutput& out) {
  const Vector3d here = in.tracking.setpoint.p_WB;
  int tries = 0;
  for (const XxhVisit& visit : inspector_.candidates(*region_, here, ways_.space_for_way(in, here))) {
    if (++tries > kTries) return;
    if (!ways_.fly_to(visit.p_WB, config_.inspect_mps, in, out)) {
      inspector_.failed(visit.cell);
      continue;
    }
    inspector_.set_out(visit);
    return look_at(inspector_.target(), out);
  }
  if (tries > 0) recover(in, out);
}

void XxhPlanner::look_at(const XxhTarget& target, PlannerOutput& out) const {
  if (std::abs(target.out_W.z()) < 0.5) out.yaw = std::atan2(-target.out_W.y(), -target.out_W.x());
  out.gimbal = target.surface_W;
}

/// On to the section of somebody who is not there any more; if there is none, done.
void XxhPlanner::section_done(const PlannerInput& in) {
  for (std::size_t rank = 0; rank < crew_.size(); ++rank) {
    const std::size_t section = crew_.section_of(rank);
    const bool begun = std::ranges::count(begun_, section) > 0;
    if (!begun && crew_.silent(crew_.members()[rank], in.tick)) return begin_section(section, in);
  }
  change(Stage::regroup, in);
}

void XxhPlanner::regroup(const PlannerInput& in, PlannerOutput& out) {
  const bool decides = crew_.leads() || !crew_.led() || crew_.silent(crew_.leader(), in.tick);
  const bool impatient = !config_.faithful && seconds(in.tick - stage_since_) > config_.gather_s;
  const XxhWord* leader = talk_.word(crew_.leader());
  if (!crew_.leads() && crew_.led() && leader && leader->region > region_index_) {
    enter_region(leader->region, in);
  } else if (decides && (impatient || crew_.all_done(region_index_, in.tick))) {
    enter_region(region_index_ + 1, in);
  } else {
    stay_at_post(in, out);
  }
}

void XxhPlanner::stay_at_post(const PlannerInput& in, PlannerOutput& out) {
  if (post_.taken()) return sortie_.waits_for(crew_.awaited(in.tick), in, out);
  if (!free_for_something(in)) return;
  if (!post_.take_beside(entry_W_, region_->box().center, crew_.rank(), in, out)) recover(in, out);
}

void XxhPlanner::go_home(const PlannerInput& in, PlannerOutput& out) {
  if (post_.taken() || !free_for_something(in)) return;
  post_.take_at_home(in, out);
  not_before_ = in.tick + ticks(kRestS);
}

XxhWord XxhPlanner::own_word(const PlannerInput& in) const {
  XxhWord word;
  word.start_W = in.state.p_WB.z() < Sortie::kAirborneM ? in.state.p_WB : agent_.me().p_WB_start;
  word.has_plan = crew_.assigned();
  word.region = static_cast<std::uint16_t>(region_index_);
  word.explored = static_cast<std::uint8_t>(explored_);
  word.acknowledged = ordered_;
  word.done = stage_ == Stage::regroup || stage_ == Stage::finished;
  word.way_W = ways_.ahead(in);
  return word;
}

SKEIN_REGISTER_PLANNER("xxh", XxhPlanner);

}  // namespace skein::agent
