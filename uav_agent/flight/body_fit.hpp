// Whether a UAV's body fits at a place within space that its map proves free, for the many queries of a path search.
// Answers are cached for 1 to 4 s and may be out of date; the safety filter checks again before the UAV flies.
// Frame W.   Units: metres.   Threads: one.   Deterministic.
#pragma once

#include <array>
#include <cstdint>

#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class BodyFit {
 public:
  /// @param radius_m  radius around the body's centre in which all space must be free.
  /// @param ground_m  cubes entirely below this height are ignored.
  BodyFit(double radius_m, double ground_m) : radius_m_(radius_m), ground_m_(ground_m) {}

  /// Call it once per exchange, and before the first fits(). @param map  must outlive the calls of fits() that follow.
  void update(const WorldMap& map, Tick now);
  /// Replaces the parameters of the constructor. Clears the cached answers if either of the two changes.
  void set(double radius_m, double ground_m);
  /// Whether the body fits with its centre at p: the safety filter's condition for a UAV at rest.
  bool fits(const Vector3d& p_W) const;

 private:
  /// Where in one cube of the map the body's centre may be; somewhere: in part of it, so each place is checked.
  enum class Fits : std::uint8_t { unasked, nowhere, somewhere, everywhere };
  struct Answer {
    /// When it was determined. Memory: the lowest bits of the Tick, which repeat after 31 days.
    std::uint32_t at : 30 = 0;
    Fits fits : 2 = Fits::unasked;  ///< memory: the bits that are left
  };
  static_assert(sizeof(Answer) == 4);  // memory
  /// Memory: answers are stored in blocks of 4^3 cubes, since a search asks for many adjacent cubes.
  static constexpr int kBlockBits = 2, kBlock = 1 << kBlockBits;
  using Answers = std::array<Answer, kBlock * kBlock * kBlock>;

  void forget();
  double age_s(const Answer& answer) const;
  Answer& answer_of(const WorldMap::Cube& cube) const;
  Fits fits_in(const WorldMap::Cube& cube) const;

  double radius_m_, ground_m_;
  const WorldMap* map_ = nullptr;
  Tick now_ = 0;
  mutable BlockTable<Answers> answers_;
  mutable std::size_t asked_ = 0;  ///< number of cubes that have an answer
};

}  // namespace skein::agent
