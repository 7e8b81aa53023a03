#include "uav_agent/planners/flock/points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "uav_agent/api/fnv_hash.hpp"
#include "uav_agent/maps/map_exchange.hpp"

namespace skein::agent {
namespace {

constexpr double kRegionM = 16.0;           ///< edge of a region; chosen
constexpr double kCm = 0.01;                ///< unit of positions in a region [m]; format
constexpr double kQualitySteps = 50.0;      ///< quality 1 in messages; smaller differences are not sent; chosen
constexpr double kNormalSteps = 127.0;      ///< component 1 of a normal in messages; format
constexpr int kNormalZero = 128;            ///< component 0 of a normal in messages; format
constexpr std::size_t kPointBytes = 10;     ///< format: place, normal, quality, as write_region() sends them
constexpr double kLargestIndex = 32'000.0;  ///< index of a region along an axis; format: std::int16_t, with a margin
constexpr double kLeastNormal = 0.1;        ///< length of a normal in a message; a shorter one is damaged; chosen
constexpr double kSameFacing = 0.7;  ///< least cosine between the normals of detections of the same point; chosen
constexpr int kMostVain = 10;        ///< pictures in a row that do not improve a point, which is then left out; chosen
/// Age at which another UAV's hashes expire, as do those of its map.
constexpr double kForgetS = MapExchange::Config().forget_s;

std::uint8_t quality_step(double q) {
  return static_cast<std::uint8_t>(std::lround(kQualitySteps * std::clamp(q, 0.0, 1.0)));
}

std::uint8_t component(double n) {
  return static_cast<std::uint8_t>(std::lround(kNormalSteps * std::clamp(n, -1.0, 1.0)) + kNormalZero);
}

}  // namespace

double FlockPoints::detect(std::span<const DetectedPoint> detected, const Vector3d& p_WC) {
  std::vector<Told> all;
  for (const DetectedPoint& point : detected) {
    all.push_back({point.p_W.cast<double>(), point.n_W.cast<double>(), point.score, point.order});
  }
  return take(all, &p_WC);
}

std::optional<FlockPoints::Spot> FlockPoints::spot_of(const Told& told) {
  const Eigen::Vector3d region = (told.p_W / kRegionM).array().floor();
  // maxCoeff() may ignore a coordinate that is not a number.
  if (!region.allFinite() || !(region.cwiseAbs().maxCoeff() < kLargestIndex)) return std::nullopt;
  if (!(told.n_W.norm() > kLeastNormal)) return std::nullopt;
  Spot spot;
  for (int i = 0; i < 3; ++i) {
    const auto along = static_cast<std::size_t>(i);
    spot.cell[along] = static_cast<std::int16_t>(region[i]);
    const double cm = std::floor((told.p_W[i] - kRegionM * region[i]) / kCm);
    spot.place[along] = static_cast<std::uint16_t>(std::clamp(cm, 0.0, kRegionM / kCm - 1.0));
  }
  return spot;
}

double FlockPoints::take(const std::vector<Told>& all, const Vector3d* p_WC) {
  double gained = 0.0;
  std::set<std::size_t> taken;
  std::vector<std::pair<const Told*, Spot>> others;
  for (const Told& told : all) {
    const auto spot = spot_of(told);
    if (!spot) continue;
    if (const auto point = known(told, *spot)) {
      gained += raise(*point, told, *spot);
      taken.insert(*point);
    } else {
      others.emplace_back(&told, *spot);
    }
  }
  for (const auto& [told, spot] : others) {
    std::optional<std::size_t> point = merge_m_ > 0.0 ? nearest(*told, taken) : known(*told, spot);
    if (point) {
      gained += raise(*point, *told, spot);
    } else {
      point = add(*told, spot, p_WC);
      if (point) gained += told->q;
    }
    if (point) taken.insert(*point);
  }
  return gained;
}

std::optional<std::size_t> FlockPoints::known(const Told& told, const Spot& spot) const {
  if (told.own && merge_m_ > 0.0) {
    const auto found = own_.find(*told.own);
    return found == own_.end() ? std::nullopt : std::optional(found->second);
  }
  const auto region = regions_.find(spot.cell);
  if (region == regions_.end()) return std::nullopt;
  const auto found = region->second.points.find(spot.place);
  return found == region->second.points.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::size_t> FlockPoints::add(const Told& told, const Spot& spot, const Vector3d* p_WC) {
  if (!regions_.contains(spot.cell) && regions_.size() >= kMostRegions) return std::nullopt;
  Region& region = regions_[spot.cell];
  const std::size_t point = points_.size();
  if (!region.points.emplace(spot.place, point).second) return std::nullopt;  // another point is there
  points_.push_back({told.p_W, told.n_W.normalized(), told.q});
  if (p_WC != nullptr && told.n_W.dot(*p_WC - told.p_W) < 0.0) points_.back().n_W *= -1.0;
  spots_.push_back(spot);
  is_own_.push_back(told.own.has_value());
  if (told.own && merge_m_ > 0.0) own_[*told.own] = point;
  region.changed = true;
  return point;
}

/// Updates a known point after a detection by this UAV or another one: its place, and its quality if that is better.
/// @returns by how much its quality rises.
double FlockPoints::raise(std::size_t point, const Told& told, const Spot& spot) {
  if (told.own && merge_m_ > 0.0) {
    own_[*told.own] = point;
    is_own_[point] = true;
  } else if (!told.own && spot < spots_[point]) {
    move(point, spot, told.p_W);
  }
  regions_[spots_[point].cell].changed |= quality_step(told.q) > quality_step(points_[point].q);
  const double gained = std::max(0.0, told.q - points_[point].q);
  if (gained > 0.0) points_[point].vain = 0;
  points_[point].q = std::max(points_[point].q, told.q);
  return gained;
}

/// The nearest point within merge_m_ on a surface that faces the same way, or the opposite way: the sign of a normal
/// is unknown until a camera has seen its point. Two points of this UAV's own camera are never the same.
std::optional<std::size_t> FlockPoints::nearest(const Told& told, const std::set<std::size_t>& except) const {
  std::optional<std::size_t> best;
  double least_m = merge_m_;
  const auto look_in = [&](const Region& region) {
    for (const auto& [place, i] : region.points) {
      const double off_m = (points_[i].p_W - told.p_W).norm();
      if (off_m >= least_m || (told.own && is_own_[i]) || except.contains(i)) continue;
      if (std::abs(points_[i].n_W.dot(told.n_W)) < kSameFacing * told.n_W.norm()) continue;
      least_m = off_m;
      best = i;
    }
  };
  const auto along = [](double x) { return static_cast<int>(std::floor(x / kRegionM)); };
  const Vector3d low_W = told.p_W.array() - merge_m_, high_W = told.p_W.array() + merge_m_;
  for (int x = along(low_W.x()); x <= along(high_W.x()); ++x) {
    for (int y = along(low_W.y()); y <= along(high_W.y()); ++y) {
      for (int z = along(low_W.z()); z <= along(high_W.z()); ++z) {
        const Cell cell = {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::int16_t>(z)};
        if (const auto region = regions_.find(cell); region != regions_.end()) look_in(region->second);
      }
    }
  }
  return best;
}

void FlockPoints::move(std::size_t point, const Spot& to, const Vector3d& p_W) {
  if (!regions_.contains(to.cell) && regions_.size() >= kMostRegions) return;
  Region& there = regions_[to.cell];
  if (!there.points.emplace(to.place, point).second) return;  // another point is there
  there.changed = true;
  Region& from = regions_[spots_[point].cell];
  from.points.erase(spots_[point].place);
  from.changed = true;
  spots_[point] = to;
  points_[point].p_W = p_W;
}

void FlockPoints::expect_better(std::size_t point, Tick now) {
  FlockPoint& expected = points_[point];
  if (++expected.vain < kMostVain) return;
  expected.vain = 0;
  expected.not_before = now + ticks(kLeftOutS);
}

void FlockPoints::expect_again() {
  for (FlockPoint& point : points_) {
    point.vain = 0;
    point.not_before = 0;
  }
}

std::uint16_t FlockPoints::hash_of(const Region& region) const {
  if (!region.changed) return region.hash;
  FnvHash hash;
  for (const auto& [place, index] : region.points) {
    for (const std::uint16_t cm : place) hash.add(cm);
    hash.add(quality_step(points_[index].q));
  }
  region.hash = hash.folded();
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
  // A region that is sent in slices goes first, until all of it is sent. Its place among the regions may have changed.
  const auto sliced = std::ranges::find_if(lacking, [&](const auto& region) { return region->first == sliced_; });
  if (sliced != lacking.end()) next_ = static_cast<std::size_t>(sliced - lacking.begin());
  sliced_.reset();
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
    write_region(cell, region.points.begin(), region.points.size(), chosen);
    ++count;
  }
  if (!sliced_) next_ += count;
  writer.u16(count);
  writer.bytes(chosen.data());
}

/// The next `most` points of a region that has more than fit in one message. Its slices follow one another by place,
/// whatever points the region gains or loses meanwhile.
void FlockPoints::write_slice(const Cell& cell, const Region& region, std::size_t most, PayloadWriter& writer) const {
  auto first = region.points.lower_bound(region.next_slice);
  if (first == region.points.end()) first = region.points.begin();
  const auto left = static_cast<std::size_t>(std::distance(first, region.points.end()));
  const std::size_t count = std::min(most, left);
  write_region(cell, first, count, writer);
  region.next_slice = {};
  if (count == left) return;
  region.next_slice = std::next(first, static_cast<std::ptrdiff_t>(count))->first;
  sliced_ = cell;
}

void FlockPoints::write_region(const Cell& cell, std::map<Place, std::size_t>::const_iterator first, std::size_t count,
                               PayloadWriter& writer) const {
  for (const std::int16_t along : cell) writer.u16(static_cast<std::uint16_t>(along));
  writer.u16(static_cast<std::uint16_t>(count));
  for (auto next = first; count > 0; --count, ++next) {
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
  std::vector<Told> all;
  for (std::size_t i = 0; i < points && reader.ok(); ++i) {
    Told told;
    // In the middle of its centimetre, so that rounding gives the same place again.
    for (int k = 0; k < 3; ++k) told.p_W[k] = corner_W[k] + kCm * (reader.u16() + 0.5);
    for (int k = 0; k < 3; ++k) told.n_W[k] = (reader.u8() - kNormalZero) / kNormalSteps;
    told.q = reader.u8() / kQualitySteps;
    if (told.q > 1.0) return false;  // damaged: the whole fleet would take the point as done
    if (reader.ok()) all.push_back(told);
  }
  take(all, nullptr);
  return reader.ok();
}

}  // namespace skein::agent
