// When a place may be called free: the one criterion, derived and not tuned.
//
// The question. A member (a wire, a lattice bar, a branch, the edge of a slot) of thickness w, at a place and an angle
// that are drawn evenly, crosses the tube that a UAV's body is about to sweep. The LiDAR has seen it if a beam met it
// within kHaloM of that tube. With which probability P has it not?
//
// Beams along the unit vector b, rho of them through each square metre across b, meet a member along the unit vector u
// in w rho |sin(b, u)| places a metre: the area of its silhouette times their density. If beams are strewn evenly, all
// of them miss m metres of it with probability exp(-sum K_i |sin(b_i, u)|), K_i = w m rho_i. P is its mean over all u.
// Two bounds hold whatever the directions are:
//
//   P <= G(K), K = sum K_i, with G(K) = integral over [0, pi/2] of exp(-K sin a) sin a da, about 1 / K^2.
//        What beams of a single direction leave unseen; for exp is convex, and their mean is below its mean (Jensen).
//
//   P <= exp(-a) D(b - a), with D(c) = integral over [0, 1] of exp(-c (1 - x^2)) dx, about 1 / 2c.
//        For |sin| >= sin^2, and sum K_i sin^2(b_i, u) = u' (K I - M) u with M = sum K_i b_i b_i'. a <= b are the two
//        least eigenvalues of K I - M; the third counts as b.
//
// The first is what a UAV that hovers has: 375 beams a square metre, all of a sweep of the servo at 7 m.
// The second is what it has that has looked from several places: 120 are enough if they come from all sides.
//
// Both take beams as strewn at random. Those of one place stand in a lattice (rings are 2 degrees apart, columns 0.8),
// which leaves less: where K sin a < 1, a share of 1 - K sin a in the place of exp(-K sin a), so that G is 1 / 6 K^2.
// Lattices of many places come near to what is random. tests/sensing draws members, and asks by distance how many are
// not seen, those along lines of a lattice apart. Beams that repeat each other count once (repeated_scans.hpp).
//
// A LiDAR may lose returns: each beam that meets the member returns nothing with probability q, whatever the others do.
// Then the sightings are those of above, each kept with probability 1 - q. They are a Poisson process again, of 1 - q
// times the density: all of them are lost with probability exp(-(1 - q) sum K_i |sin(b_i, u)|). So (1 - q) K and
// (1 - q) M take the places of K and M in both bounds, and nothing else changes. In a lattice, n beams that meet it
// leave q^n, which is less than exp(-(1 - q) n). K counts beams that came as far as the member. A beam that was lost on
// something before it did not: ScanBundler takes beams without return for free up to the first occupied cube.
//
// Losses of neighbouring beams may depend on each other (`dropped_sectors`: all columns of a sector, a share s of the
// time). Let k_h of K come from one drawn set of sectors. The member is unseen in all of them with probability
// prod (s + (1 - s) exp(-k_h)) at most. -ln(s + (1 - s) exp(-k)) is concave in k and 0 at 0. So if no k_h is above
// k_max, that is at most exp(-c K) with c = -ln(s + (1 - s) exp(-k_max)) / k_max: less than 1 - s, and near to it only
// for small k_max. The map does not know k_h. It takes q = s, which is near to the truth if each of many sets gave a
// small part of K. If one set gave all of it, a member may be unseen with probability s, whatever K is: that is the
// limit of this criterion.
// tests/sensing/lost_returns_test.cpp measures both.
// Units: metres.   Pure; threads: any.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/types.hpp"

namespace skein::agent {

inline constexpr double kHaloM = 1.0;  ///< about a body's tube, all must be free

/// What must not stand unseen in a place that is called free.
struct FreeCriterion {
  double member_width_m = 0.05;
  /// Of a member of 2 m that touches a body's tube (of radius 0.63 m), so much lies within kHaloM of it: the m of which
  /// 1 / m^2 is the mean over drawn ones.
  double member_in_halo_m = 1.69;
  double unseen_p = 1e-3;    ///< with which probability it may have been missed
  double no_return_p = 0.0;  ///< q of above, less than 1

  /// K of one beam a square metre, of those that return.
  double k_of_one_per_m2() const { return (1.0 - no_return_p) * member_width_m * member_in_halo_m; }
};

/// Beams that have passed a window across an axis of W: K and M of above, as whole numbers, so that their order does
/// not matter. One fits into a processor's vector.
class alignas(16) BeamEvidence {
 public:
  static constexpr int kMostPerM2 = 1000;  ///< of a window; more are not counted: they would not fit

  BeamEvidence() = default;
  /// @param direction  of the beams, a unit vector; its sign does not matter.   @param across  axis of the window: 0, 1
  /// or 2.   @param per_m2  beams over the window's area: 64 at most.
  BeamEvidence(const Eigen::Vector3f& direction, int across, float per_m2);

  /// Nothing once there are kMostPerM2.   @param other  just made from beams.
  void add(const BeamEvidence& other) {
    if (!full()) sums_ += other.sums_;
  }
  /// Beams that were gathered elsewhere, besides. Where both do not fit, it becomes the one with more of them.
  void join(const BeamEvidence& other) {
    if (per_m2() + other.per_m2() < kMostPerM2) {
      for (std::size_t i = 0; i < kWhenDue; ++i) sums_[i] = static_cast<std::int16_t>(sums_[i] + other.sums_[i]);
    } else if (other.per_m2() > per_m2()) {
      for (std::size_t i = 0; i < kWhenDue; ++i) sums_[i] = other.sums_[i];
    }
  }
  double per_m2() const { return static_cast<double>(sums_[6]) / kUnit; }
  bool full() const { return sums_[6] >= kUnit * kMostPerM2; }

  /// A reminder for who gathers, kept here to be in the processor's cache with the rest: whether there are as many
  /// beams as it asked to be told of. At first any number is.
  bool due() const { return sums_[6] >= sums_[kWhenDue]; }
  void remind_at(double per_m2) { sums_[kWhenDue] = static_cast<std::int16_t>(std::min(kUnit * per_m2, 32767.0)); }
  void never_remind() { sums_[kWhenDue] = kNever; }
  bool may_remind() const { return sums_[kWhenDue] != kNever; }

  /// P of above, its lower bound.
  double unseen_probability(const FreeCriterion& criterion) const;

 private:
  friend class FreeJudge;
  static constexpr std::size_t kWhenDue = 7;
  static constexpr std::int16_t kNever = 32767;  ///< no window has so many
  /// One beam a square metre, straight through; the most oblique counts for 1.73 times as much.
  static constexpr int kUnit = 16;

  /// A vector of the processor, and not left to the compiler: it adds them one by one, where it has read one of them.
  using Sums [[gnu::vector_size(16)]] = std::int16_t;

  /// xx, yy, zz, xy, xz, yz of the beams' sum of rho b b', in 1/kUnit; that of their number; and when due.
  Sums sums_ = {};
};

/// Tells whether P is below the criterion, as unseen_probability() does, but most of what is not is told by few
/// products: a map asks for each window that a beam passes.
class FreeJudge {
 public:
  explicit FreeJudge(const FreeCriterion& criterion);

  bool proved(const BeamEvidence& evidence) const;
  /// With fewer beams, nothing is ever proved.
  double fewest_per_m2() const { return fewest_per_m2_; }

 private:
  FreeCriterion criterion_;
  double k_of_one_ = 0.0;                  ///< K of a beam a square metre, in units of the evidence
  double least_k_ = 0.0, enough_k_ = 0.0;  ///< below the one nothing is proved, from the other on everything
  double fewest_per_m2_ = 0.0;
  std::array<double, 32> least_a_ = {};  ///< by K from least_k_ to enough_k_: below that a, nothing is proved
};

/// G and D of above, from above. @param k, c  >= 0.
double unseen_along_one_direction(double k);
double unseen_about_an_axis(double c);

}  // namespace skein::agent
