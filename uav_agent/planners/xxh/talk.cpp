#include "uav_agent/planners/xxh/talk.hpp"

#include <algorithm>
#include <utility>

namespace skein::agent {
namespace {

constexpr std::string_view kWordName = "xxh/1", kPlanName = "xxh-gcs/1";
constexpr double kTrajectoryGapM = 2.2;  ///< gap between this UAV's body and a body on an announced trajectory; chosen
constexpr double kSpacingM = 2.0;        ///< maximum distance between the centres of successive spheres; chosen
/// Per trajectory; the UAV will probably change the rest before it flies it. Chosen.
constexpr std::size_t kMaxSpheres = 8;
/// Bits of a word's flags; format.
constexpr int kHasPlan = 1, kAcknowledged = 2, kDone = 4, kFromHighEnd = 8, kDecided = 16;

}  // namespace

void write_word(const XxhWord& word, PayloadWriter& writer) {
  writer.position(word.start_W);
  writer.u8(static_cast<std::uint8_t>((word.has_plan ? kHasPlan : 0) | (word.acknowledged ? kAcknowledged : 0) |
                                      (word.done ? kDone : 0) | (word.from_high_end ? kFromHighEnd : 0) |
                                      (word.decided ? kDecided : 0)));
  writer.u16(word.region);
  writer.u8(word.explored);
  const std::size_t corners = std::min(word.way_W.size(), XxhWord::kMaxWay);
  writer.u8(static_cast<std::uint8_t>(corners));
  for (std::size_t i = 0; i < corners; ++i) writer.position(word.way_W[i]);
}

std::optional<XxhWord> read_word(PayloadReader& reader) {
  XxhWord word;
  word.start_W = reader.position();
  const int flags = reader.u8();
  word.has_plan = (flags & kHasPlan) != 0;
  word.acknowledged = (flags & kAcknowledged) != 0;
  word.done = (flags & kDone) != 0;
  word.from_high_end = (flags & kFromHighEnd) != 0;
  word.decided = (flags & kDecided) != 0;
  word.region = reader.u16();
  word.explored = reader.u8();
  const int corners = reader.u8();
  for (int i = 0; i < corners && reader.ok(); ++i) word.way_W.push_back(reader.position());
  return reader.ok() ? std::optional(word) : std::nullopt;
}

RadioMessage plan_message(const XxhPlan& plan, std::size_t station) {
  PayloadWriter writer;
  write_plan(plan, writer);
  return send_payload(kPlanName, station, writer);
}

std::optional<std::pair<std::size_t, XxhWord>> open_word(const RadioMessage& message, std::size_t fleet_size,
                                                         std::vector<std::uint8_t>* rest) {
  const auto payload = open_payload(message, kWordName, fleet_size);
  if (!payload) return std::nullopt;
  PayloadReader reader(payload->bytes);
  auto word = read_word(reader);
  if (!word) return std::nullopt;
  if (rest) {
    const auto bytes = reader.bytes(reader.left());
    rest->assign(bytes.begin(), bytes.end());
  }
  return std::pair(payload->sender, std::move(*word));
}

void XxhTalk::listen(const PlannerInput& in, VoxelGrid* grid) {
  const PartTimer timer(in.parts, "planner/talk");
  for (const RadioMessage& message : in.radio) {
    std::vector<std::uint8_t> map;
    if (auto heard = open_word(message, agent_.fleet.size(), &map)) {
      auto& [sender, word] = *heard;
      if (sender == agent_.self) continue;
      word.heard = in.tick;
      const bool same_map = map_ && word.region == map_->region && word.from_high_end == map_->from_high_end;
      words_[sender] = std::move(word);
      PayloadReader reader(map);
      if (grid && same_map && !map.empty()) map_->exchange.read(sender, in.tick, *grid, reader);
    } else if (const auto payload = open_payload(message, kPlanName, agent_.fleet.size() + 1); payload && !plan_) {
      PayloadReader reader(payload->bytes);
      if (!in.boxes.empty()) plan_ = read_plan(reader, agent_.fleet.size(), in.boxes.size());
    }
  }
}

void XxhTalk::speak(const PlannerInput& in, const VoxelGrid* grid, const XxhWord& own, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/talk");
  if (!agent_.due(in.k, config_.share_s, 2 * agent_.self)) return;
  PayloadWriter writer;
  write_word(own, writer);
  if (grid && map_) map_->exchange.write(*grid, in.peers, in.tick, writer);
  out.radio.push_back(send_payload(kWordName, agent_.self, writer));
}

const XxhWord* XxhTalk::word(std::size_t uav) const {
  const auto found = words_.find(uav);
  return found == words_.end() ? nullptr : &found->second;
}

double XxhTalk::silent_s(std::size_t uav, Tick now) const {
  const XxhWord* last = word(uav);
  return seconds(now - (last ? last->heard : Tick{0}));
}

/// Whether another UAV has priority over this one: explorers before photographers, then by index in the fleet.
bool XxhTalk::has_priority(std::size_t uav) const {
  const bool explores = agent_.fleet[uav].role == Role::explorer;
  const bool i_explore = agent_.me().role == Role::explorer;
  return explores != i_explore ? explores : uav < agent_.self;
}

std::vector<Sphere> XxhTalk::trajectories(const PlannerInput& in) const {
  std::vector<Sphere> spheres;
  const Vector3d here = in.tracking.setpoint.p_WB;
  for (const auto& [uav, word] : words_) {
    const bool valid = (config_.all_give_way || has_priority(uav)) && seconds(in.tick - word.heard) < config_.claim_s;
    if (!valid || word.way_W.empty()) continue;
    const double radius = agent_.me().body_radius_m + agent_.fleet[uav].body_radius_m + kTrajectoryGapM;
    std::size_t count = 0;
    const auto add = [&](const Vector3d& p) {
      // Leaves out a sphere that contains this UAV itself: a path must begin in free space.
      if (++count <= kMaxSpheres && (p - here).norm() > radius) spheres.push_back({p, radius});
    };
    add(word.way_W.front());
    for (std::size_t i = 0; i + 1 < word.way_W.size(); ++i) {
      const Vector3d leg = word.way_W[i + 1] - word.way_W[i];
      const int steps = static_cast<int>(leg.norm() / kSpacingM) + 1;
      for (int s = 1; s <= steps && count < kMaxSpheres; ++s) add(word.way_W[i] + leg * s / steps);
    }
  }
  return spheres;
}

}  // namespace skein::agent
