// What a browser may ask of a run's time: pause, go on, one step, another speed. The same text goes from the page to
// the station and on to the server, and each reads it with the same suspicion.   Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skein::view {

/// Slower than this no run is flown; faster than the machine allows it cannot be.
inline constexpr double kLeastSpeed = 0.1, kMostSpeed = 1000.0;
/// Of a flight that is watched, unless another one is asked for.
inline constexpr double kUsualSpeed = 8.0;
/// The same where somebody flies by hand.
inline constexpr double kHandSpeed = 1.0;

struct TimeOrder {
  enum class Kind { pause, resume, step, speed };
  Kind kind = Kind::pause;
  /// Of Kind::speed: simulated seconds a second; none: as fast as the machine allows.
  std::optional<double> speed = {};
  bool operator==(const TimeOrder&) const = default;
};

/// {"do": "pause"}, {"do": "speed", "speed": 8}, {"do": "speed", "speed": "max"}.
std::string text_of(const TimeOrder& order);
/// @returns nullopt when the text is none of these, word for word in its keys; a speed must be within the bounds.
std::optional<TimeOrder> read_time_order(std::string_view text);

/// "max", or a number from kLeastSpeed to kMostSpeed. @returns none: as fast as the machine allows.
/// @throws InputError for any other text, which says what would be right.
std::optional<double> read_speed(const std::string& text);
/// The other way round.
std::string speed_text(const std::optional<double>& speed);

}  // namespace skein::view
