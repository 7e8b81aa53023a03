// How the flights of a sweep are divided into units, in their order.   Pure; any thread.
#pragma once

#include <cstddef>

namespace skein::cli {

/// All units have the same size except those of the tail: the last flights are in smaller units, so that all slots end
/// at about the same time.
struct UnitSizes {
  std::size_t flights = 0;    ///< of the sweep
  std::size_t size = 1;       ///< flights of a unit, at most
  std::size_t tail = 0;       ///< number of flights in the tail
  std::size_t tail_size = 1;  ///< flights of a unit in the tail, at most

  std::size_t units() const { return head_units() + divided(tail, tail_size); }
  /// Index of a unit's first flight; for `unit` == units(): the number of flights.
  std::size_t first(std::size_t unit) const;
  std::size_t unit_of(std::size_t flight) const;

 private:
  static std::size_t divided(std::size_t flights, std::size_t size) { return (flights + size - 1) / size; }
  std::size_t head() const { return flights - tail; }
  std::size_t head_units() const { return divided(head(), size); }
};

/// Chooses sizes so that a unit takes about `unit_s`, or less, so that each of `slots` gets several units.
/// @param flight_s  wall time of a flight [s]. @param unit_s  [s]. @param slots  units that fly at once
UnitSizes unit_sizes(std::size_t flights, double flight_s, double unit_s, std::size_t slots);

}  // namespace skein::cli
