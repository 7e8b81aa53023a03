#include "core/scoring/detection_order.hpp"

namespace skein {

std::uint32_t DetectionOrder::number(std::uint32_t point) {
  const auto [known, fresh] = numbers_.emplace(point, static_cast<std::uint32_t>(points_.size()));
  if (fresh) points_.push_back(point);
  return known->second;
}

std::optional<std::uint32_t> DetectionOrder::point(std::uint32_t number) const {
  return number < points_.size() ? std::optional(points_[number]) : std::nullopt;
}

}  // namespace skein
