// Custody of captures on board: each report of the camera's is kept until the station acknowledges it, and sent
// whenever there is a direct link to the station (docs/lockstep.md). Knows no middleware.   Threads: one.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <sensor_msgs/msg/point_cloud2.hpp>
#include <skein_msgs/msg/capture_ack.hpp>
#include <skein_msgs/msg/capture_reports.hpp>

namespace skein_ros {

class Custody {
 public:
  explicit Custody(std::string uav) : uav_(std::move(uav)) {}

  /// What the camera hands out, possibly again.
  void take(const skein_msgs::msg::CaptureReports& reports);
  /// The nodes in line of sight.
  void see(const sensor_msgs::msg::PointCloud2& neighbours);
  /// What the station has written down. A message whose sum is wrong, or of another UAV, says nothing.
  /// @returns what is to be handed on to the camera, if anything
  std::vector<std::uint64_t> acknowledge(const skein_msgs::msg::CaptureAck& ack);

  /// What is to be sent to the station in step k; empty: nothing.
  skein_msgs::msg::CaptureReports due(std::uint64_t k);
  /// The camera may forget these.
  skein_msgs::msg::CaptureAck ack_of(std::vector<std::uint64_t> captures) const;

  std::size_t undelivered() const { return held_.size(); }

 private:
  struct Held {
    skein_msgs::msg::CaptureReport report;
    bool sent = false;
    std::uint64_t sent_at = 0;  ///< step
  };
  const std::string uav_;
  std::map<std::uint64_t, Held> held_;
  std::set<std::uint64_t> acknowledged_;
  bool linked_ = false;
};

}  // namespace skein_ros
