// The fields of every PointCloud2 that Skein publishes. Frame W, SI units.   Pure; safe from any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace skein::topics {

/// Data types of point fields, with the numbers of sensor_msgs/msg/PointField.
enum class FieldType : std::uint8_t { float32 = 7, float64 = 8 };

struct CloudField {
  std::string_view name;
  FieldType type;
  std::uint32_t offset;  ///< bytes from the start of the point
};

/// Layout of a PointCloud2: little-endian, no padding between points.
struct CloudLayout {
  std::span<const CloudField> fields;
  std::uint32_t point_step;  ///< bytes of one point
};

inline constexpr CloudField kScanFields[] = {{"x", FieldType::float32, 0},
                                             {"y", FieldType::float32, 4},
                                             {"z", FieldType::float32, 8},
                                             {"intensity", FieldType::float32, 12}};
/// LiDAR returns in W [m].
inline constexpr CloudLayout kScanLayout{kScanFields, 16};

inline constexpr CloudField kNeighbourFields[] = {
    {"x", FieldType::float32, 0},          {"y", FieldType::float32, 4},   {"z", FieldType::float32, 8},
    {"intensity", FieldType::float32, 12}, {"t", FieldType::float64, 16},  {"qx", FieldType::float32, 24},
    {"qy", FieldType::float32, 28},        {"qz", FieldType::float32, 32}, {"qw", FieldType::float32, 36},
    {"vx", FieldType::float32, 40},        {"vy", FieldType::float32, 44}, {"vz", FieldType::float32, 48},
    {"wx", FieldType::float32, 52},        {"wy", FieldType::float32, 56}, {"wz", FieldType::float32, 60}};
/// One point per linked neighbour: x y z = position in W [m], intensity = node number (0 = gcs), t = stamp [s],
/// q = attitude q_WB, v = velocity [m/s] and w = angular velocity [rad/s], both expressed in the neighbour's frame B.
inline constexpr CloudLayout kNeighbourLayout{kNeighbourFields, 64};

inline constexpr CloudField kDetectionFields[] = {
    {"x", FieldType::float32, 0},          {"y", FieldType::float32, 4},         {"z", FieldType::float32, 8},
    {"intensity", FieldType::float32, 12}, {"normal_x", FieldType::float32, 16}, {"normal_y", FieldType::float32, 20},
    {"normal_z", FieldType::float32, 24},  {"curvature", FieldType::float32, 28}};
/// One point per interest point that this UAV has seen: x y z in W [m], intensity = this UAV's best score of the point,
/// curvature = its number in the order in which this UAV first saw them (detection_order.hpp), not its scene index.
inline constexpr CloudLayout kDetectionLayout{kDetectionFields, 32};

}  // namespace skein::topics
