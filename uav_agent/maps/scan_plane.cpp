#include "uav_agent/maps/scan_plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace skein::agent {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kNearM = 5.0;  ///< nearer hits tell no direction: the sensor is not quite where its UAV is
constexpr std::size_t kFewestHits = 60, kMostHits = 300;
constexpr double kRingSine = 0.28;  ///< of 15 degrees, and what an error of the position adds
constexpr double kWithin = 0.99;    ///< of the hits
constexpr int kTilts = 12;
constexpr double kSure = 6.0 * kDegree;  ///< no plane that differs by more fits the hits
constexpr double kSteps[] = {6.0 * kDegree, 3.0 * kDegree, 1.5 * kDegree, 0.75 * kDegree};
constexpr int kMostMoves = 6;

std::vector<Vector3d> directions_of(const Vector3d& p_WS, const std::vector<Eigen::Vector3f>& hits_W) {
  std::vector<Vector3d> directions;
  const std::size_t every = 1 + hits_W.size() / kMostHits;
  for (std::size_t i = 0; i < hits_W.size(); i += every) {
    const Vector3d ray = hits_W[i].cast<double>() - p_WS;
    if (ray.squaredNorm() > kNearM * kNearM) directions.push_back(ray.normalized());
  }
  return directions;
}

Vector3d tilted(const Vector3d& normal, double angle, int tilt) {
  const double turn = 2.0 * std::numbers::pi * tilt / kTilts;
  const Vector3d a = normal.unitOrthogonal(), b = normal.cross(a);
  return (std::cos(angle) * normal + std::sin(angle) * (std::cos(turn) * a + std::sin(turn) * b)).normalized();
}

/// Directions, and how far they are from planes.
class Spread {
 public:
  explicit Spread(std::vector<Vector3d> directions)
      : directions_(std::move(directions)),
        last_(static_cast<std::size_t>(kWithin * static_cast<double>(directions_.size() - 1))) {}

  const std::vector<Vector3d>& directions() const { return directions_; }

  /// Sine of the angle to the plane within which nearly all directions lie; nullopt where that is more than `most`.
  /// Of most planes a few directions tell that: those that told it of other planes come first.
  std::optional<double> edge(const Vector3d& normal, double most) {
    const std::size_t may_be_outside = directions_.size() - 1 - last_;
    std::size_t outside = 0;
    sines_.clear();
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      sines_.push_back(std::abs(directions_[i].dot(normal)));
      if (sines_.back() <= most) continue;
      std::swap(directions_[i], directions_[outside++]);
      if (outside > may_be_outside) return std::nullopt;
    }
    const auto last = sines_.begin() + static_cast<std::ptrdiff_t>(last_);
    std::nth_element(sines_.begin(), last, sines_.end());
    return *last;
  }

 private:
  std::vector<Vector3d> directions_;
  const std::size_t last_;  ///< of nearly all
  std::vector<double> sines_;
};

/// The plane that they are nearest to, then the one whose farthest is nearest.
Vector3d best_normal(Spread& spread) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Vector3d& direction : spread.directions()) squares += direction * direction.transpose();
  Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors().col(0);
  double best = *spread.edge(normal, std::numeric_limits<double>::infinity());
  for (const double step : kSteps) {
    for (int move = 0; move < kMostMoves; ++move) {
      const Vector3d from = normal;
      for (int tilt = 0; tilt < kTilts; ++tilt) {
        const Vector3d other = tilted(from, step, tilt);
        if (const auto there = spread.edge(other, best); there && *there < best) {
          best = *there;
          normal = other;
        }
      }
      if (normal == from) break;
    }
  }
  return normal;
}

}  // namespace

std::optional<Vector3d> scan_plane(const Vector3d& p_WS, const std::vector<Eigen::Vector3f>& hits_W) {
  std::vector<Vector3d> directions = directions_of(p_WS, hits_W);
  if (directions.size() < kFewestHits) return std::nullopt;
  Spread spread(std::move(directions));
  const Vector3d normal = best_normal(spread);
  if (!spread.edge(normal, kRingSine)) return std::nullopt;
  for (int tilt = 0; tilt < kTilts; ++tilt) {
    if (spread.edge(tilted(normal, kSure, tilt), kRingSine)) return std::nullopt;
  }
  return normal;
}

}  // namespace skein::agent
