#include "uav_agent/planners/xxh/plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace skein::agent {
namespace {

constexpr double kSettledM = 1.0;  ///< a report within this distance of the nominal start means that start; chosen

/// Centre of one of the two faces across the longest edge.
Vector3d end_of(const OrientedBox& box, bool high) {
  const int axis = longest_axis(box);
  return box.center + (high ? 0.5 : -0.5) * box.size[axis] * box.R_WO.col(axis);
}

std::vector<XxhTeam> make_teams(const std::vector<XxhStart>& starts) {
  std::vector<XxhTeam> teams;
  std::vector<Vector3d> at;
  for (const XxhStart& start : starts) {
    if (start.role != Role::explorer) continue;
    teams.push_back({{start.uav}, {}});
    at.push_back(start.p_WB);
  }
  const bool led = !teams.empty();
  if (!led && !starts.empty()) teams.emplace_back();
  for (const XxhStart& start : starts) {
    if (start.role == Role::explorer) continue;
    std::size_t nearest = 0;
    for (std::size_t i = 1; led && i < at.size(); ++i) {
      if ((start.p_WB - at[i]).norm() < (start.p_WB - at[nearest]).norm()) nearest = i;
    }
    teams[nearest].members.push_back(start.uav);
  }
  std::ranges::stable_sort(teams,
                           [](const XxhTeam& a, const XxhTeam& b) { return a.members.size() > b.members.size(); });
  return teams;
}

/// All boxes in order: the next one is always the one with the end nearest to where the last one was left.
std::vector<XxhRegion> best_first_path(const Vector3d& start_W, const std::vector<OrientedBox>& boxes) {
  std::vector<XxhRegion> path;
  std::vector<std::size_t> left(boxes.size());
  std::iota(left.begin(), left.end(), 0U);
  Vector3d at = start_W;
  while (!left.empty()) {
    std::size_t best = 0;
    bool from_high = false;
    double distance = -1.0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      for (const bool high : {false, true}) {
        const double d = (end_of(boxes[left[i]], high) - at).norm();
        if (distance >= 0.0 && d >= distance) continue;
        distance = d;
        best = i;
        from_high = high;
      }
    }
    path.push_back({left[best], 0, XxhRegion::kWhole, from_high});
    at = end_of(boxes[left[best]], !from_high);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return path;
}

double region_volume(const XxhRegion& region, const std::vector<OrientedBox>& boxes) {
  return volume_of(boxes[region.box]) * region.share() / XxhRegion::kWhole;
}

/// Takes regions off the front of `path` until they make up `target`: a region that fits to within `slack` stays whole.
std::vector<XxhRegion> take(double target, double slack, const std::vector<OrientedBox>& boxes,
                            std::vector<XxhRegion>& path) {
  std::vector<XxhRegion> taken;
  double sum = 0.0;
  while (!path.empty()) {
    const double volume = region_volume(path.front(), boxes);
    const double missing = target - sum;
    if (missing <= slack) break;
    if (volume <= missing + slack) {
      taken.push_back(path.front());
      path.erase(path.begin());
      sum += volume;
      continue;
    }
    XxhRegion& rest = path.front();
    XxhRegion part = rest;
    const int share = std::clamp(static_cast<int>(std::lround(missing / volume * rest.share())), 0, rest.share());
    if (share == 0) break;
    if (rest.from_high_end) {
      part.from = rest.to = rest.to - share;
    } else {
      part.to = rest.from = rest.from + share;
    }
    taken.push_back(part);
    if (rest.share() == 0) path.erase(path.begin());
    break;
  }
  return taken;
}

}  // namespace

int longest_axis(const OrientedBox& box) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (box.size[i] > box.size[axis]) axis = i;
  }
  return axis;
}

std::optional<BoxEnd> foot_end(const OrientedBox& box) {
  const double up = box.R_WO.col(longest_axis(box)).z();
  if (std::abs(up) < std::numbers::sqrt2 / 2.0) return std::nullopt;
  return up > 0.0 ? BoxEnd::low : BoxEnd::high;
}

double volume_of(const OrientedBox& box) { return box.size.prod(); }

OrientedBox region_box(const XxhRegion& region, const OrientedBox& box) {
  const int axis = longest_axis(box);
  OrientedBox slice = box;
  const double middle = 0.5 * (region.from + region.to) / XxhRegion::kWhole - 0.5;
  slice.center += middle * box.size[axis] * box.R_WO.col(axis);
  slice.size[axis] *= static_cast<double>(region.share()) / XxhRegion::kWhole;
  return slice;
}

Vector3d far_end(const XxhRegion& region, const OrientedBox& box) {
  const OrientedBox part = region_box(region, box);
  const int axis = longest_axis(box);
  return part.center + (region.from_high_end ? -0.5 : 0.5) * part.size[axis] * part.R_WO.col(axis);
}

const XxhTeam* XxhPlan::team_of(std::size_t uav) const {
  for (const XxhTeam& team : teams) {
    if (std::ranges::count(team.members, uav) > 0) return &team;
  }
  return nullptr;
}

XxhPlan assign(std::vector<XxhStart> starts, const std::vector<OrientedBox>& boxes, double tolerance) {
  std::ranges::stable_sort(starts, {}, &XxhStart::uav);
  XxhPlan plan{make_teams(starts)};
  if (plan.teams.empty()) return plan;
  const std::size_t first = plan.teams.front().members.front();
  const auto leader = std::ranges::find(starts, first, &XxhStart::uav);
  std::vector<XxhRegion> path = best_first_path(leader->p_WB, boxes);
  double total = 0.0;
  for (const OrientedBox& box : boxes) total += volume_of(box);
  // Shares count from the beginning of the path, so that not the next team alone bears the error of a team's share.
  std::size_t placed = 0;
  double given = 0.0;
  for (std::size_t i = 0; i + 1 < plan.teams.size(); ++i) {
    XxhTeam& team = plan.teams[i];
    placed += team.members.size();
    const double target = total * static_cast<double>(placed) / static_cast<double>(starts.size()) - given;
    team.regions = take(target, tolerance * total, boxes, path);
    for (const XxhRegion& region : team.regions) given += region_volume(region, boxes);
  }
  plan.teams.back().regions = std::move(path);
  return plan;
}

Vector3d settled_start(const Vector3d& reported_W, const Vector3d& nominal_W) {
  return (reported_W - nominal_W).norm() < kSettledM ? nominal_W : reported_W;
}

void write_plan(const XxhPlan& plan, PayloadWriter& writer) {
  writer.u8(static_cast<std::uint8_t>(plan.teams.size()));
  for (const XxhTeam& team : plan.teams) {
    writer.u8(static_cast<std::uint8_t>(team.members.size()));
    for (const std::size_t uav : team.members) writer.u8(static_cast<std::uint8_t>(uav));
    writer.u16(static_cast<std::uint16_t>(team.regions.size()));
    for (const XxhRegion& region : team.regions) {
      writer.u16(static_cast<std::uint16_t>(region.box));
      writer.u16(static_cast<std::uint16_t>(region.from));
      writer.u16(static_cast<std::uint16_t>(region.to));
      writer.u8(region.from_high_end ? 1 : 0);
    }
  }
}

std::optional<XxhPlan> read_plan(PayloadReader& reader, std::size_t uavs, std::size_t boxes) {
  XxhPlan plan;
  const int teams = reader.u8();
  bool sound = true;
  for (int t = 0; t < teams && reader.ok(); ++t) {
    XxhTeam team;
    const int members = reader.u8();
    for (int i = 0; i < members && reader.ok(); ++i) {
      team.members.push_back(reader.u8());
      sound &= team.members.back() < uavs;
    }
    const int regions = reader.u16();
    for (int i = 0; i < regions && reader.ok(); ++i) {
      XxhRegion region;
      region.box = reader.u16();
      region.from = reader.u16();
      region.to = reader.u16();
      region.from_high_end = reader.u8() != 0;
      sound &= region.box < boxes && region.from < region.to && region.to <= XxhRegion::kWhole;
      team.regions.push_back(region);
    }
    sound &= !team.members.empty();
    plan.teams.push_back(std::move(team));
  }
  if (!sound || !reader.ok()) return std::nullopt;
  return plan;
}

}  // namespace skein::agent
