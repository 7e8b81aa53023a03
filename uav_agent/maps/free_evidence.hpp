// Free-space evidence: the criterion by which a map calls a place free. It is derived, not tuned.
//
// Question: a thin member (a wire, a lattice bar, a branch, the edge of a slot) of thickness w crosses the tube that a
// UAV's body is about to sweep. Its place and its angle are uniformly distributed. The LiDAR has seen the member if a
// beam hit it within kHaloM of the tube. What is the probability P that the LiDAR has not seen it?
//
// Let beams have the direction b (a unit vector) and the density rho: the number of beams per square metre of a plane
// normal to b. They hit a member along the unit vector u at w rho |sin(b, u)| places per metre of its length: the area
// of its silhouette times rho. If the beams are randomly distributed, all of them miss m metres of the member with
// probability exp(-sum K_i |sin(b_i, u)|), where K_i = w m rho_i. P is the mean of this over all u.
// Two upper bounds hold for any directions of the beams:
//
//   P <= G(K), K = sum K_i, with G(K) = integral over [0, pi/2] of exp(-K sin a) sin a da, about 1 / K^2.
//        This is P if all beams have one direction. Other beams leave less unseen, since exp is convex (Jensen).
//
//   P <= exp(-a) D(b - a), with D(c) = integral over [0, 1] of exp(-c (1 - x^2)) dx, about 1 / 2c.
//        Reason: |sin| >= sin^2, and sum K_i sin^2(b_i, u) = u' (K I - M) u with M = sum K_i b_i b_i'. a <= b are the
//        two least eigenvalues of K I - M; the third is replaced by b.
//
// The first bound serves a UAV that hovers: it needs 375 beams per square metre, a whole sweep of the servo at 7 m.
// The second bound serves a UAV that has looked from several places: 120 beams are enough if they come from all sides.
//
// Both bounds assume random beams. Beams from one place form a lattice (rings are 2 degrees apart, columns 0.8), which
// leaves less unseen: where K sin a < 1, 1 - K sin a replaces exp(-K sin a), so that G becomes 1 / 6 K^2. Lattices
// from many places together are almost random. tests/sensing draws members and measures the unseen share by distance,
// with a separate count for members along lines of a lattice. Repeated beams count once (repeated_scans.hpp).
//
// A LiDAR may lose returns: each beam that hits the member returns nothing with probability q, independently of other
// beams. The remaining hits are again a Poisson process, with 1 - q times the density: all of them are missing with
// probability exp(-(1 - q) sum K_i |sin(b_i, u)|). So (1 - q) K and (1 - q) M replace K and M in both bounds, and
// nothing else changes. In a lattice, the returns of all n beams that hit the member are lost with probability q^n,
// which is less than exp(-(1 - q) n). K must count only beams that reached the member. A beam whose return was lost on
// an object in front of the member did not reach it, so ScanBundler lets a beam without return count only up to the
// first occupied cube.
//
// Losses of neighbouring beams may be correlated (`dropped_sectors`: the LiDAR loses all columns of a sector, a share s
// of the time). Let k_h be the part of K that comes from the h-th drawn set of sectors. The member stays unseen in all
// of them with probability prod (s + (1 - s) exp(-k_h)) at most. -ln(s + (1 - s) exp(-k)) is concave in k and 0 at 0.
// So if no k_h exceeds k_max, that is at most exp(-c K) with c = -ln(s + (1 - s) exp(-k_max)) / k_max. c is less than
// 1 - s, and close to it only for small k_max. The map does not know k_h. It takes q = s, which is a good approximation
// if each of many sets gave a small part of K. If one set gave all of K, the member stays unseen with probability s,
// whatever K is: that is the limit of this criterion.
// tests/sensing/lost_returns_test.cpp measures both kinds of loss.
// Units: metres.   Pure; threads: any.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/types.hpp"

namespace skein::agent {

inline constexpr double kHaloM = 1.0;  ///< all space this near to a body's tube must be free; chosen

/// The thin member that may stand unseen in a place that is called free, and the accepted probability of that.
struct FreeCriterion {
  double member_width_m = 0.05;  ///< chosen
  /// m: the length within kHaloM of a body's tube (radius 0.63 m) of a member 2 m long that touches the tube. It varies
  /// among drawn members. Measured: this m is the one whose 1 / m^2 equals the mean of 1 / m^2 over them.
  double member_in_halo_m = 1.69;
  double unseen_p = 1e-3;    ///< accepted probability P that the member was missed; chosen
  double no_return_p = 0.0;  ///< q above: probability that a hit returns nothing; less than 1

  /// (1 - q) K of a density of one beam per square metre.
  double k_of_one_per_m2() const { return (1.0 - no_return_p) * member_width_m * member_in_halo_m; }
};

/// Evidence of the beams that have passed a window, a square normal to an axis of W: K and M above as integers, so that
/// the sum does not depend on the order of the beams. It fits into one vector register (16 bytes).
class alignas(16) BeamEvidence {  // memory: a vector register
 public:
  static constexpr int kMostPerM2 = 1000;  ///< numeric: more beams per m^2 of a window would overflow

  BeamEvidence() = default;
  /// @param direction  of the beams in W, a unit vector; its sign does not matter.   @param across  axis of W that is
  /// normal to the window: 0, 1 or 2.   @param per_m2  number of beams divided by the window's area: 64 at most.
  BeamEvidence(const Eigen::Vector3f& direction, int across, float per_m2);

  /// Adds new beams; does nothing if there are kMostPerM2 already.   @param other  from the constructor with beams.
  void add(const BeamEvidence& other) {
    if (!full()) sums_ += other.sums_;
  }
  /// Adds sums of beams gathered elsewhere. If the total would overflow, keeps the greater of the two instead.
  void join(const BeamEvidence& other) {
    if (per_m2() + other.per_m2() < kMostPerM2) {
      for (std::size_t i = 0; i < kWhenDue; ++i) sums_[i] = static_cast<std::int16_t>(sums_[i] + other.sums_[i]);
    } else if (other.per_m2() > per_m2()) {
      for (std::size_t i = 0; i < kWhenDue; ++i) sums_[i] = other.sums_[i];
    }
  }
  double per_m2() const { return static_cast<double>(sums_[6]) / kUnit; }
  bool full() const { return sums_[6] >= kUnit * kMostPerM2; }

  /// A reminder for the map: whether the number of beams has reached the threshold of remind_at(); always true before
  /// the first call of it. It is stored here to share a cache line with the sums.
  bool due() const { return sums_[6] >= sums_[kWhenDue]; }
  void remind_at(double per_m2) {
    sums_[kWhenDue] = static_cast<std::int16_t>(std::min<double>(kUnit * per_m2, kNever));
  }
  void never_remind() { sums_[kWhenDue] = kNever; }
  bool may_remind() const { return sums_[kWhenDue] != kNever; }

  /// The smaller of the two upper bounds on P above.
  double unseen_probability(const FreeCriterion& criterion) const;

 private:
  friend class FreeJudge;
  static constexpr std::size_t kWhenDue = 7;  ///< format: index of the threshold of due()
  static constexpr std::int16_t kNever = std::numeric_limits<std::int16_t>::max();  ///< no window reaches it
  /// Units of one beam per square metre, normal to the window; the most oblique beam counts 1.73 times as much.
  /// Numeric.
  static constexpr int kUnit = 16;

  /// An explicit vector type: without it, the compiler adds the elements one by one after a read of one of them.
  /// Memory: one register.
  using Sums [[gnu::vector_size(16)]] = std::int16_t;

  /// Elements xx, yy, zz, xy, xz, yz of sum rho b b' [1/kUnit]; beams per m^2 [1/kUnit]; threshold of due() [1/kUnit].
  Sums sums_ = {};
};

/// Decides whether unseen_probability() is at most FreeCriterion::unseen_p. It rejects most evidence that is not enough
/// with a few multiplications, because a map asks for each window that a beam passes.
class FreeJudge {
 public:
  explicit FreeJudge(const FreeCriterion& criterion);

  bool proved(const BeamEvidence& evidence) const;
  /// Lower bound on BeamEvidence::per_m2(): with fewer beams, proved() is false for any directions.
  double fewest_per_m2() const { return fewest_per_m2_; }

 private:
  FreeCriterion criterion_;
  double k_of_one_ = 0.0;                  ///< (1 - q) K of one unit of the evidence's sums
  double least_k_ = 0.0, enough_k_ = 0.0;  ///< K below least_k_ never proves, K from enough_k_ on always
  double fewest_per_m2_ = 0.0;
  std::array<double, 32> least_a_ = {};  ///< least eigenvalue `a` that can prove; by K in [least_k_, enough_k_]
};

/// Upper approximations of G and D above, by tables. @param k, c  >= 0.
double unseen_along_one_direction(double k);
double unseen_about_an_axis(double c);

}  // namespace skein::agent
