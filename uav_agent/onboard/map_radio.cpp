#include "uav_agent/onboard/map_radio.hpp"

#include "core/radio/radio_routes.hpp"

namespace skein::agent {

bool MapRadio::is_of_maps(const RadioMessage& message) {
  const std::string_view text = message.text;
  return message.topic == kPlanTopic && text.starts_with(kMapMessages) && text.substr(kMapMessages.size(), 1) == " ";
}

void MapRadio::hear(std::span<const RadioMessage> received, Tick now, WorldMap& map) {
  for (const Payload& payload : open_payloads(received, kMapMessages, fleet_)) {
    PayloadReader reader(payload.bytes);
    news_.read(payload.sender, now, map, reader);
  }
}

std::optional<RadioMessage> MapRadio::tell(const WorldMap& map, const Peers& peers,
                                           const std::optional<Vector3d>& going_to_W, Tick now) {
  PayloadWriter writer;
  if (!news_.write(map, peers, going_to_W, now, writer)) return std::nullopt;
  return send_payload(kMapMessages, self_, writer);
}

}  // namespace skein::agent
