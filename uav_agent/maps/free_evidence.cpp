#include "uav_agent/maps/free_evidence.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein::agent {
namespace {

/// Upper bound on a convex function f(k) that falls at least as fast as k^-Power for large k. Within the table, the
/// bound interpolates linearly, because a chord of a convex function lies above it. Beyond the table, it uses the power
/// law.
template <int Power>
class Table {
 public:
  /// @param integrand  g(k, x): f(k) is its integral over x in [0, 1].
  template <class Integrand>
  explicit Table(const Integrand& integrand) {
    constexpr int kParts = 1024;  // numeric: the error of Simpson's rule is far less than the chord's distance from f
    for (std::size_t place = 0; place < values_.size(); ++place) {
      for (int part = 0; part <= kParts; ++part) {
        // Formula: Simpson's rule.
        const double weight = part == 0 || part == kParts ? 1.0 : (part % 2 == 1 ? 4.0 : 2.0);
        const double x = static_cast<double>(part) / kParts;
        const double share = weight / (3.0 * kParts);  // formula: Simpson's rule
        values_[place] += share * integrand(kStep * static_cast<double>(place), x);
      }
    }
  }
  double operator()(double k) const {
    if (k >= kEnd) return values_.back() * std::pow(kEnd / k, Power);
    const auto before = static_cast<std::size_t>(k / kStep);
    const double part = k / kStep - static_cast<double>(before);
    return (1.0 - part) * values_[before] + part * values_[before + 1];
  }

 private:
  static constexpr double kStep = 0.25, kEnd = 64.0;  ///< numeric: places of the table
  std::array<double, static_cast<std::size_t>(kEnd / kStep) + 1> values_ = {};
};

constexpr double kMostK = 1e4;                           ///< numeric: more than any probability asks for
constexpr double kRoundsUp = 1e-12, kRoundsDown = 1e-9;  ///< rounding errors of falls_to() and of proved()

/// The argument at which a decreasing function falls to `value`; never greater than the exact one.
double falls_to(const auto& function, double value, double low, double high) {
  for (int step = 0; step < 60; ++step) {  // numeric: halves the interval to less than a rounding error
    const double middle = 0.5 * (low + high);
    (function(middle) > value ? low : high) = middle;
  }
  return low;
}

}  // namespace

double unseen_along_one_direction(double k) {
  static const Table<2> kTable([](double k_of_table, double x) {
    const double sine = std::sin(0.5 * std::numbers::pi * x);
    return 0.5 * std::numbers::pi * std::exp(-k_of_table * sine) * sine;
  });
  return kTable(k);
}

double unseen_about_an_axis(double c) {
  static const Table<1> kTable([](double c_of_table, double x) { return std::exp(-c_of_table * (1.0 - x * x)); });
  return kTable(c);
}

BeamEvidence::BeamEvidence(const Eigen::Vector3f& direction, int across, float per_m2) {
  const float straight = static_cast<float>(kUnit) * per_m2, units = straight / std::abs(direction[across]);
  const auto rounded = [](float value) { return static_cast<std::int16_t>(value + (value < 0.0F ? -0.5F : 0.5F)); };
  const float x = direction.x(), y = direction.y(), z = direction.z();
  sums_ = Sums{rounded(units * x * x), rounded(units * y * y), rounded(units * z * z), rounded(units * x * y),
               rounded(units * x * z), rounded(units * y * z), rounded(straight),      0};
}

double BeamEvidence::unseen_probability(const FreeCriterion& criterion) const {
  const double k_of_one = criterion.k_of_one_per_m2() / kUnit;
  const double k = k_of_one * (sums_[0] + sums_[1] + sums_[2]);
  const double by_number = unseen_along_one_direction(k);
  if (by_number <= criterion.unseen_p || std::exp(-k) > criterion.unseen_p) return by_number;  // decides most cases
  Matrix3d m;
  m << sums_[0], sums_[3], sums_[4],  //
      sums_[3], sums_[1], sums_[5],   //
      sums_[4], sums_[5], sums_[2];
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(k_of_one * m, Eigen::EigenvaluesOnly);
  const double a = std::max(0.0, k - solver.eigenvalues()[2]), b = std::max(a, k - solver.eigenvalues()[1]);
  return std::min(by_number, std::exp(-a) * unseen_about_an_axis(b - a));
}

// Let a <= b <= c be the eigenvalues of K I - M. Since a + b + c = 2 K, c >= b gives b <= K - a / 2, so the second
// bound is at least exp(-a) D(K - 3 a / 2). This falls as a grows, up to a = 2 K / 3, where all three are equal. The
// largest eigenvalue of M is at least |M|^2 / K (|M|^2: the sum of its squared elements), so a <= K - |M|^2 / K.
FreeJudge::FreeJudge(const FreeCriterion& criterion)
    : criterion_(criterion),
      k_of_one_(criterion.k_of_one_per_m2() / BeamEvidence::kUnit),
      least_k_(-1.5 * std::log(criterion.unseen_p)),  // formula: a = 2 K / 3, above
      enough_k_(falls_to(unseen_along_one_direction, criterion.unseen_p, 0.0, kMostK) * (1.0 + kRoundsUp)),
      fewest_per_m2_(least_k_ / (k_of_one_ * BeamEvidence::kUnit) / std::numbers::sqrt3) {
  for (std::size_t i = 0; i < least_a_.size(); ++i) {
    const double part = static_cast<double>(i + 1) / static_cast<double>(least_a_.size());
    const double k = least_k_ + part * (enough_k_ - least_k_);  // the interval's end: a larger K needs a smaller a
    // Formula: exp(-a) D(K - 3 a / 2), above.
    const auto unseen = [&](double a) { return std::exp(-a) * unseen_about_an_axis(std::max(0.0, k - 1.5 * a)); };
    least_a_[i] = falls_to(unseen, criterion.unseen_p, 0.0, k) * (1.0 - kRoundsDown);
  }
}

bool FreeJudge::proved(const BeamEvidence& evidence) const {
  const auto& sums = evidence.sums_;
  const double k = k_of_one_ * (sums[0] + sums[1] + sums[2]);
  if (k < least_k_) return false;
  if (k < enough_k_) {
    const auto square = [&](std::size_t i) { return static_cast<double>(sums[i]) * sums[i]; };
    // Geometry: the elements beside the diagonal are there twice.
    const double squares = square(0) + square(1) + square(2) + 2.0 * (square(3) + square(4) + square(5));
    const double most_a = k - k_of_one_ * k_of_one_ * squares / k;
    const auto place = static_cast<std::size_t>((k - least_k_) / (enough_k_ - least_k_) * least_a_.size());
    if (most_a < least_a_[std::min(place, least_a_.size() - 1)]) return false;
  }
  return evidence.unseen_probability(criterion_) <= criterion_.unseen_p;
}

}  // namespace skein::agent
