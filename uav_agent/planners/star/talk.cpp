#include "uav_agent/planners/star/talk.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr std::string_view kName = "star/1";
constexpr std::uint8_t kExplored = 1, kHasGoal = 2;            ///< bits of a byte; format
constexpr std::size_t kMaxChunks = 12, kMaxChunkBytes = 6000;  ///< in one message; chosen

MapExchange::Config exchange_config() {
  MapExchange::Config config;
  config.max_chunks = kMaxChunks;
  config.max_bytes = kMaxChunkBytes;
  return config;
}

}  // namespace

StarTalk::StarTalk(const Config& config, const AgentConfig& agent)
    : config_(config), agent_(agent), exchange_(exchange_config()) {}

void StarTalk::listen(const PlannerInput& in, VoxelGrid& grid) {
  const PartTimer timer(in.parts, "planner/talk");
  for (const Payload& payload : open_payloads(in.radio, kName, agent_.fleet.size())) {
    if (payload.sender == agent_.self) continue;
    PayloadReader reader(payload.bytes);
    Word word;
    word.heard = in.tick;
    const std::uint8_t flags = reader.u8();
    word.explored = (flags & kExplored) != 0;
    word.box = reader.u16();
    const Vector3d goal = reader.position();
    if (flags & kHasGoal) word.goal_W = goal;
    if (!reader.ok()) continue;
    words_[payload.sender] = word;
    exchange_.read(payload.sender, in.tick, grid, reader);
  }
}

void StarTalk::speak(const PlannerInput& in, const VoxelGrid& grid, const Word& own, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/talk");
  if (!agent_.due(in.k, config_.share_s, 2 * agent_.self)) return;
  PayloadWriter writer;
  writer.u8(static_cast<std::uint8_t>((own.explored ? kExplored : 0) | (own.goal_W ? kHasGoal : 0)));
  writer.u16(static_cast<std::uint16_t>(own.box));
  writer.position(own.goal_W.value_or(Vector3d::Zero()));
  exchange_.write(grid, in.peers, in.tick, writer);
  out.radio.push_back(send_payload(kName, agent_.self, writer));
}

std::optional<StarTalk::Word> StarTalk::word(std::size_t uav) const {
  const auto found = words_.find(uav);
  return found == words_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<Vector3d> StarTalk::goals_W(Tick now) const {
  std::vector<Vector3d> goals;
  for (const auto& [uav, word] : words_) {
    if (word.goal_W && seconds(now - word.heard) < config_.forget_s) goals.push_back(*word.goal_W);
  }
  return goals;
}

}  // namespace skein::agent
