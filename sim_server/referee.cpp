#include "sim_server/referee.hpp"

#include <stdexcept>
#include <string>

#include "core/math/random_stream.hpp"

namespace skein::sim {

Referee::Referee(std::uint64_t seed, std::size_t uavs, std::size_t points, const RulesConfig& rules)
    : seed_(seed), next_capture_(uavs, 0), collided_(uavs, false), earned_(uavs, points, rules), poor_(points) {}

LedgerEntry& Referee::append(UavIndex uav, Tick tick) {
  if (!ledger_.empty() && tick < ledger_.back().tick) {
    throw std::logic_error("the ledger is kept in the order of time: tick " + std::to_string(tick) + " after " +
                           std::to_string(ledger_.back().tick));
  }
  return ledger_.emplace_back(LedgerEntry{ledger_.size(), tick, uav, false, {}});
}

std::optional<CaptureReport> Referee::enter(UavIndex uav, const Capture& capture) {
  if (collided_.at(uav) || !capture.improved()) {
    return std::nullopt;
  }
  LedgerEntry& entry = append(uav, capture.tick);
  const std::uint64_t number = next_capture_[uav]++;
  entry.capture = {uav, number, capture.tick, RandomStream(seed_, "custody", uav, number).bits(), {}};
  for (const Detection& detection : capture.detections) {
    if (detection.improved) {
      entry.capture.points.push_back({detection.point, static_cast<float>(detection.q_blur),
                                      static_cast<float>(detection.q_res), static_cast<float>(detection.q),
                                      static_cast<float>(detection.q_distance)});
    }
  }
  earned_.add(entry.capture);
  return entry.capture;
}

bool Referee::enter_collision(UavIndex uav, Tick tick) {
  if (collided_.at(uav)) {
    return false;
  }
  append(uav, tick).collision = true;
  collided_[uav] = true;
  earned_.collide(uav);
  return true;
}

void Referee::note_poor(const Capture& capture) {
  for (const Detection& detection : capture.detections) poor_.close(detection.point);
  for (const PoorSight& sight : capture.poor) poor_.add(sight);
}

std::vector<CaptureReport> Referee::reports(UavIndex uav) const {
  std::vector<CaptureReport> reports;
  for (const LedgerEntry& entry : ledger_) {
    if (entry.uav == uav && !entry.collision) {
      reports.push_back(entry.capture);
    }
  }
  return reports;
}

}  // namespace skein::sim
