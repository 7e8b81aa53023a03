#include "uav_agent/planners/flock/points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace skein::agent {
namespace {

constexpr double kRegionM = 16.0, kCm = 0.01;
constexpr double kQualitySteps = 50.0;  ///< smaller differences in quality are not sent
constexpr double kForgetS = 10.0;       ///< age at which another UAV's hashes expire
constexpr std::size_t kPointBytes = 10;
constexpr int kMostVain = 10;
constexpr double kVainS = 120.0;
constexpr std::uint32_t kHashStart = 2166136261U, kHashFactor = 16777619U;  // FNV-1a

std::uint8_t quality_step(double q) {
  return static_cast<std::uint8_t>(std::lround(kQualitySteps * std::clamp(q, 0.0, 1.0)));
}

std::uint8_t component(double n) {
  return static_cast<std::uint8_t>(std::lround(127.0 * std::clamp(n, -1.0, 1.0)) + 128);
}

}  // namespace

void FlockPoints::detect(std::span<const DetectedPoint> detected, const Vector3d& p_WC) {
  for (const DetectedPoint& point : detected) {
    take(point.p_W.cast<double>(), point.n_W.cast<double>(), point.score, &p_WC);
  }
}

void FlockPoints::take(const Vector3d& p_W, const Vector3d& n_W, double q, const Vector3d* p_WC) {
  const Eigen::Vector3d region = (p_W / kRegionM).array().floor();
  if (!(region.cwiseAbs().maxCoeff() < 32'000.0) || !(n_W.norm() > 0.1)) return;
  Cell cell;
  Place place;
  for (int i = 0; i < 3; ++i) {
    cell[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(region[i]);
    const double cm = std::floor((p_W[i] - kRegionM * region[i]) / kCm);
    place[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(std::clamp(cm, 0.0, kRegionM / kCm - 1.0));
  }
  if (!regions_.contains(cell) && regions_.size() >= kMostRegions) return;
  Region& in_region = regions_[cell];
  const auto [found, fresh] = in_region.points.emplace(place, points_.size());
  if (fresh) {
    points_.push_back({p_W, n_W.normalized(), q});
    if (p_WC != nullptr && n_W.dot(*p_WC - p_W) < 0.0) points_.back().n_W *= -1.0;
  }
  FlockPoint& point = points_[found->second];
  in_region.changed |= fresh || quality_step(q) > quality_step(point.q);
  if (q > point.q) point.vain = 0;
  point.q = std::max(point.q, q);
}

void FlockPoints::expect_better(std::size_t point, Tick now) {
  FlockPoint& expected = points_[point];
  if (++expected.vain < kMostVain) return;
  expected.vain = 0;
  expected.not_before = now + ticks(kVainS);
}

std::uint16_t FlockPoints::hash_of(const Region& region) const {
  if (!region.changed) return region.hash;
  std::uint32_t hash = kHashStart;
  const auto add = [&hash](std::uint32_t value) { hash = (hash ^ value) * kHashFactor; };
  for (const auto& [place, index] : region.points) {
    for (const std::uint16_t cm : place) add(cm);
    add(quality_step(points_[index].q));
  }
  region.hash = static_cast<std::uint16_t>(hash ^ hash >> 16);
  region.changed = false;
  return region.hash;
}

void FlockPoints::write(const Peers& peers, Tick now, std::size_t room, PayloadWriter& writer) const {
  writer.u16(static_cast<std::uint16_t>(regions_.size()));
  std::vector<std::map<Cell, Region>::const_iterator> lacking;
  for (auto it = regions_.begin(); it != regions_.end(); ++it) {
    const std::uint16_t hash = hash_of(it->second);
    for (const std::int16_t along : it->first) writer.u16(static_cast<std::uint16_t>(along));
    writer.u16(hash);
    const bool lacks = std::ranges::any_of(peers.all(), [&](const Peer& peer) {
      const auto account = accounts_.find(peer.uav);
      if (!peer.visible || account == accounts_.end() || seconds(now - account->second.heard) > kForgetS) return false;
      const auto said = account->second.hashes.find(it->first);
      return said == account->second.hashes.end() || said->second != hash;
    });
    if (lacks) lacking.push_back(it);
  }
  PayloadWriter chosen;
  std::uint16_t count = 0;
  for (std::size_t i = 0; i < lacking.size(); ++i) {
    const auto& [cell, region] = *lacking[(next_ + i) % lacking.size()];
    const std::size_t most = (room - std::min(room, chosen.size())) / kPointBytes;
    if (region.points.size() > most) {
      if (count == 0) {
        write_slice(cell, region, most, chosen);
        ++count;
      }
      break;
    }
    write_region(cell, region, 0, region.points.size(), chosen);
    ++count;
  }
  if (slice_ == 0) next_ += count;
  writer.u16(count);
  writer.bytes(chosen.data());
}

/// The next `most` points of a region that has more than fit in one message.
void FlockPoints::write_slice(const Cell& cell, const Region& region, std::size_t most, PayloadWriter& writer) const {
  if (slice_ >= region.points.size()) slice_ = 0;  // it was that of another region
  const std::size_t count = std::min(most, region.points.size() - slice_);
  write_region(cell, region, slice_, count, writer);
  slice_ = slice_ + count < region.points.size() ? slice_ + count : 0;
}

void FlockPoints::write_region(const Cell& cell, const Region& region, std::size_t first, std::size_t count,
                               PayloadWriter& writer) const {
  for (const std::int16_t along : cell) writer.u16(static_cast<std::uint16_t>(along));
  writer.u16(static_cast<std::uint16_t>(count));
  auto next = std::next(region.points.begin(), static_cast<std::ptrdiff_t>(first));
  for (std::size_t i = 0; i < count; ++i, ++next) {
    const auto& [place, index] = *next;
    for (const std::uint16_t cm : place) writer.u16(cm);
    const FlockPoint& point = points_[index];
    for (const double along : point.n_W) writer.u8(component(along));
    writer.u8(quality_step(point.q));
  }
}

bool FlockPoints::read(std::size_t sender, Tick now, PayloadReader& reader) {
  Account account{.hashes = {}, .heard = now};
  const std::size_t regions = reader.u16();
  for (std::size_t i = 0; i < regions && reader.ok(); ++i) {
    Cell cell;
    for (std::int16_t& along : cell) along = static_cast<std::int16_t>(reader.u16());
    account.hashes[cell] = reader.u16();
  }
  if (!reader.ok() || regions > kMostRegions) return false;
  accounts_[sender] = std::move(account);
  const std::size_t told = reader.u16();
  for (std::size_t i = 0; i < told; ++i) {
    if (!read_region(reader)) return false;
  }
  return reader.ok();
}

bool FlockPoints::read_region(PayloadReader& reader) {
  Vector3d corner_W;
  for (int i = 0; i < 3; ++i) corner_W[i] = kRegionM * static_cast<std::int16_t>(reader.u16());
  const std::size_t points = reader.u16();
  for (std::size_t i = 0; i < points && reader.ok(); ++i) {
    Vector3d p_W, n_W;
    // In the middle of its centimetre, so that rounding gives the same place again.
    for (int k = 0; k < 3; ++k) p_W[k] = corner_W[k] + kCm * (reader.u16() + 0.5);
    for (int k = 0; k < 3; ++k) n_W[k] = (reader.u8() - 128) / 127.0;
    const double q = reader.u8() / kQualitySteps;
    if (reader.ok()) take(p_W, n_W, q, nullptr);
  }
  return reader.ok();
}

}  // namespace skein::agent
