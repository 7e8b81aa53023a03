// A planner for hunts: it flies rounds about the structure and coordinates with the other UAVs by radio, in a way that
// tolerates every fault. Its parameter inserts a defect, which `skein hunt` must find without knowing it. The planner
// flies without the flight core, so nothing else keeps its UAVs safe.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "uav_agent/api/planner.hpp"
#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

enum class Defect {
  none,
  no_boxes_again,   ///< a restarted program ignores the bounding boxes of the structure
  waits_for_dead,   ///< a UAV waits for ever for the message of a visible UAV whose program is dead
  endless_lease,    ///< a lease that is not released never expires
  mutual_wait,      ///< two UAVs wait for each other's message, which each sends only once
  looks_away,       ///< a restarted program flies on, but never looks at the structure again
  flies_blind,      ///< without its LiDAR it flies straight to the middle of the structure
  undying_counter,  ///< it counts its own starts in a variable that outlives a restart
  reads_calendar    ///< the parity of the calendar's 300-day period decides whether it waits before takeoff
};
constexpr std::array<EnumName<Defect>, 9> enum_names(Defect) {
  return {{{"none", Defect::none},
           {"no_boxes_again", Defect::no_boxes_again},
           {"waits_for_dead", Defect::waits_for_dead},
           {"endless_lease", Defect::endless_lease},
           {"mutual_wait", Defect::mutual_wait},
           {"looks_away", Defect::looks_away},
           {"flies_blind", Defect::flies_blind},
           {"undying_counter", Defect::undying_counter},
           {"reads_calendar", Defect::reads_calendar}}};
}

namespace {

constexpr const char* kTopic = "/plan";
constexpr Tick kWordPeriod = kTicksPerSecond;
constexpr double kLate_s = 5.0;  ///< a program that starts after this time has been restarted
constexpr double kLeaseFrom_s = 12.0, kLeaseUntil_s = 22.0, kMeetAt_s = 28.0;
constexpr double kQuiet_s = 2.0, kDead_s = 5.0, kLeaseAge_s = 3.0, kPatience_s = 4.0;
constexpr double kLoiterHeight_m = 70.0, kLoiterWay_m = 10.0, kLoiterSpeed_mps = 4.0, kUp_rad = -1.3;
constexpr double kBlind_s = 8.0, kMoving_mps = 1.0, kBlindSpeed_mps = 4.0;

constexpr double kOffM = 4.0, kLowestM = 10.0, kUpM = 4.0, kApartM = 2.0, kRoundMps = 3.0;

/// Flies rounds about all boxes, higher and higher, then again from the bottom; every other UAV in the opposite
/// direction. The camera points at the nearest part of the boxes.
class Rounds {
 public:
  explicit Rounds(std::size_t self) : self_(self) {}

  PlannerOutput plan(const PlannerInput& in) {
    PlannerOutput out;
    if (in.boxes.empty()) return out;
    const Eigen::AlignedBox3d extent = extent_of(in.boxes);
    const Vector3d p_W = in.tracking.setpoint.p_WB, middle_W = extent.center();
    const Vector3d nearest_W = p_W.cwiseMax(extent.min()).cwiseMin(extent.max());
    out.gimbal = Vector3d(nearest_W.x(), nearest_W.y(), std::max(2.0, nearest_W.z() - 1.0));
    out.yaw = std::atan2(middle_W.y() - p_W.y(), middle_W.x() - p_W.x());
    if (!in.tracking.done) return out;
    const double span_m = std::max(1.0, extent.max().z() - kLowestM);
    const double z = kLowestM + kApartM * static_cast<double>(self_) + std::fmod(kUpM * round_++, span_m);
    std::vector<Vector3d> corners;
    for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
      const Vector3d half = 0.5 * extent.sizes() + Vector3d::Constant(kOffM);
      corners.emplace_back(middle_W.x() + x * half.x(), middle_W.y() + y * half.y(), z);
    }
    const auto off_m = [&](const Vector3d& corner) { return (corner - p_W).norm(); };
    if (self_ % 2 == 1) std::ranges::reverse(corners);
    std::ranges::rotate(corners, std::ranges::min_element(corners, {}, off_m));
    Path path{{{Vector3d(p_W.x(), p_W.y(), z), kRoundMps}}};
    for (const Vector3d& corner : corners) path.waypoints.push_back({corner, kRoundMps});
    path.waypoints.push_back({corners.front(), kRoundMps});
    out.motion = std::move(path);
    return out;
  }

 private:
  const std::size_t self_;
  int round_ = 0;
};

}  // namespace

class PlantedPlanner final : public Planner {
 public:
  struct Config {
    Defect defect = Defect::none;

    void describe(auto& r) { r.field("defect", defect); }
  };

  PlantedPlanner(const Config& config, const AgentConfig& agent)
      : defect_(config.defect), agent_(agent), inner_(agent.self) {}

  PlannerOutput plan(const PlannerInput& in) override {
    const double now_s = seconds(in.tick);
    if (!began_s_) begin(now_s);
    hear(in, now_s);
    PlannerOutput out;
    const bool stands = stands_still(in, now_s);
    if (defect_ == Defect::looks_away && was_away()) {
      loiter(in, out);
    } else if (stands) {
      if (!stood_) leg_ += in.tracking.leg;
      if (in.tracking.airborne) out.motion = Hold{};
    } else if (is_blind(in, now_s)) {
      out.motion = Path{{{in.boxes.front().center, kBlindSpeed_mps}}};
    } else if (stood_ && leg_ < path_.waypoints.size()) {
      out.motion = Path{{path_.waypoints.begin() + static_cast<std::ptrdiff_t>(leg_), path_.waypoints.end()}};
    } else {
      out = inner_.plan(as_seen(in));
      if (!std::holds_alternative<std::monostate>(out.motion)) {
        const Path* path = std::get_if<Path>(&out.motion);
        path_ = path != nullptr ? *path : Path{};
        leg_ = 0;
      }
    }
    stood_ = stands;
    speak(in, now_s, out);
    return out;
  }

 private:
  std::size_t self() const { return agent_.self; }
  std::string word(const char* what) const { return std::string(what) + " " + std::to_string(self()); }

  void begin(double now_s) {
    began_s_ = now_s;
    static std::map<std::size_t, int> starts;  // outlives a restart of the program in the same process
    forgotten_ = defect_ == Defect::undying_counter && ++starts[self()] > 1;
  }
  bool was_away() const { return *began_s_ > kLate_s; }

  void hear(const PlannerInput& in, double now_s) {
    for (const RadioMessage& message : in.radio) {
      if (message.topic == kTopic) heard_s_[message.text] = now_s;
    }
  }
  std::optional<double> silence_s(const std::string& what, double now_s) const {
    const auto heard = heard_s_.find(what);
    return heard == heard_s_.end() ? std::nullopt : std::optional(now_s - heard->second);
  }

  bool stands_still(const PlannerInput& in, double now_s) {
    return forgotten_ || waits_for_calendar(now_s) || waits_for_neighbour(in, now_s) || waits_for_lease(now_s) ||
           waits_for_meeting(now_s);
  }

  bool waits_for_calendar(double now_s) const {
    if (defect_ != Defect::reads_calendar) return false;
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return now / std::chrono::hours(24 * 300) % 2 == 0 && now_s < kLate_s;
  }

  /// Whether to wait because the next UAV is in sight but silent, so that its message may be about to arrive.
  bool waits_for_neighbour(const PlannerInput& in, double now_s) const {
    const std::size_t next = (self() + 1) % agent_.fleet.size();
    const auto silence = silence_s("beat " + std::to_string(next), now_s);
    if (!silence || *silence < kQuiet_s) return false;
    const auto& peers = in.peers.all();
    const bool visible = std::any_of(peers.begin(), peers.end(),
                                     [&](const Peer& peer) { return std::size_t{peer.uav} == next && peer.visible; });
    return visible && (defect_ == Defect::waits_for_dead || *silence < kDead_s);
  }

  /// The first UAV holds a lease on the site: for a while, no other UAV may work there.
  bool waits_for_lease(double now_s) const {
    const auto lease = silence_s("lease 0", now_s), release = silence_s("release 0", now_s);
    if (self() == 0 || !lease || (release && *release <= *lease)) return false;
    return defect_ == Defect::endless_lease || *lease < kLeaseAge_s;
  }

  /// The first two UAVs report when they are ready, and continue together.
  bool waits_for_meeting(double now_s) const {
    if (self() > 1 || *began_s_ > kMeetAt_s || now_s < kMeetAt_s) return false;
    if (silence_s("ready " + std::to_string(1 - self()), now_s)) return false;
    return defect_ == Defect::mutual_wait || now_s < kMeetAt_s + kPatience_s;
  }

  bool is_blind(const PlannerInput& in, double now_s) {
    const bool own_frame = std::any_of(in.key_frames.begin(), in.key_frames.end(), [this](const KeyFrame& frame) {
      return frame.source == node_of_uav(agent_.self);
    });
    const bool moves = in.state.v_WB.norm() > kMoving_mps;
    if (own_frame || !moves) saw_s_ = now_s;
    return defect_ == Defect::flies_blind && agent_.vehicle.lidar && in.tracking.airborne && !in.boxes.empty() &&
           now_s - saw_s_.value_or(now_s) > kBlind_s;
  }

  /// Flies to and fro above all structure, with the camera pointing up.
  static void loiter(const PlannerInput& in, PlannerOutput& out) {
    out.gimbal = GimbalCommand{GimbalMode::angle, kUp_rad, 0.0};
    if (!in.tracking.done) return;
    Vector3d above = in.state.p_WB;
    above.z() = kLoiterHeight_m;
    out.motion = Path{{{above, kLoiterSpeed_mps},
                       {above + kLoiterWay_m * Vector3d::UnitX(), kLoiterSpeed_mps},
                       {above, kLoiterSpeed_mps}}};
  }

  PlannerInput as_seen(const PlannerInput& in) const {
    static const std::vector<OrientedBox> none;
    const bool forgets = defect_ == Defect::no_boxes_again && was_away();
    TrackingState tracking = in.tracking;
    tracking.leg += leg_;
    return {.k = in.k,
            .tick = in.tick,
            .state = in.state,
            .gimbal = in.gimbal,
            .tracking = tracking,
            .map = in.map,
            .boxes = forgets ? none : in.boxes,
            .peers = in.peers,
            .mission_remaining_s = in.mission_remaining_s,
            .station_linked = in.station_linked,
            .undelivered_captures = in.undelivered_captures,
            .detected = in.detected,
            .radio = in.radio,
            .key_frames = in.key_frames,
            .scans = in.scans};
  }

  void speak(const PlannerInput& in, double now_s, PlannerOutput& out) {
    const auto say = [&](const char* what) { out.radio.push_back({kTopic, word(what), {}}); };
    const bool due = in.tick % kWordPeriod == 0;
    if (due) say("beat");
    if (self() == 0 && *began_s_ < kLeaseFrom_s && now_s >= kLeaseFrom_s) {
      const bool over = now_s >= kLeaseUntil_s;
      if (over ? !std::exchange(released_, true) : due) say(over ? "release" : "lease");
    }
    if (self() < 2 && *began_s_ < kMeetAt_s && now_s >= kMeetAt_s) {
      const bool again = due && defect_ != Defect::mutual_wait && now_s < kMeetAt_s + kPatience_s;
      if (!std::exchange(met_, true) || again) say("ready");
    }
  }

  const Defect defect_;
  const AgentConfig agent_;
  Rounds inner_;
  std::map<std::string, double> heard_s_;  ///< when each word was last heard
  std::optional<double> began_s_, saw_s_;
  /// The present path, which is resumed after a hold: else `inner_` would believe that the UAV has arrived.
  Path path_;
  std::size_t leg_ = 0;  ///< index in path_ of the first waypoint of the path that is being flown
  bool stood_ = false;
  bool forgotten_ = false, released_ = false, met_ = false;
};

SKEIN_REGISTER_PLANNER("planted", PlantedPlanner);

}  // namespace skein::agent
