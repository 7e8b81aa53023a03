#include "report/recorded_links.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "core/text/text.hpp"
#include "results/run_tables.hpp"

namespace skein::report {
namespace {

bool cuts(const results::RunFault& fault) {
  return fault.kind == "blackout" || fault.kind == "station_outage" || fault.kind == "partition";
}

/// Number of a radio node: 1, 2, ... for UAVs in fleet order, 0 for the station; nullopt: the fleet has no such node.
std::optional<std::size_t> node_of(const results::RunRecord& run, const std::string& name) {
  if (name == "gcs") return 0;
  const auto uav = run.uav_of(name);
  return uav ? std::optional(*uav + 1) : std::nullopt;
}

/// Number of each node's group in a partition like "gcs jurong | raffles". A node that is in no group forms its own.
std::vector<std::size_t> groups_of(const results::RunRecord& run, const std::string& partition) {
  std::vector<std::size_t> groups(run.uavs.size() + 1);
  for (std::size_t node = 0; node < groups.size(); ++node) groups[node] = node;
  std::size_t group = groups.size();
  for (const std::string& names : split(partition, '|')) {
    ++group;
    for (const std::string& name : split(names, ' ')) {
      if (const auto node = node_of(run, name)) groups[*node] = group;
    }
  }
  return groups;
}

/// A fault that cuts links, and which pairs of nodes it separates.
class Cut {
 public:
  Cut(const results::RunRecord& run, const results::RunFault& fault)
      : fault_(fault),
        groups_(fault.kind == "partition" ? groups_of(run, fault.target) : std::vector<std::size_t>()),
        silent_(node_of(run, fault.kind == "blackout" ? fault.target : "gcs")) {}

  bool is_active(double time_s) const { return time_s >= fault_.from_s && time_s < fault_.until_s; }
  bool parts(std::size_t a, std::size_t b) const {
    return groups_.empty() ? a == silent_ || b == silent_ : groups_[a] != groups_[b];
  }
  const results::RunFault& fault() const { return fault_; }

 private:
  const results::RunFault& fault_;
  const std::vector<std::size_t> groups_;
  const std::optional<std::size_t> silent_;
};

class Links {
 public:
  explicit Links(const results::RunRecord& run)
      : nodes_(run.uavs.size() + 1), up_(nodes_ * nodes_), dead_s_(nodes_, 1e12) {
    for (const results::RunFault& fault : run.faults) {
      if (cuts(fault)) cuts_.emplace_back(run, fault);
    }
    for (const results::RunCollision& collision : run.collisions) {
      const auto uav = run.uav_of(collision.uav);
      if (uav) dead_s_[*uav + 1] = std::min(dead_s_[*uav + 1], collision.time_s);
    }
  }

  void set(std::size_t from, std::size_t to, bool up) { up_[from * nodes_ + to] = up; }

  LinkStates shown(double time_s) const {
    LinkStates links;
    for (std::size_t from = 0; from < nodes_; ++from) {
      for (std::size_t to = 0; to < nodes_; ++to) links.push_back(shown(from, to, time_s));
    }
    return links;
  }

  /// Times at which links change without an event: begin and end of faults, and collisions [s].
  std::vector<double> turns() const {
    std::vector<double> turns;
    for (const Cut& cut : cuts_) turns.insert(turns.end(), {cut.fault().from_s, cut.fault().until_s});
    std::ranges::copy_if(dead_s_, std::back_inserter(turns), [](double time_s) { return time_s < 1e11; });
    return turns;
  }

 private:
  LinkState shown(std::size_t from, std::size_t to, double time_s) const {
    if (from == to) return LinkState::blocked;
    if (time_s >= std::min(dead_s_[from], dead_s_[to])) return LinkState::dead;
    if (up_[from * nodes_ + to]) return LinkState::linked;
    const bool cut =
        std::ranges::any_of(cuts_, [&](const Cut& one) { return one.is_active(time_s) && one.parts(from, to); });
    return cut ? LinkState::cut : LinkState::blocked;
  }

  const std::size_t nodes_;
  std::vector<bool> up_;
  std::vector<double> dead_s_;  ///< by node: time of its UAV's first collision [s]; 1e12: none
  std::vector<Cut> cuts_;
};

}  // namespace

std::vector<std::pair<double, LinkStates>> recorded_links(const results::RunRecord& run) {
  std::multimap<double, const results::EventRow*> changes;
  for (const results::EventRow& event : run.events) {
    if (event.is_of_a_link()) changes.emplace(event.time_s, &event);
  }
  std::vector<std::pair<double, LinkStates>> told;
  if (changes.empty()) return told;
  Links links(run);
  for (const double time_s : links.turns()) changes.emplace(time_s, nullptr);
  for (auto change = changes.begin(); change != changes.end();) {
    const double time_s = change->first;
    for (; change != changes.end() && change->first == time_s; ++change) {
      if (change->second == nullptr) continue;
      const auto from = node_of(run, change->second->subject), to = node_of(run, change->second->object);
      if (from && to) links.set(*from, *to, change->second->event == run_tables::kLinkUp);
    }
    LinkStates now = links.shown(time_s);
    if (told.empty() || told.back().second != now) told.emplace_back(time_s, std::move(now));
  }
  return told;
}

std::string digits_of(const LinkStates& row_major) {
  std::string digits;
  for (const LinkState link : row_major) digits += static_cast<char>('0' + static_cast<int>(link));
  return digits;
}

bool has_cuts(const results::RunRecord& run) { return std::ranges::any_of(run.faults, cuts); }

}  // namespace skein::report
