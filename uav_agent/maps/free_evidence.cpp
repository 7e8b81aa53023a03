#include "uav_agent/maps/free_evidence.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein::agent {
namespace {

/// A convex function that falls at last as its argument to the power of -Power or faster: between places of the table
/// its chord lies above it, and beyond the table the power does.
template <int Power>
class Table {
 public:
  /// @param integrand  of k and x in [0, 1].
  template <class Integrand>
  explicit Table(const Integrand& integrand) {
    constexpr int kParts = 1024;  // Simpson's rule: its error is far below what lies between function and chord
    for (std::size_t place = 0; place < values_.size(); ++place) {
      for (int part = 0; part <= kParts; ++part) {
        const double weight = part == 0 || part == kParts ? 1.0 : (part % 2 == 1 ? 4.0 : 2.0);
        const double x = static_cast<double>(part) / kParts;
        values_[place] += weight / (3.0 * kParts) * integrand(kStep * static_cast<double>(place), x);
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
  static constexpr double kStep = 0.25, kEnd = 64.0;
  std::array<double, static_cast<std::size_t>(kEnd / kStep) + 1> values_ = {};
};

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
  sums_ = {rounded(units * x * x), rounded(units * y * y), rounded(units * z * z), rounded(units * x * y),
           rounded(units * x * z), rounded(units * y * z), rounded(straight),      0};
}

double BeamEvidence::unseen_probability(const FreeCriterion& criterion) const {
  const double k_of_one = criterion.member_width_m * criterion.member_in_halo_m / kUnit;
  const double k = k_of_one * (sums_[0] + sums_[1] + sums_[2]);
  const double by_number = unseen_along_one_direction(k);
  if (by_number <= criterion.unseen_p || std::exp(-k) > criterion.unseen_p) return by_number;  // most are clear
  Matrix3d m;
  m << sums_[0], sums_[3], sums_[4],  //
      sums_[3], sums_[1], sums_[5],   //
      sums_[4], sums_[5], sums_[2];
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(k_of_one * m, Eigen::EigenvaluesOnly);
  const double a = std::max(0.0, k - solver.eigenvalues()[2]), b = std::max(a, k - solver.eigenvalues()[1]);
  return std::min(by_number, std::exp(-a) * unseen_about_an_axis(b - a));
}

}  // namespace skein::agent
