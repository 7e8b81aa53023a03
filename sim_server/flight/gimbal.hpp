// Two-axis camera gimbal: rate-limited, with stops, commanded by angle or by rate.
// Angles relative to the yawed body: positive yaw turns left, positive pitch looks down.  Units: rad, rad/s.
// One step is 1/20 s.  Source: golden vectors `gimbal`.
#pragma once

#include <optional>

#include "core/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// Mode of CARIC's number (linear.x of the command): > 0 angle, < -1e-7 rate, else freeze. Pure.
GimbalMode gimbal_mode(double number);

/// The gimbal of one UAV. Starts level, ahead, frozen. Not thread-safe.
class Gimbal {
 public:
  static constexpr double kStepS = 0.05;

  /// @param phantom_rate  report the commanded rate at a stop and the last rate while frozen, as the reference
  ///                      does; otherwise the rate reported is the one at which the angle really moved.
  /// @param command_steps  steps from one command to the next, >= 1.
  explicit Gimbal(const GimbalConfig& config, bool phantom_rate = false, int command_steps = 1);

  /// One step. A rate command lapses two steps after the next one was due: the gimbal then holds its angle.
  /// @param command  the newest command since the last step, if there is one.
  void step(const std::optional<GimbalCommand>& command);

  /// Stuck: it hears commands and does not move. Let go, it obeys the last one.
  void jam(bool jammed) { jammed_ = jammed; }

  const GimbalState& state() const { return state_; }
  /// What the gimbal does now: a lapsed rate command counts as angle.
  GimbalMode mode() const { return command_.mode; }

 private:
  GimbalConfig config_;
  bool phantom_rate_;
  int rate_command_steps_;  ///< in which a rate command is obeyed after the step that brought it
  GimbalState state_;
  GimbalCommand command_;
  int steps_since_command_ = 0;
  bool jammed_ = false;
};

}  // namespace skein::sim
