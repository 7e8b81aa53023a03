#include "custody.hpp"

#include <cstring>
#include <limits>

namespace skein_ros {
namespace {

constexpr std::uint64_t kResendSteps = 10;          // without an acknowledgement, a report is sent again after these
constexpr std::size_t kMostBytesPerStep = 200'000;  // the first report of a step may exceed this limit

/// About the size of the serialised report.
std::size_t bytes_of(const skein_msgs::msg::CaptureReport& report) {
  return 48 + report.uav.size() + report.points.size() * sizeof(skein_msgs::msg::CapturePoint);
}

std::uint32_t crc32_with(std::uint32_t crc, std::uint8_t byte) {
  crc ^= byte;
  for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  return crc;
}

/// The checksum of an acknowledgement, as skein_msgs/msg/CaptureAck defines it: CRC-32 as in zlib.
std::uint32_t sum_of(const std::string& uav, const std::vector<std::uint64_t>& captures) {
  std::uint32_t crc = 0xffffffffU;
  for (const char c : uav) crc = crc32_with(crc, static_cast<std::uint8_t>(c));
  for (const std::uint64_t capture : captures) {
    for (int byte = 0; byte < 8; ++byte) crc = crc32_with(crc, static_cast<std::uint8_t>(capture >> (8 * byte)));
  }
  return ~crc;
}

}  // namespace

void Custody::take(const skein_msgs::msg::CaptureReports& reports) {
  for (const auto& report : reports.reports) {
    if (acknowledged_.count(report.capture) == 0) held_.try_emplace(report.capture, Held{report, false, 0});
  }
}

void Custody::see(const sensor_msgs::msg::PointCloud2& neighbours) {
  // Offset of the field "intensity", a float32 with the neighbour's node number; 0 is the ground station.
  constexpr std::size_t kNodeOffset = 12;
  linked_ = false;
  if (neighbours.point_step < kNodeOffset + sizeof(float)) return;
  for (std::size_t at = 0; at + neighbours.point_step <= neighbours.data.size(); at += neighbours.point_step) {
    float node = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(&node, neighbours.data.data() + at + kNodeOffset, sizeof node);
    linked_ = linked_ || node == 0.0F;
  }
}

std::vector<std::uint64_t> Custody::acknowledge(const skein_msgs::msg::CaptureAck& ack) {
  if (ack.uav != uav_ || ack.sum != sum_of(ack.uav, ack.captures)) return {};
  for (const std::uint64_t capture : ack.captures) {
    held_.erase(capture);
    acknowledged_.insert(capture);
  }
  return ack.captures;
}

skein_msgs::msg::CaptureReports Custody::due(std::uint64_t k) {
  skein_msgs::msg::CaptureReports out;
  if (!linked_) return out;
  std::size_t bytes = 0;
  for (auto& [capture, held] : held_) {
    if (held.sent && k < held.sent_at + kResendSteps) continue;
    const std::size_t report_bytes = bytes_of(held.report);
    if (!out.reports.empty() && bytes + report_bytes > kMostBytesPerStep) break;
    bytes += report_bytes;
    held.sent = true;
    held.sent_at = k;
    out.reports.push_back(held.report);
  }
  return out;
}

skein_msgs::msg::CaptureAck Custody::ack_of(std::vector<std::uint64_t> captures) const {
  skein_msgs::msg::CaptureAck ack;
  ack.uav = uav_;
  ack.sum = sum_of(uav_, captures);
  ack.captures = std::move(captures);
  return ack;
}

}  // namespace skein_ros
