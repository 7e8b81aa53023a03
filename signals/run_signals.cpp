#include "signals/run_signals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"

namespace skein::signals {
namespace {

std::size_t exchanges_of(const results::RunRecord& run, const Scenario& scenario) {
  const double end_s = value_or(run.result, "sim_time_s", 0.0);
  return static_cast<std::size_t>(std::llround(end_s / scenario.exchange_period_s)) + 1;
}

/// Whether a fault kills a UAV's program for good. False for the station and the router: without them, the fleet cannot
/// do what properties demand after the faults.
bool is_death_for_good(const Json& fault, const Scenario& scenario) {
  if (value_or(fault, "kind", "") != "kill" || value_or(fault, "until_s", nullptr).is_number()) return false;
  const Json target = value_or(fault, "target", nullptr);
  const std::vector<std::string> uavs = scenario.uav_names();
  return std::ranges::any_of(uavs, [&](const std::string& uav) { return target == uav; });
}

}  // namespace

FolderSignals::FolderSignals(const results::RunRecord& run, const Scenario& scenario,
                             const results::RunRecord* undisturbed, const FaultPlan* faults)
    : run_(run),
      scenario_(scenario),
      undisturbed_(undisturbed),
      faults_(faults),
      exchanges_(exchanges_of(run, scenario)) {}

std::optional<double> FolderSignals::healed_s() const {
  double healed_s = 0.0;
  for (const Json& fault : value_or(run_.result, "faults", Json::array())) {
    if (!value_or(fault, "began_step", nullptr).is_number()) continue;
    Json ended = value_or(fault, "ended_step", nullptr);
    // A permanent death counts as ended at once: nothing changes afterwards, so properties can ask for what follows.
    if (!ended.is_number() && is_death_for_good(fault, scenario_)) ended = fault["began_step"];
    if (!ended.is_number()) return std::nullopt;
    healed_s = std::max(healed_s, ended.get<double>() * period_s());
  }
  return healed_s;
}

const std::vector<double>& FolderSignals::values(const SignalUse& signal) {
  const std::string name = signal.text();
  const auto found = known_.find(name);
  return found != known_.end() ? found->second : known_.emplace(name, work_out(signal)).first->second;
}

bool is_comparison(const SignalUse& signal) {
  return signal.info->name.starts_with("undisturbed_") || signal.is("work_at_failure") || signal.is("taken_over") ||
         signal.is("missed");
}

FolderSignals::Values FolderSignals::work_out(const SignalUse& signal) {
  if (signal.is("result")) return result(signal);
  if (signal.is("debug")) return debug(signal);
  if (signal.is("separation")) return separation(signal);
  if (signal.is("without_work")) return without_work(signal.argument(0));
  for (const char* name : {"member", "restarts", "leaves", "link", "faults", "time"}) {
    if (signal.is(name)) return of_members(signal);
  }
  for (const char* name : {"x", "y", "z", "speed", "distance", "clearance", "charge", "alive"}) {
    if (signal.is(name)) return of_fleet(signal);
  }
  for (const char* name : {"sent", "arrived", "arrived_once", "arrived_over_open_link", "in_flight"}) {
    if (signal.is(name)) return of_messages(signal);
  }
  if (signal.is("undisturbed_distance")) return way_flown(tracks_of(undisturbed(signal)), signal.argument(0));
  if (is_comparison(signal)) return of_work(signal);
  return of_captures(signal);
}

std::size_t FolderSignals::exchange_at(double time_s) const {
  const auto exchange = static_cast<std::size_t>(std::max(0.0, std::ceil(time_s / period_s() - 1e-6)));
  return std::min(exchange, exchanges_ - 1);
}

FolderSignals::Values FolderSignals::counted(const std::vector<std::size_t>& exchanges) const {
  Values values(exchanges_, 0.0);
  for (const std::size_t exchange : exchanges) {
    if (exchange < exchanges_) ++values[exchange];
  }
  for (std::size_t k = 1; k < exchanges_; ++k) values[k] += values[k - 1];
  return values;
}

// ---- the fleet --------------------------------------------------------------------------------------------------

const std::map<std::string, FolderSignals::Track>& FolderSignals::tracks() {
  if (tracks_.empty()) tracks_ = tracks_of(run_);
  return tracks_;
}

/// trajectories.csv has a row of each UAV every other exchange; in between, the values stay as they were.
std::map<std::string, FolderSignals::Track> FolderSignals::tracks_of(const results::RunRecord& run) const {
  std::map<std::string, Track> tracks;
  for (const std::string& name : scenario_.uav_names()) {
    tracks[name] = {std::vector<Vector3d>(exchanges_, Vector3d::Zero()),
                    std::vector<Vector3d>(exchanges_, Vector3d::Zero()), constant(1.0), constant(kFarClearance_m),
                    constant(1.0)};
  }
  const double end_s = (static_cast<double>(exchanges_) - 0.5) * period_s();  // another run may have lasted longer
  std::map<std::string, std::size_t> next;                                    // first exchange without values
  for (const results::PoseRow& row : run.poses) {
    const auto track = tracks.find(row.uav);
    if (track == tracks.end() || row.time_s > end_s) continue;
    const std::size_t exchange = exchange_at(row.time_s);
    std::size_t& from = next[row.uav];
    auto& [positions, velocities, alive, clearance, charge] = track->second;
    for (; from < exchange && from > 0; ++from) {
      positions[from] = positions[from - 1];
      velocities[from] = velocities[from - 1];
      alive[from] = alive[from - 1];
      clearance[from] = clearance[from - 1];
      charge[from] = charge[from - 1];
    }
    positions[exchange] = row.p_W;
    velocities[exchange] = row.v_W;
    alive[exchange] = row.alive ? 1.0 : 0.0;
    clearance[exchange] = row.clearance_m.value_or(kFarClearance_m);
    charge[exchange] = row.charge.value_or(1.0);
    from = exchange + 1;
  }
  for (auto& [name, track] : tracks) {
    for (std::size_t k = next[name]; k < exchanges_ && k > 0; ++k) {
      track.positions[k] = track.positions[k - 1];
      track.velocities[k] = track.velocities[k - 1];
      track.alive[k] = track.alive[k - 1];
      track.clearance[k] = track.clearance[k - 1];
      track.charge[k] = track.charge[k - 1];
    }
  }
  // A collision may lie between two rows of the table, or after its last one.
  for (const Json& collision : value_or(run.result, "collisions", Json::array())) {
    const auto track = tracks.find(text_in(collision, "uav"));
    const double time_s = value_or(collision, "time_s", 0.0);
    if (track == tracks.end() || time_s > end_s) continue;
    Values& alive = track->second.alive;
    std::fill(alive.begin() + static_cast<std::ptrdiff_t>(exchange_at(time_s)), alive.end(), 0.0);
  }
  return tracks;
}

FolderSignals::Values FolderSignals::way_flown(const std::map<std::string, Track>& tracks,
                                               const std::string& uav) const {
  Values values = constant(0.0);
  for (const auto& [name, track] : tracks) {
    if (!uav.empty() && name != uav) continue;
    double way_m = 0.0;
    for (std::size_t k = 1; k < exchanges_; ++k) {
      way_m += (track.positions[k] - track.positions[k - 1]).norm();
      values[k] += way_m;
    }
  }
  return values;
}

FolderSignals::Values FolderSignals::of_fleet(const SignalUse& signal) {
  const auto& all = tracks();
  const std::string uav = signal.argument(0);
  if (signal.is("distance")) return way_flown(all, uav);
  if (signal.is("clearance") && uav.empty()) {
    Values least = constant(kFarClearance_m);
    for (const auto& [name, track] : all) {
      for (std::size_t k = 0; k < exchanges_; ++k) {
        if (track.alive[k] > 0.0) least[k] = std::min(least[k], track.clearance[k]);
      }
    }
    return least;
  }
  Values values = constant(0.0);
  for (const auto& [name, track] : all) {
    if (!uav.empty() && name != uav) continue;
    if (signal.is("clearance")) return track.clearance;
    if (signal.is("charge")) return track.charge;
    if (signal.is("alive")) return track.alive;
    for (std::size_t k = 0; k < exchanges_; ++k) {
      const Vector3d& p_W = track.positions[k];
      values[k] += signal.is("x")   ? p_W.x()
                   : signal.is("y") ? p_W.y()
                   : signal.is("z") ? p_W.z()
                                    : track.velocities[k].norm();
    }
  }
  return values;
}

FolderSignals::Values FolderSignals::separation(const SignalUse& signal) {
  Values least = constant(std::numeric_limits<double>::infinity());
  const std::string one = signal.argument(0), other = signal.argument(1);
  for (const auto& [name_a, a] : tracks()) {
    for (const auto& [name_b, b] : tracks()) {
      const auto concerns = [&](const std::string& name) { return name.empty() || name == name_a || name == name_b; };
      if (name_a >= name_b || !concerns(one) || !concerns(other)) continue;
      for (std::size_t k = 0; k < exchanges_; ++k) {
        if (a.alive[k] == 0.0 || b.alive[k] == 0.0) continue;
        least[k] = std::min(least[k], (a.positions[k] - b.positions[k]).norm());
      }
    }
  }
  return least;
}

// ---- members, links, faults -------------------------------------------------------------------------------------

/// 1 from each event `on` with this subject and object until their next event `off`; otherwise 0.
FolderSignals::Values FolderSignals::on_off(const std::string& on, const std::string& off, const std::string& subject,
                                            const std::string& object) const {
  Values values = constant(0.0);
  for (const results::EventRow& row : run_.events) {
    const bool turns_on = row.event == on;
    if ((!turns_on && row.event != off) || row.subject != subject || row.object != object) continue;
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(row.step, exchanges_)), values.end(),
              turns_on ? 1.0 : 0.0);
  }
  return values;
}

FolderSignals::Values FolderSignals::of_members(const SignalUse& signal) {
  const std::string subject = signal.argument(0);
  if (signal.is("member")) return on_off(run_tables::kJoined, run_tables::kLeft, subject, "");
  if (signal.is("link")) return on_off(run_tables::kLinkUp, run_tables::kLinkDown, subject, signal.argument(1));
  if (signal.is("time")) {
    Values times;
    for (std::size_t k = 0; k < exchanges_; ++k) times.push_back(static_cast<double>(k) * period_s());
    return times;
  }
  if (signal.is("restarts") || signal.is("leaves")) {
    const bool joins = signal.is("restarts");
    std::vector<std::size_t> steps;
    std::set<std::string> known;  // the first time that a program joins is not a restart
    for (const results::EventRow& row : run_.events) {
      const bool is_meant = row.event == (joins ? run_tables::kJoined : run_tables::kLeft);
      if (!is_meant || (!subject.empty() && row.subject != subject)) continue;
      if (!joins || !known.insert(row.subject).second) steps.push_back(row.step);
    }
    return counted(steps);
  }
  Values in_force = constant(0.0);
  for (const Json& fault : value_or(run_.result, "faults", Json::array())) {
    const Json began = value_or(fault, "began_step", nullptr), ended = value_or(fault, "ended_step", nullptr);
    if (!began.is_number()) continue;
    const std::size_t end = ended.is_number() ? ended.get<std::size_t>() : exchanges_;
    for (std::size_t k = began.get<std::size_t>(); k < std::min(end, exchanges_); ++k) ++in_force[k];
  }
  return in_force;
}

// ---- numbers of result.json, and those of programs --------------------------------------------------------------

FolderSignals::Values FolderSignals::result(const SignalUse& signal) const {
  Json here = run_.result;
  const std::string path = signal.argument(0);
  for (const std::string& key : split(path, '.')) {
    Json next;
    std::vector<std::string> known;
    if (here.is_array()) {  // of objects with names
      for (const Json& one : here) {
        known.push_back(text_in(one, "name"));
        if (known.back() == key) next = one;
      }
    } else if (here.is_object()) {
      for (const auto& [name, value] : here.items()) known.push_back(name);
      if (here.contains(key)) next = here[key];
    }
    if (next.is_null()) {
      throw InputError("result(" + path + "): the run's result has no number '" + key + "'; " + suggestion(key, known));
    }
    here = std::move(next);
  }
  if (here.is_array()) return constant(static_cast<double>(here.size()));
  if (here.is_boolean()) return constant(here.get<bool>() ? 1.0 : 0.0);
  if (!here.is_number()) throw InputError("result(" + path + "): this is not a number of the run's result");
  return constant(here.get<double>() * unit_of_result(path).factor);
}

FolderSignals::Values FolderSignals::debug(const SignalUse& signal) {
  Values values = constant(0.0);
  const auto found = radio().debug.find({signal.argument(0), signal.argument(1)});
  if (found == radio().debug.end()) return values;
  for (const DebugValue& one : found->second) {
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(one.step, exchanges_)), values.end(),
              one.value);
  }
  return values;
}

FolderSignals::Values FolderSignals::without_work(const std::string& uav) const {
  Values values = constant(0.0);
  for (const results::WorkRow& row : run_.work) {
    if (row.uav != uav || row.time_s > end_s()) continue;
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(exchange_at(row.time_s)), values.end(), row.without_work_s);
  }
  return values;
}

const RadioLog& FolderSignals::radio() {
  if (!radio_) radio_ = read_radio_log(run_.dir, scenario_);
  return *radio_;
}

}  // namespace skein::signals
