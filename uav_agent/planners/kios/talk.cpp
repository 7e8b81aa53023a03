#include "uav_agent/planners/kios/talk.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr std::string_view kName = "kios/1";

}  // namespace

void KiosTalk::listen(const PlannerInput& in, VoxelGrid& grid) {
  const PartTimer timer(in.parts, "planner/talk");
  for (const Payload& payload : open_payloads(in.radio, kName, agent_.fleet.size())) {
    if (payload.sender == agent_.self) continue;
    PayloadReader reader(payload.bytes);
    Word word;
    word.heard = in.tick;
    word.mapping = reader.u8() != 0;
    word.stop = reader.u32();
    word.goal_W = reader.position();
    const int claims = reader.u8();
    for (int i = 0; i < claims; ++i) word.claims.push_back(reader.u32());
    if (!reader.ok()) continue;
    words_[payload.sender] = std::move(word);
    exchange_.read(payload.sender, in.tick, grid, reader);
  }
}

void KiosTalk::speak(const PlannerInput& in, const VoxelGrid& grid, const Word& own, PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/talk");
  if (!agent_.due(in.k, config_.share_s, 2 * agent_.self)) return;
  PayloadWriter writer;
  writer.u8(own.mapping ? 1 : 0);
  writer.u32(own.stop);
  writer.position(own.goal_W);
  const std::size_t claims = std::min(own.claims.size(), config_.max_claims);
  writer.u8(static_cast<std::uint8_t>(claims));
  for (std::size_t i = 0; i < claims; ++i) writer.u32(own.claims[i]);
  exchange_.write(grid, in.peers, in.tick, writer);
  out.radio.push_back(send_payload(kName, agent_.self, writer));
}

std::optional<KiosTalk::Word> KiosTalk::word(std::size_t uav) const {
  const auto found = words_.find(uav);
  return found == words_.end() ? std::nullopt : std::optional(found->second);
}

std::set<KiosTalk::Id> KiosTalk::claimed(Tick now) const {
  std::set<Id> cubes;
  for (const auto& [uav, word] : words_) {
    if (valid(word, now)) cubes.insert(word.claims.begin(), word.claims.end());
  }
  return cubes;
}

std::set<std::uint32_t> KiosTalk::taken(Tick now) const {
  std::set<std::uint32_t> stops;
  for (const auto& [uav, word] : words_) {
    if (valid(word, now) && word.stop != kNoStop) stops.insert(word.stop);
  }
  return stops;
}

}  // namespace skein::agent
