// Custody of captures on board: keeps each report of the camera until the station acknowledges it, and sends it while
// there is a direct link to the station (docs/lockstep.md). Knows no middleware.   Threads: one.
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

  /// Keeps the reports that the camera hands out. It may hand out a report again.
  void take(const skein_msgs::msg::CaptureReports& reports);
  /// The nodes in line of sight: whether the station is among them.
  void see(const sensor_msgs::msg::PointCloud2& neighbours);
  /// Deletes the reports that the station has in its journal. Ignores a message for another UAV or with a wrong sum.
  /// @returns the captures to acknowledge to the camera
  std::vector<std::uint64_t> acknowledge(const skein_msgs::msg::CaptureAck& ack);

  /// The reports to send to the station in step k, perhaps none.
  skein_msgs::msg::CaptureReports due(std::uint64_t k);
  /// The message that lets the camera release these captures.
  skein_msgs::msg::CaptureAck ack_of(std::vector<std::uint64_t> captures) const;

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
