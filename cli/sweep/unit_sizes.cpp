#include "cli/sweep/unit_sizes.hpp"

#include <algorithm>

namespace skein::cli {
namespace {

constexpr std::size_t kUnitsPerSlot = 8;  ///< least number, if there are enough flights
constexpr std::size_t kTailShare = 3;     ///< units of the tail are smaller by this factor

}  // namespace

std::size_t UnitSizes::first(std::size_t unit) const {
  if (unit < head_units()) return unit * size;
  return std::min(head() + (unit - head_units()) * tail_size, flights);
}

std::size_t UnitSizes::unit_of(std::size_t flight) const {
  return flight < head() ? flight / size : head_units() + (flight - head()) / tail_size;
}

UnitSizes unit_sizes(std::size_t flights, double flight_s, double unit_s, std::size_t slots) {
  slots = std::max<std::size_t>(slots, 1);
  const double by_time = unit_s / std::max(flight_s, 1e-3);
  const std::size_t by_slots = flights / (kUnitsPerSlot * slots);
  UnitSizes sizes{.flights = flights};
  sizes.size = std::max<std::size_t>(1, std::min(static_cast<std::size_t>(std::min(by_time, 1e6)), by_slots));
  if (sizes.size == 1) return sizes;
  // The tail is about the last unit of each slot.
  const std::size_t head = (flights - slots * sizes.size) / sizes.size * sizes.size;
  sizes.tail = flights - head;
  sizes.tail_size = std::max<std::size_t>(1, sizes.size / kTailShare);
  return sizes;
}

}  // namespace skein::cli
