// Where a UAV's body may be as far as its map proves, for the many questions of a search for ways. Answers are kept for
// a while; the safety filter asks anew before anybody flies.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
#pragma once

#include <array>
#include <cstdint>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class BodyFit {
 public:
  /// @param radius_m  about the body's centre, all must be free.   @param ground_m  below, nothing is asked.
  BodyFit(double radius_m, double ground_m) : radius_m_(radius_m), ground_m_(ground_m) {}

  /// Once per exchange.
  void update(const WorldMap& map, Tick now);
  /// At this very place, as the safety filter asks it of a UAV at rest.
  bool fits(const Vector3d& p_W) const;

 private:
  /// The body, with its middle in a cube of the map.
  enum class Fits : std::uint8_t { unasked, nowhere, somewhere, everywhere };
  struct Answer {
    Tick at : 56 = 0;
    Fits fits : 8 = Fits::unasked;
  };
  /// A search asks for many cubes beside each other: their answers lie beside each other, too.
  static constexpr int kBlockBits = 2, kBlock = 1 << kBlockBits;
  using Answers = std::array<Answer, kBlock * kBlock * kBlock>;

  Answer& answer_of(const WorldMap::Cube& cube) const;
  Fits fits_in(const WorldMap::Cube& cube) const;

  double radius_m_, ground_m_;
  const WorldMap* map_ = nullptr;
  Tick now_ = 0;
  mutable BlockTable<Answers> answers_;
  mutable std::size_t asked_ = 0;  ///< cubes that have an answer
};

}  // namespace skein::agent
