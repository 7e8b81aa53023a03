#include "uav_agent/planners/flock/talk.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr std::string_view kName = "flock/1";
constexpr std::size_t kPointsRoom = 4000;  ///< most bytes of points in a message; chosen: all parts fit a payload
constexpr double kRateUnit = 0.1;          ///< unit of a rate in a message [points/s]; format
constexpr double kRateS = 20.0;            ///< age at which another UAV's rate expires; chosen
/// Most chunks of the map in a message, and most bytes of them. Chosen: all parts of a message fit a payload.
constexpr std::size_t kMaxChunks = 8, kMaxChunkBytes = 3000;

}  // namespace

FlockTalk::FlockTalk(const Config& config, const AgentConfig& agent)
    : config_(config), agent_(agent), exchange_({.max_chunks = kMaxChunks, .max_bytes = kMaxChunkBytes}) {}

void FlockTalk::listen(const PlannerInput& in, VoxelGrid& grid, FlockPoints& points) {
  const PartTimer timer(in.parts, "planner/talk");
  for (const Payload& payload : open_payloads(in.radio, kName, agent_.fleet.size())) {
    if (payload.sender == agent_.self) continue;
    PayloadReader reader(payload.bytes);
    FlockWord word{.rate = kRateUnit * reader.u8()};
    const std::size_t claims = std::min<std::size_t>(reader.u8(), kMostClaims);
    for (std::size_t i = 0; i < claims; ++i) {
      const Vector3d p_WB = reader.position(), aim_W = reader.position();
      word.claims.push_back({p_WB, aim_W});
    }
    if (!reader.ok()) continue;
    words_[payload.sender] = {std::move(word), in.tick};
    if (points.read(payload.sender, in.tick, reader)) exchange_.read(payload.sender, in.tick, grid, reader);
  }
}

void FlockTalk::speak(const PlannerInput& in, const VoxelGrid& grid, const FlockPoints& points, const FlockWord& word,
                      PlannerOutput& out) {
  const PartTimer timer(in.parts, "planner/talk");
  if (!agent_.due(in.k, config_.share_s, 2 * agent_.self)) return;
  PayloadWriter writer;
  writer.u8(static_cast<std::uint8_t>(std::clamp(word.rate / kRateUnit, 0.0, 255.0)));  // format: a byte
  const std::size_t count = std::min(word.claims.size(), kMostClaims);
  writer.u8(static_cast<std::uint8_t>(count));
  for (std::size_t i = 0; i < count; ++i) {
    writer.position(word.claims[i].p_WB);
    writer.position(word.claims[i].aim_W);
  }
  points.write(in.peers, in.tick, kPointsRoom, writer);
  exchange_.write(grid, in.peers, in.tick, writer);
  out.radio.push_back(send_payload(kName, agent_.self, writer));
}

std::vector<std::pair<std::size_t, std::vector<FlockClaim>>> FlockTalk::claims(Tick now) const {
  std::vector<std::pair<std::size_t, std::vector<FlockClaim>>> fresh;
  for (const auto& [uav, heard] : words_) {
    if (seconds(now - heard.at) < config_.claim_s) fresh.emplace_back(uav, heard.word.claims);
  }
  return fresh;
}

std::vector<double> FlockTalk::rates(Tick now) const {
  std::vector<double> rates;
  for (const auto& [uav, heard] : words_) {
    if (seconds(now - heard.at) < kRateS) rates.push_back(heard.word.rate);
  }
  return rates;
}

}  // namespace skein::agent
