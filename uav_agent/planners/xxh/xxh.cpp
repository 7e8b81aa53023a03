// XXH: the strategy of the second team of the first contest, rebuilt from its published description.
//
// 1. The ground station (ground.cpp) forms a team around each explorer and gives it boxes, in the order of a best-
// first path (plan.hpp). 2. Region by region, the explorer flies a spiral around the box, layer by layer, and maps it
// in cells (region.hpp); its photographers wait at the region's entry. 3. Each member has a section of the layers: as
// soon as a section is explored, the explorer orders its photographer to begin. It inspects the last section itself
// (inspect.hpp). 4. When all are done, the team goes on to the next region. UAVs share trajectories and maps
// (talk.hpp); a UAV chooses no stop on the announced trajectory of a UAV with priority, by role and then by index in
// the fleet. The flight core does the flying (flight_core/flight_core.hpp).
//
// Its weaknesses are the published ones: the exploration is slow, and photographers are idle meanwhile; a share by
// volume says little about the work; no UAV helps another team. Our choice, where the sources are silent: all numbers
// without a source (docs/strategies.md); a UAV that receives no assignment computes it itself; no UAV waits for silent
// leaders and followers; the leader's section is smaller, because it begins last.
// `faithful` brings back defects of the public code: only the first turn of the spiral in each section is flown,
// announced trajectories never expire, and waits have no end. Not modelled: its searches that end after 1,000 cells,
// its commands at the edge of the controller's timeout (here they go out once per exchange), and a UAV name that its
// code does not know.
#include <algorithm>
#include <limits>
#include <string>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/planners/xxh/crew.hpp"
#include "uav_agent/planners/xxh/errand.hpp"
#include "uav_agent/planners/xxh/explore.hpp"
#include "uav_agent/planners/xxh/inspect.hpp"
#include "uav_agent/planners/xxh/post.hpp"
#include "uav_agent/planners/xxh/worksite.hpp"
#include "uav_agent/planning/aiming.hpp"

namespace skein::agent {
namespace {

/// Messages about teams have a byte for the number of a UAV.
constexpr std::size_t kMostUavsOfXxh = std::numeric_limits<std::uint8_t>::max();
constexpr int kFruitless = 8;        ///< after this many unreachable choices in a row (chosen), the flight core ...
constexpr double kGivesWayS = 5.0;   ///< ... has this time to take the UAV elsewhere; chosen
constexpr double kSeekFootS = 40.0;  ///< longest time to prove free space at the foot of an upright region; chosen
/// For this time after a restart in flight, the other UAVs' reports may tell the team's region. Chosen.
constexpr double kFreshS = 10.0;

}  // namespace

class XxhPlanner final : public Planner {
 public:
  using Config = XxhConfig;

  XxhPlanner(const Config& config, const AgentConfig& agent)
      : config_(config.resolved()),
        agent_(agent),
        talk_({.share_s = config_.share_s, .claim_s = *config_.claim_s, .all_give_way = *config_.all_give_way}, agent_),
        crew_(config_, agent_, talk_),
        site_(config_, agent_),
        explorer_(config_),
        inspector_(config_, agent_),
        post_(agent_) {
    if (agent_.fleet.size() <= kMostUavsOfXxh) return;
    throw InputError("planner xxh forms teams of at most " + std::to_string(kMostUavsOfXxh) +
                     " UAVs in all; this fleet has " + std::to_string(agent_.fleet.size()));
  }

  const FlightConfig* flight() const override { return &config_.flight; }
  PlannerOutput plan(const PlannerInput& in) override;

 private:
  /// explore: the leader maps. hand_over: the leader waits until all members have their orders. wait: a follower waits
  /// for its order. inspect: inspects its section. regroup: done, waits for the team. finished: no region is left.
  enum class Stage { none, explore, hand_over, wait, inspect, regroup, finished };

  void prepare(const PlannerInput& in);
  void enter_region(std::size_t index, const PlannerInput& in);
  Vector3d end_before(std::size_t index, const PlannerInput& in) const;
  void decide_end(const PlannerInput& in, PlannerOutput& out);
  void heed_leader(const PlannerInput& in);
  void share_new_map() { talk_.new_map(static_cast<std::uint16_t>(region_index_), site_.from_high_end()); }
  void begin_section(std::size_t section, const PlannerInput& in);
  XxhRegionMap::Section section_layers(std::size_t section) const;
  void change(Stage stage, const PlannerInput& in);
  void work(const PlannerInput& in, PlannerOutput& out);
  bool may_set_out(const PlannerInput& in);
  void explore(const PlannerInput& in, PlannerOutput& out);
  void next_section(const PlannerInput& in);
  void hand_over(const PlannerInput& in, PlannerOutput& out);
  void wait(const PlannerInput& in, PlannerOutput& out);
  void inspect(const PlannerInput& in, PlannerOutput& out);
  bool visit_cells(const PlannerInput& in, PlannerOutput& out);
  void choose_cell(const PlannerInput& in, PlannerOutput& out);
  FreeSpace space_for_stops(const PlannerInput& in) const;
  void section_done(const PlannerInput& in);
  void regroup(const PlannerInput& in, PlannerOutput& out);
  void stay_at_post(const PlannerInput& in, PlannerOutput& out);
  std::vector<Vector3d> posts_W(const PlannerInput& in) const;
  XxhWord own_word(const PlannerInput& in) const;

  const Config config_;
  const AgentConfig agent_;
  XxhTalk talk_;
  XxhCrew crew_;
  XxhErrand errand_;
  XxhWorksite site_;
  XxhExplorer explorer_;
  XxhInspector inspector_;
  XxhPost post_;

  std::optional<Vector3d> start_W_;  ///< the UAV's start; the nominal one after a restart in flight
  Tick assigned_at_ = 0;
  bool restarted_ = false;  ///< the program was restarted in flight
  Stage stage_ = Stage::none;
  Tick stage_since_ = 0, not_before_ = 0;
  int fruitless_ = 0;               ///< choices in a row that could not be reached
  std::size_t region_index_ = 0;    ///< counts on through the rounds
  std::vector<Vector3d> posts_W_;   ///< beside the region's entry, best first; empty: not computed yet
  std::size_t explored_ = 0;        ///< number of sections that are explored
  bool exploring_ = false;          ///< explores section explored_
  std::vector<std::size_t> begun_;  ///< sections that this UAV inspects or has inspected
  bool looks_again_ = false;        ///< goes over its section again while it waits for the others
  Tick look_again_at_ = 0;          ///< when it will do so next
  bool ordered_ = false;            ///< the UAV knows that its section is explored
};

PlannerOutput XxhPlanner::plan(const PlannerInput& in) {
  PlannerOutput out;
  prepare(in);
  errand_.listen(in);
  if (in.flight.working) {
    work(in, out);
  } else {
    inspector_.leave();
    not_before_ = in.tick;
    fruitless_ = 0;
  }
  errand_.conclude(out);
  talk_.speak(in, site_.shared_grid(), own_word(in), out);
  return out;
}

/// Updates what the UAV knows of team and map.
void XxhPlanner::prepare(const PlannerInput& in) {
  if (!start_W_) {
    restarted_ = in.state.p_WB.z() > kBeginsInFlightM;
    start_W_ = restarted_ ? agent_.me().p_WB_start : in.state.p_WB;
  }
  talk_.listen(in, site_.shared_grid());
  if (crew_.seek_assignment(in, restarted_)) {
    assigned_at_ = in.tick;
    enter_region(0, in);
  }
  if (!site_.shared_grid() || !agent_.due(in.k, WorldVoxels::kUpdateS, agent_.self)) return;
  const PartTimer timer(in.parts, "planner/map");
  site_.map().update(*in.world_map);
}

void XxhPlanner::enter_region(std::size_t index, const PlannerInput& in) {
  const PartTimer timer(in.parts, "planner/regions");
  const std::size_t count = crew_.regions().size(), all = static_cast<std::size_t>(*config_.rounds) * count;
  const Vector3d came_from_W = end_before(index, in);
  region_index_ = std::min(index, all);
  ordered_ = false;
  explored_ = 0;
  exploring_ = false;
  explorer_.stop();
  begun_.clear();
  site_.leave();
  if (region_index_ == all) return change(Stage::finished, in);
  const XxhRegion& region = crew_.regions()[region_index_ % count];
  site_.enter(region, in.boxes[region.box], came_from_W, in.space->config().clearance_m);
  share_new_map();
  if (crew_.led()) return change(crew_.leads() ? Stage::explore : Stage::wait, in);
  site_.go_by_the_box();
  begin_section(crew_.rank(), in);
}

/// Where the team comes from when it enters a region: the far end of the last region, or its leader's start.
Vector3d XxhPlanner::end_before(std::size_t index, const PlannerInput& in) const {
  if (index == 0 || crew_.regions().empty()) return agent_.fleet[crew_.leader()].p_WB_start;
  if (site_ && index == region_index_ + 1) return site_.far_end_W();
  const XxhRegion& last = crew_.regions()[(index - 1) % crew_.regions().size()];
  return far_end(last, in.boxes[last.box]);
}

/// The leader decides at which end to begin an upright region: at its foot if some place there is proved free, which
/// the leader finds out at the entry; otherwise at its top. The team learns the decision from its messages.
void XxhPlanner::decide_end(const PlannerInput& in, PlannerOutput& out) {
  const bool open = site_.begins_in_the_open(section_layers(0), space_for_stops(in), in.tracking.setpoint.p_WB);
  const bool closed = post_.reached() || errand_.came_to_nothing() || seconds(in.tick - stage_since_) > kSeekFootS;
  if (!open && !closed) return post_.stay(posts_W(in), config_.flight.approach_mps, errand_, in, out);
  if (site_.decide(open ? site_.from_high_end() : !site_.from_high_end())) share_new_map();
  post_.leave();
  errand_.drop();
}

/// Takes over the end that the team's leader has decided.
void XxhPlanner::heed_leader(const PlannerInput& in) {
  const XxhWord* leader = site_ && crew_.led() && !crew_.leads() ? talk_.word(crew_.leader()) : nullptr;
  if (!leader || !leader->decided || leader->region != region_index_) return;
  if (!site_.decide(leader->from_high_end)) return;
  share_new_map();
  begun_.clear();
  change(Stage::wait, in);
}

void XxhPlanner::begin_section(std::size_t section, const PlannerInput& in) {
  begun_.push_back(section);
  inspector_.begin(section_layers(section));
  change(Stage::inspect, in);
}

XxhRegionMap::Section XxhPlanner::section_layers(std::size_t section) const {
  return site_.map().section(section, crew_.size(), crew_.led() ? *config_.leader_share : 1.0);
}

void XxhPlanner::change(Stage stage, const PlannerInput& in) {
  stage_ = stage;
  stage_since_ = in.tick;
  not_before_ = in.tick;
  fruitless_ = 0;
  looks_again_ = false;
  look_again_at_ = in.tick;
  post_.leave();
  posts_W_.clear();
  errand_.drop();
}

void XxhPlanner::work(const PlannerInput& in, PlannerOutput& out) {
  fruitless_ = errand_.ended() ? 0 : fruitless_ + static_cast<int>(errand_.missed().size());
  const bool fresh = restarted_ && seconds(in.tick - assigned_at_) < kFreshS;
  if (fresh && crew_.assigned() && crew_.farthest_region() > region_index_) enter_region(crew_.farthest_region(), in);
  if (crew_.assigned()) heed_leader(in);
  switch (stage_) {
    case Stage::none:
      return post_.stay({}, config_.flight.approach_mps, errand_, in, out);
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
      return post_.stay(post_.at_home(), config_.flight.approach_mps, errand_, in, out);
  }
}

/// Whether the UAV may make new choices. After many unreachable ones it makes none for a while, so that the flight core
/// begins a recovery behaviour: it looks around, and takes the UAV to where there are other paths.
bool XxhPlanner::may_set_out(const PlannerInput& in) {
  if (errand_.under_way()) return false;
  if (fruitless_ >= kFruitless) {
    fruitless_ = 0;
    not_before_ = in.tick + ticks(kGivesWayS);
  }
  return in.tick >= not_before_;
}

/// Flies around the section, turn by turn.
void XxhPlanner::explore(const PlannerInput& in, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/exploration");
  if (!site_.decided()) return decide_end(in, out);
  explorer_.look_inwards(site_.map(), in, out);
  explorer_.hear(errand_);
  if (explorer_.late(in)) errand_.drop();
  if (!may_set_out(in)) return;
  if (explorer_.finished(site_.map(), in)) next_section(in);
  if (stage_ != Stage::explore) return;
  if (auto choices = explorer_.choices(*in.space); !choices.empty()) errand_.set_out(std::move(choices), out);
}

/// Releases the explored section for inspection, and begins the next one.
void XxhPlanner::next_section(const PlannerInput& in) {
  if (exploring_) ++explored_;
  exploring_ = explored_ < crew_.size();
  if (!exploring_) return change(Stage::hand_over, in);
  const double left_s = in.mission_remaining_s.value_or(agent_.duration_s);
  const double at_most_s = *config_.time_share * left_s / static_cast<double>(crew_.size() - explored_);
  explorer_.begin(site_.map(), section_layers(explored_), at_most_s, in);
}

/// Returns to the entry, where the members wait, until all of them have received their orders.
void XxhPlanner::hand_over(const PlannerInput& in, PlannerOutput& out) {
  const bool gone_on =
      crew_.all_ordered(region_index_, in.tick) || seconds(in.tick - stage_since_) > *config_.hand_over_s;
  gone_on ? begin_section(crew_.section_of(0), in) : stay_at_post(in, out);
}

void XxhPlanner::wait(const PlannerInput& in, PlannerOutput& out) {
  ordered_ = crew_.ordered(region_index_);
  const bool on_its_own = !ordered_ && crew_.silent(crew_.leader(), in.tick);
  if (!ordered_ && !on_its_own) return stay_at_post(in, out);
  if (on_its_own && !site_.map().anything_known()) site_.go_by_the_box();
  begin_section(crew_.section_of(crew_.rank()), in);
}

void XxhPlanner::inspect(const PlannerInput& in, PlannerOutput& out) {
  if (visit_cells(in, out)) section_done(in);
}

/// Visits the section's cells one after the other. @returns whether none is left.
bool XxhPlanner::visit_cells(const PlannerInput& in, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/cells");
  inspector_.hear(errand_);
  if (inspector_.visit()) inspector_.look(in, site_.map().grid());
  if (inspector_.visit()) {
    out.yaw = yaw_facing(inspector_.target().out_W);
    out.gimbal = inspector_.target().surface_W;
    return false;
  }
  const auto flies_to = errand_.flies_to(in);
  if (flies_to && !inspector_.ahead(*flies_to, site_.map())) errand_.drop();
  if (!may_set_out(in)) return false;
  if (inspector_.finished()) return true;
  choose_cell(in, out);
  return false;
}

void XxhPlanner::choose_cell(const PlannerInput& in, PlannerOutput& out) {
  auto choices = inspector_.choices(site_.map(), in.tracking.setpoint.p_WB, space_for_stops(in));
  if (!choices.empty()) errand_.set_out(std::move(choices), out);
}

/// Space for stops: proved free, and clear of the announced trajectories of UAVs with priority.
FreeSpace XxhPlanner::space_for_stops(const PlannerInput& in) const {
  const PartTimer timer(in.parts, "planner/trajectories");
  FreeSpace::Config config = in.space->config();
  config.proved_only = !config.blind_fleet;
  return {config, in.boxes, in.map, talk_.trajectories(in)};
}

/// After its own section, the UAV inspects sections of silent members that it has not begun yet; then it regroups.
void XxhPlanner::section_done(const PlannerInput& in) {
  for (std::size_t rank = 0; rank < crew_.size(); ++rank) {
    const std::size_t section = crew_.section_of(rank);
    const bool begun = std::ranges::count(begun_, section) > 0;
    if (!begun && crew_.silent(crew_.members()[rank], in.tick)) return begin_section(section, in);
  }
  change(Stage::regroup, in);
}

/// Waits for the team. Meanwhile the UAV goes over its layers again from time to time: more may be proved free.
void XxhPlanner::regroup(const PlannerInput& in, PlannerOutput& out) {
  const bool decides = crew_.leads() || !crew_.led() || crew_.silent(crew_.leader(), in.tick);
  const bool impatient = seconds(in.tick - stage_since_) > *config_.gather_s;
  const XxhWord* leader = talk_.word(crew_.leader());
  out.waits_for = crew_.awaited(in.tick);
  if (!crew_.leads() && crew_.led() && leader && leader->region > region_index_) {
    enter_region(leader->region, in);
  } else if (decides && (impatient || crew_.all_done(region_index_, in.tick))) {
    enter_region(region_index_ + 1, in);
  } else if (looks_again_) {
    if (!visit_cells(in, out)) return;
    looks_again_ = false;
    look_again_at_ = in.tick + ticks(*config_.look_again_s);
    errand_.drop();
  } else {
    stay_at_post(in, out);
    looks_again_ = in.tick >= look_again_at_ && !errand_.under_way() && !site_.is_solid();
    if (looks_again_) inspector_.begin(section_layers(begun_.back()));
  }
}

void XxhPlanner::stay_at_post(const PlannerInput& in, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/posts");
  out.waits_for = crew_.awaited(in.tick);
  if (posts_W_.empty()) {
    posts_W_ = posts_W(in);
    const auto spiral_W = site_.map().spiral(site_.map().section(0, 1, 1.0), site_.entry_W());
    if (*config_.wait_at == XxhWaitAt::sight) sort_by_sight(spiral_W, *in.space, posts_W_);
  }
  post_.stay(posts_W_, config_.flight.approach_mps, errand_, in, out);
}

/// This UAV's posts beside the region's entry, the lowest first.
std::vector<Vector3d> XxhPlanner::posts_W(const PlannerInput& in) const {
  return post_.beside(site_.entry_W(), site_.map().box().center, crew_.rank(), top_of(in.boxes));
}

XxhWord XxhPlanner::own_word(const PlannerInput& in) const {
  XxhWord word;
  word.start_W = *start_W_;
  word.has_plan = crew_.assigned();
  word.region = static_cast<std::uint16_t>(region_index_);
  word.from_high_end = site_.from_high_end();
  word.decided = site_ && site_.decided();
  word.explored = static_cast<std::uint8_t>(explored_);
  word.acknowledged = ordered_;
  word.done = stage_ == Stage::regroup || stage_ == Stage::finished;
  word.way_W = errand_.ahead(in);
  return word;
}

SKEIN_REGISTER_PLANNER("xxh", XxhPlanner);

}  // namespace skein::agent
