#include "view/scan_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/text/base64.hpp"
#include "process/json_text.hpp"
#include "view/look_order.hpp"

namespace skein::view {
namespace {

constexpr int kKeyBits = 21;
constexpr float kPerMetre = 10.0F, kMostNumber = 32'767.0F;

/// Whether a point can be encoded in 16-bit decimetres; false also for a point that is not finite.
bool can_be_told(const Eigen::Vector3f& p_W) {
  return p_W.allFinite() && p_W.cwiseAbs().maxCoeff() * kPerMetre < kMostNumber;
}

/// @param p_W  can_be_told().
std::uint64_t cell_of(const Eigen::Vector3f& p_W) {
  std::uint64_t key = 0;
  for (const float along : p_W) {
    const auto cell = static_cast<std::int64_t>(std::floor(along / ScanPoints::kCell_m));
    key = key << kKeyBits | (static_cast<std::uint64_t>(cell) & ((1U << kKeyBits) - 1));
  }
  return key;
}

}  // namespace

void ScanPoints::add(std::span<const Eigen::Vector3f> points_W) {
  for (const Eigen::Vector3f& p_W : points_W) {
    if (cells_.size() == most_kept_) return;
    if (!can_be_told(p_W) || p_W.z() < kGround_m) continue;
    if (cells_.insert(cell_of(p_W)).second) points_W_.push_back(p_W);
  }
}

std::vector<Eigen::Vector3f> ScanPoints::take(std::size_t most) {
  std::vector<Eigen::Vector3f> taken;
  const std::size_t count = std::min(most, points_W_.size());
  taken.reserve(count);
  for (std::size_t i = 0; i < count; ++i) taken.push_back(points_W_[i * points_W_.size() / count]);
  points_W_.clear();
  cells_.clear();
  return taken;
}

std::string packed_points(std::span<const Eigen::Vector3f> points_W) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(6 * points_W.size());
  for (const Eigen::Vector3f& p_W : points_W) {
    if (!can_be_told(p_W)) continue;
    for (const float along : p_W) {
      const auto number = static_cast<std::uint16_t>(std::lround(along * kPerMetre));
      bytes.push_back(static_cast<std::uint8_t>(number));
      bytes.push_back(static_cast<std::uint8_t>(number >> 8));
    }
  }
  return base64(bytes);
}

std::string lidar_text(const std::string& uav, std::span<const PointsStep> steps) {
  Json list = Json::array();
  for (const PointsStep& step : steps) list.push_back({{"t", step.time_s}, {"points", packed_points(step.points_W)}});
  const Json json = {{"n", lidar_cloud(uav)}, {"steps", std::move(list)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace skein::view
