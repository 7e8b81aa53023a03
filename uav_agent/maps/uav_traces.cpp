#include "uav_agent/maps/uav_traces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "uav_agent/maps/cube_steps.hpp"

namespace skein::agent {
namespace {

constexpr Tick kLookEach = kTicksPerSecond;
constexpr double kGapS = 0.25;  ///< positions farther apart in time are not compared with velocities; chosen
/// Time constant of the mean contradiction. Chosen: shorter than errors of a position fix that grow step by step.
constexpr double kFadeS = 1.0;
constexpr double kSigmas = 3.0;     ///< smaller contradictions are noise; chosen
constexpr double kNoLength = 1e-9;  ///< numeric: against a division by zero
constexpr std::size_t kKept = 4;    ///< chosen: a quarter of the cubes is kept

}  // namespace

double seen_radius_m(double body_radius_m, double cell_m, double margin_m) {
  return body_radius_m + 0.5 * std::numbers::sqrt3 * cell_m + margin_m;
}

UavTraces::UavTraces(const AgentConfig& agent, double cell_m, const Config& config) : config_(config), cell_m_(cell_m) {
  for (const FleetMember& member : agent.fleet) {
    Uav& uav = uavs_.emplace_back();
    uav.body_m = seen_radius_m(member.body_radius_m, cell_m, config.margin_m);
    uav.max_speed_mps = member.max_speed_mps;
    uav.p_W = member.p_WB_start;
  }
}

bool UavTraces::hear(Uav& uav, const Peer& peer) const {
  const double gap_s = seconds(now_ - uav.heard);
  const auto at_most = [](const Vector3d& along, double most) {
    return Vector3d(along * std::min(1.0, most / std::max(along.norm(), kNoLength)));
  };
  std::optional<Vector3d> v_W;
  if (peer.v_told) v_W = at_most(peer.v_W, uav.max_speed_mps);
  if (uav.heard > 0 && gap_s <= kGapS) {
    const Vector3d moved_W = peer.p_W - uav.p_W;
    Vector3d told_W = at_most(moved_W, gap_s * uav.max_speed_mps);
    if (v_W && uav.v_W) told_W = 0.5 * gap_s * (*v_W + *uav.v_W);
    uav.strayed_W *= std::exp(-gap_s / kFadeS);
    uav.strayed_W += moved_W - told_W;
  } else {
    uav.strayed_W.setZero();
  }
  uav.heard = now_;
  uav.p_W = peer.p_W;
  uav.v_W = v_W;
  return uav.strayed_W.norm() <= config_.margin_m + kSigmas * std::numbers::sqrt2 * peer.deviation_m.norm();
}

void UavTraces::update(Tick now, const Peers& peers) {
  now_ = now;
  for (const Peer& peer : peers.all()) {
    Uav& uav = uavs_[peer.uav];
    const Absence begins{.lost = uav.heard, .p_lost_W = uav.p_W};
    const bool wrong = peer.visible && !hear(uav, peer);
    if (!peer.visible || wrong) {
      if (!uav.absence) uav.absence = begins;
      uav.absence->found.reset();
      uav.absence->wrong = uav.absence->wrong || wrong;
      continue;
    }
    if (uav.absence && !uav.absence->found) {
      uav.absence->found = now;
      uav.absence->p_found_W = peer.p_W;
    }
  }
}

Vector3d UavTraces::middle_W(const Eigen::Vector3i& cube) const {
  return (cube.cast<double>() + Vector3d::Constant(0.5)) * cell_m_;
}

bool UavTraces::reaches(const Uav& uav, const Vector3d& a_W, const Vector3d& b_W, Tick after) const {
  return (b_W - a_W).norm() <= uav.body_m + uav.max_speed_mps * (seconds(after) + config_.late_s);
}

bool UavTraces::came_to(const Uav& uav, const Candidate& candidate) const {
  if (!uav.absence || candidate.first < uav.absence->lost) return false;
  return reaches(uav, uav.absence->p_lost_W, middle_W(candidate.cube), candidate.first - uav.absence->lost);
}

bool UavTraces::went_from(const Uav& uav, const Candidate& candidate) const {
  if (!uav.absence || !uav.absence->found || candidate.last > *uav.absence->found) return false;
  return reaches(uav, middle_W(candidate.cube), uav.absence->p_found_W, *uav.absence->found - candidate.last);
}

bool UavTraces::fits(const Uav& uav, const Candidate& one, const Candidate& other) const {
  const double apart_m = (middle_W(one.cube) - middle_W(other.cube)).norm();
  for (const Tick a : {one.first, one.last}) {
    for (const Tick b : {other.first, other.last}) {
      const double moved_m = a == b ? 0.0 : uav.max_speed_mps * (std::abs(seconds(b - a)) + config_.late_s);
      if (apart_m > 2.0 * uav.body_m + moved_m) return false;
    }
  }
  return true;
}

bool UavTraces::was(const Uav& uav, std::span<const Candidate> trace) const {
  for (std::size_t i = 0; i < trace.size(); ++i) {
    if (!came_to(uav, trace[i]) || !went_from(uav, trace[i])) return false;
    for (std::size_t j = 0; j < i; ++j) {
      if (!fits(uav, trace[i], trace[j])) return false;
    }
  }
  return true;
}

void UavTraces::met(const Eigen::Vector3i& cube, bool news) {
  if (!news) {
    if (candidates_.empty()) return;
    const std::uint32_t* const place = place_.find(grid_key(cube));
    if (place != nullptr && *place > 0) candidates_[*place - 1].last = now_;
    return;
  }
  const Candidate candidate{cube, now_, now_};
  const auto may_be = [&](const Uav& uav) {
    return uav.absence && (!uav.absence->found || uav.absence->wrong) && came_to(uav, candidate);
  };
  if (candidates_.size() == config_.most_cubes || !any_uav(may_be)) return;
  candidates_.push_back(candidate);
  place_[grid_key(cube)] = static_cast<std::uint32_t>(candidates_.size());
}

std::vector<std::vector<UavTraces::Candidate>> UavTraces::traces(const WorldMap& map) const {
  std::vector<std::vector<Candidate>> traces;
  std::vector<bool> seen(candidates_.size(), false);
  for (std::size_t first = 0; first < candidates_.size(); ++first) {
    if (seen[first]) continue;
    std::vector<std::size_t> trace = {first};
    seen[first] = true;
    bool alone = true;
    for (std::size_t next = 0; next < trace.size(); ++next) {
      for (int i = 0; i < kCubesAround; ++i) {
        const Eigen::Vector3i cube = candidates_[trace[next]].cube + step_around(i);
        const std::uint32_t* const place = place_.find(grid_key(cube));
        if (place == nullptr || *place == 0) {
          alone = alone && (map.known(cube).space != Space::occupied || map.doubted(cube));
        } else if (!seen[*place - 1]) {
          seen[*place - 1] = true;
          trace.push_back(*place - 1);
        }
      }
    }
    if (!alone || trace.size() > kMostInTrace) continue;
    std::vector<Candidate>& found = traces.emplace_back();
    for (const std::size_t one : trace) found.push_back(candidates_[one]);
  }
  return traces;
}

void UavTraces::keep(std::vector<Candidate> candidates) {
  candidates_ = std::move(candidates);
  place_ = {};
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    place_[grid_key(candidates_[i].cube)] = static_cast<std::uint32_t>(i + 1);
  }
}

void UavTraces::doubt(WorldMap& map) {
  const auto due = [&](const Uav& uav) {
    if (!uav.absence || !uav.absence->found) return false;
    return now_ - *uav.absence->found >= ticks(uav.absence->wrong ? config_.agree_s : config_.settle_s);
  };
  const bool full = candidates_.size() > config_.most_cubes / 2;
  if (!full && (now_ < look_at_ || std::ranges::none_of(uavs_, due))) return;
  look_at_ = now_ + kLookEach;
  const std::vector<std::vector<Candidate>> traces = this->traces(map);
  std::vector<Candidate> kept;
  for (const std::vector<Candidate>& trace : traces) {
    const auto left_by = [&](const Uav& uav) { return due(uav) && was(uav, trace); };
    if (any_uav(left_by)) {
      for (const Candidate& candidate : trace) map.doubt(candidate.cube);
      continue;
    }
    const auto may_be = [&](const Uav& uav) {
      return !due(uav) && std::ranges::all_of(trace, [&](const Candidate& one) { return came_to(uav, one); });
    };
    if (any_uav(may_be)) kept.insert(kept.end(), trace.begin(), trace.end());
  }
  std::ranges::stable_sort(kept, {}, &Candidate::first);
  const std::size_t most = config_.most_cubes / kKept;
  if (kept.size() > most) kept.erase(kept.begin(), kept.end() - static_cast<std::ptrdiff_t>(most));
  keep(std::move(kept));
  for (Uav& uav : uavs_) {
    if (due(uav)) uav.absence.reset();
  }
}

}  // namespace skein::agent
