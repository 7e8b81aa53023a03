#include "idl/hand_conversions.hpp"

#include <cmath>

#include "idl/conversions.hpp"

namespace skein {

msg::HandCommand to_hand_command(Tick tick, const HandCommand& command) {
  msg::HandCommand message;
  message.header(to_header(tick));
  message.velocity().x(command.velocity.x());
  message.velocity().y(command.velocity.y());
  message.velocity().z(command.velocity.z());
  message.yaw_rate(command.yaw_rate);
  message.gimbal_pitch_rate(command.gimbal_pitch_rate);
  message.gimbal_yaw_rate(command.gimbal_yaw_rate);
  return message;
}

std::optional<HandCommand> from_hand_command(const msg::HandCommand& message) {
  const HandCommand command{.velocity = {message.velocity().x(), message.velocity().y(), message.velocity().z()},
                            .yaw_rate = message.yaw_rate(),
                            .gimbal_pitch_rate = message.gimbal_pitch_rate(),
                            .gimbal_yaw_rate = message.gimbal_yaw_rate()};
  const bool finite = command.velocity.allFinite() && std::isfinite(command.yaw_rate) &&
                      std::isfinite(command.gimbal_pitch_rate) && std::isfinite(command.gimbal_yaw_rate);
  return finite ? std::optional(command) : std::nullopt;
}

}  // namespace skein
