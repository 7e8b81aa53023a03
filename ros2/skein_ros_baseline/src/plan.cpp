#include "plan.hpp"

#include <algorithm>
#include <cmath>

namespace baseline {
namespace {

constexpr double kLayerM = 2.5, kMarginM = 6.0, kTolerance = 0.05;

Region turned(Region region) {
  region.entry += region.length * region.along;
  region.along = -region.along;
  return region;
}

/// All boxes in the order of one path from `at`, each entered at its nearer end.
std::vector<Region> path_from(Vector at, std::vector<Region> boxes) {
  std::vector<Region> path;
  while (!boxes.empty()) {
    for (Region& box : boxes) {
      if ((turned(box).entry - at).norm() < (box.entry - at).norm()) box = turned(box);
    }
    const auto nearest = std::min_element(boxes.begin(), boxes.end(), [&](const Region& a, const Region& b) {
      return (a.entry - at).norm() < (b.entry - at).norm();
    });
    path.push_back(*nearest);
    at = turned(*nearest).entry;
    boxes.erase(nearest);
  }
  return path;
}

/// Takes regions of that volume, within `tolerance`, from the front of a path.
std::vector<Region> take(double volume, double tolerance, std::vector<Region>& path) {
  std::vector<Region> taken;
  while (!path.empty() && volume > tolerance) {
    Region& next = path.front();
    if (next.volume() <= volume + tolerance) {
      volume -= next.volume();
      taken.push_back(next);
      path.erase(path.begin());
      continue;
    }
    Region part = next;
    part.length *= volume / next.volume();
    next.entry += part.length * next.along;
    next.length -= part.length;
    taken.push_back(part);
    break;
  }
  return taken;
}

}  // namespace

int Region::layers() const { return std::max(1, static_cast<int>(std::ceil(length / kLayerM))); }

int Region::layer_of(const Vector& p_W) const {
  const double d = (p_W - entry).dot(along);
  if (d < -kMarginM || d > length + kMarginM || distance_beside(p_W) > kMarginM) return -1;
  return std::clamp(static_cast<int>(std::floor(d / length * layers())), 0, layers() - 1);
}

double Region::distance(const Vector& p_W) const {
  const double d = (p_W - entry).dot(along);
  return std::max({0.0, -d, d - length, distance_beside(p_W)});
}

double Region::distance_beside(const Vector& p_W) const {
  const Vector d = p_W - entry;
  return std::max(std::abs(d.dot(side[0])) - half[0], std::abs(d.dot(side[1])) - half[1]);
}

std::vector<int> Region::sections(int team_size) const {
  std::vector<int> first;
  for (int i = 0; i <= team_size; ++i) first.push_back(i * layers() / team_size);
  return first;
}

Region box_of(const std::vector<Vector>& vertices_W) {
  // Of the ways from one vertex to the others, the shortest three that are perpendicular to each other are the edges.
  std::vector<Vector> ways;
  for (const Vector& vertex : vertices_W) ways.push_back(vertex - vertices_W.front());
  std::sort(ways.begin(), ways.end(), [](const Vector& a, const Vector& b) { return a.norm() < b.norm(); });
  std::vector<Vector> edges;
  for (const Vector& way : ways) {
    const bool is_square = std::all_of(edges.begin(), edges.end(), [&](const Vector& edge) {
      return std::abs(way.dot(edge)) < 0.05 * way.norm() * edge.norm();
    });
    if (way.norm() > 1e-3 && is_square && edges.size() < 3) edges.push_back(way);
  }
  Region box;
  if (edges.size() < 3) return box;
  box.length = edges[2].norm();
  box.along = edges[2].normalized();
  for (int i = 0; i < 2; ++i) {
    box.side[i] = edges[i].normalized();
    box.half[i] = edges[i].norm() / 2.0;
  }
  box.entry = vertices_W.front() + (edges[0] + edges[1]) / 2.0;
  return box;
}

std::vector<Team> make_teams(const std::map<std::string, Start>& fleet, std::vector<Region> boxes) {
  std::vector<Team> teams;
  for (const auto& [name, start] : fleet) {
    if (start.explorer) teams.push_back({{name}, {}});
  }
  if (teams.empty() && !fleet.empty()) teams.push_back({{fleet.begin()->first}, {}});
  if (teams.empty()) return teams;
  for (const auto& [name, start] : fleet) {
    const auto distance = [&, p_W = start.p_W](const Team& team) {
      return (fleet.at(team.members.front()).p_W - p_W).norm();
    };
    const auto nearest = std::min_element(teams.begin(), teams.end(),
                                          [&](const Team& a, const Team& b) { return distance(a) < distance(b); });
    const bool leads = std::any_of(teams.begin(), teams.end(),
                                   [name = name](const Team& team) { return team.members.front() == name; });
    if (!leads) nearest->members.push_back(name);
  }
  std::stable_sort(teams.begin(), teams.end(),
                   [](const Team& a, const Team& b) { return a.members.size() > b.members.size(); });
  double total = 0.0;
  for (const Region& box : boxes) total += box.volume();
  std::vector<Region> path = path_from(fleet.at(teams.front().members.front()).p_W, std::move(boxes));
  for (Team& team : teams) {
    const double share = total * static_cast<double>(team.members.size()) / static_cast<double>(fleet.size());
    team.regions = &team == &teams.back() ? path : take(share, kTolerance * total, path);
  }
  return teams;
}

}  // namespace baseline
