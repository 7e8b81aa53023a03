// Two-axis camera gimbal with limits of rate and angle, commanded by angle or by rate.
// Angles relative to the yawed body: positive yaw turns left, positive pitch looks down.  Units: rad, rad/s.
// One step is 1/20 s.  Source: golden vectors `gimbal`.
#pragma once

#include <optional>

#include "core/scenario/scenario.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// Mode that CARIC's number stands for (linear.x of the command): > 0 angle, < -1e-7 rate, else freeze. Pure.
GimbalMode gimbal_mode(double number);

/// The gimbal of one UAV. It starts level, looking ahead, in the mode freeze. Not thread-safe.
class Gimbal {
 public:
  static constexpr double kStepS = 0.05;

  /// @param phantom_rate  true: at an angle limit report the commanded rate, and in the mode freeze the last rate, as
  ///                      the reference does. false: report the rate at which the angle really moved.
  /// @param command_steps  steps from one command to the next, >= 1.
  explicit Gimbal(const GimbalConfig& config, bool phantom_rate = false, int command_steps = 1);

  /// One step. A rate command lapses two steps after the next command was due; then the gimbal holds its angle.
  /// @param command  the newest command since the last step; nullopt: none.
  void step(const std::optional<GimbalCommand>& command);

  /// Jams or releases the gimbal. A jammed gimbal receives commands and does not move; released, it obeys the last one.
  void jam(bool jammed) { jammed_ = jammed; }

  const GimbalState& state() const { return state_; }
  /// The present mode; after a lapsed rate command it is `angle`.
  GimbalMode mode() const { return command_.mode; }

 private:
  GimbalConfig config_;
  bool phantom_rate_;
  int rate_command_steps_;  ///< steps after its arrival for which a rate command is obeyed
  GimbalState state_;
  GimbalCommand command_;
  int steps_since_command_ = 0;
  bool jammed_ = false;
};

}  // namespace skein::sim
