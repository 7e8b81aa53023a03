// Orders by which a browser controls a run's time: pause, resume, a single step, another speed. The text goes unchanged
// from the page to the station and on to sim_server; station and server both validate it.   Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skein::view {

/// Bounds of the speed that may be requested, in simulated seconds per second of wall time.
inline constexpr double kLeastSpeed = 0.1, kMostSpeed = 1000.0;
/// Default speed of a watched flight.
inline constexpr double kUsualSpeed = 8.0;
/// Default speed if a UAV is flown by hand.
inline constexpr double kHandSpeed = 1.0;

struct TimeOrder {
  enum class Kind { pause, resume, step, speed };
  Kind kind = Kind::pause;
  /// For Kind::speed: simulated seconds per second of wall time; none: as fast as the machine allows.
  std::optional<double> speed = {};
  bool operator==(const TimeOrder&) const = default;
};

/// {"do": "pause"}, {"do": "speed", "speed": 8}, {"do": "speed", "speed": "max"}.
std::string text_of(const TimeOrder& order);
/// @returns nullopt unless the text is exactly such an order: known keys only, and a speed within the bounds.
std::optional<TimeOrder> read_time_order(std::string_view text);

/// Reads "max" or a number from kLeastSpeed to kMostSpeed. @returns nullopt for "max": as fast as the machine allows.
/// @throws InputError for any other text; its message says what is allowed.
std::optional<double> read_speed(const std::string& text);
/// The inverse of read_speed().
std::string speed_text(const std::optional<double>& speed);

}  // namespace skein::view
