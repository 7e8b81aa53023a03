// The part of idl/conversions.hpp that concerns custody: captures, acknowledgements, the ledger.
#include <zlib.h>

#include <algorithm>

#include "idl/conversions.hpp"

namespace skein {
namespace {

std::uint32_t sum_of(const std::string& uav, const std::vector<std::uint64_t>& captures) {
  std::vector<std::uint8_t> bytes(uav.begin(), uav.end());
  for (const std::uint64_t capture : captures) {
    for (int shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<std::uint8_t>(capture >> shift));
  }
  return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size()));
}

}  // namespace

msg::InterestPoint to_message(const InterestPoint& point) {
  msg::InterestPoint message;
  message.x(point.p_W.x());
  message.y(point.p_W.y());
  message.z(point.p_W.z());
  message.normal_x(point.n_W.x());
  message.normal_y(point.n_W.y());
  message.normal_z(point.n_W.z());
  return message;
}

InterestPoint from_message(const msg::InterestPoint& message) {
  return {{message.x(), message.y(), message.z()}, {message.normal_x(), message.normal_y(), message.normal_z()}};
}

msg::CaptureAck to_capture_ack(const std::string& uav, std::vector<std::uint64_t> captures) {
  msg::CaptureAck ack;
  ack.uav(uav);
  ack.sum(sum_of(uav, captures));
  ack.captures(std::move(captures));
  return ack;
}

std::vector<std::uint64_t> from_capture_ack(const msg::CaptureAck& ack, const std::string& uav) {
  if (ack.uav() != uav || ack.sum() != sum_of(uav, ack.captures())) return {};
  return ack.captures();
}

msg::CaptureReport to_message(const CaptureReport& report, std::span<const std::string> fleet) {
  msg::CaptureReport message;
  message.uav(fleet[report.uav]);
  message.capture(report.capture);
  message.tick(report.tick);
  message.token(report.token);
  for (const CapturePoint& point : report.points) {
    msg::CapturePoint p;
    p.index(point.index);
    p.q_blur(point.q_blur);
    p.q_res(point.q_res);
    p.q(point.q);
    p.q_distance(point.q_distance);
    message.points().push_back(p);
  }
  return message;
}

std::optional<CaptureReport> from_message(const msg::CaptureReport& message, std::span<const std::string> fleet) {
  const auto uav = std::find(fleet.begin(), fleet.end(), message.uav());
  if (uav == fleet.end()) return std::nullopt;
  CaptureReport report;
  report.uav = UavIndex(static_cast<std::size_t>(uav - fleet.begin()));
  report.capture = message.capture();
  report.tick = message.tick();
  report.token = message.token();
  for (const msg::CapturePoint& p : message.points()) {
    report.points.push_back({p.index(), p.q_blur(), p.q_res(), p.q(), p.q_distance()});
  }
  return report;
}

msg::LedgerEntry to_message(const LedgerEntry& entry, std::span<const std::string> fleet) {
  msg::LedgerEntry message;
  message.index(entry.index);
  message.tick(entry.tick);
  message.uav(fleet[entry.uav]);
  message.collision(entry.collision);
  if (!entry.collision) message.capture(to_message(entry.capture, fleet));
  return message;
}

std::optional<LedgerEntry> from_message(const msg::LedgerEntry& message, std::span<const std::string> fleet) {
  const auto uav = std::find(fleet.begin(), fleet.end(), message.uav());
  if (uav == fleet.end()) return std::nullopt;
  LedgerEntry entry;
  entry.index = message.index();
  entry.tick = message.tick();
  entry.uav = UavIndex(static_cast<std::size_t>(uav - fleet.begin()));
  entry.collision = message.collision();
  if (!entry.collision) {
    auto capture = from_message(message.capture(), fleet);
    if (!capture) return std::nullopt;
    entry.capture = std::move(*capture);
  }
  return entry;
}

}  // namespace skein
