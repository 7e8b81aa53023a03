#include "uav_agent/agent_program.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>
#include <set>

#include "bus/lockstep/names.hpp"
#include "bus/program_bus.hpp"
#include "core/planners/free_nodes.hpp"
#include "core/planners/hand_spec.hpp"
#include "core/planners/python_spec.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/text.hpp"
#include "core/topics.hpp"
#include "process/files/atomic_file.hpp"
#include "process/log_time.hpp"
#include "process/reports/program_report.hpp"
#include "process/reports/reports.hpp"
#include "uav_agent/agent_node.hpp"
#include "uav_agent/ground_node.hpp"
#include "uav_agent/python/python_planner.hpp"
#include "uav_agent/radio_node.hpp"
#include "uav_agent/stand_in_node.hpp"

namespace skein::agent {
namespace {

/// Bounds of --maps-every. Chosen: a step, and the longest mission.
constexpr double kLeastMapsPeriod_s = 0.05, kMostMapsPeriod_s = 36000.0;

/// For the launcher and for people: which strategies there are, and which have a program at the ground station.
int list_strategies() {
  const StrategyList list{planner_names(), ground_program_names()};
  std::cout << json_of(list).dump() << std::endl;
  return kExitDone;
}

/// @throws InputError if sim_server would not read all debug values that the planner names: the fleet would wait for
/// the planner in vain.
void check_debug_names(const std::vector<std::string>& names, const std::string& planner, const std::string& uav) {
  for (const std::string& name : names) {
    if (topics::debug_name(topics::debug(uav, name).name, uav).empty()) {
      throw InputError(uav + "'s planner " + planner + ": debug name '" + name +
                       "' cannot be part of a topic name: letters, digits and _, a letter first, and together at most "
                       "255 characters");
    }
  }
  if (std::set<std::string>(names.begin(), names.end()).size() > topics::kMostDebugNames) {
    throw InputError(uav + "'s planner " + planner + ": " + std::to_string(names.size()) + " debug names, from '" +
                     names.front() + "' on; at most " + std::to_string(topics::kMostDebugNames) + " are read");
  }
}

/// @throws InputError
void check_maps_period(double period_s) {
  if (period_s >= kLeastMapsPeriod_s && period_s <= kMostMapsPeriod_s) return;
  throw InputError("--maps-every " + shortest(period_s) + ": must be within [" + shortest(kLeastMapsPeriod_s) + ", " +
                   shortest(kMostMapsPeriod_s) + "] s");
}

/// @throws InputError for options that only the software of a UAV with a planner obeys.
void check_planner_options(bool has_planner, bool keeps_maps, bool debugs, bool times_parts) {
  if (has_planner || (!keeps_maps && !debugs && !times_parts)) return;
  throw InputError(std::string(keeps_maps ? "--maps-every"
                               : debugs   ? "--pdb"
                                          : "--time-parts") +
                   ": this program flies no UAV with a planner (--role gcs, or --planner " + std::string(kFreeNodes) +
                   ")");
}

/// Makes a planner that is written in C++ or in Python.
std::unique_ptr<Planner> planner_of(const std::string& spec, const Scenario& scenario, UavIndex uav, std::uint64_t seed,
                                    const std::optional<double>& pdb_from_s) {
  if (!python_spec(spec)) {
    if (pdb_from_s) throw InputError("--pdb: planner " + spec + " is not written in Python");
    return make_planner(spec, agent_config(scenario, uav));
  }
  const RadioNode radio(scenario, node_of_uav(uav));
  return make_python_planner(
      spec, agent_config(scenario, uav),
      {.seed = seed, .radio_topics = {radio.topics().begin(), radio.topics().end()}, .debug_from_s = pdb_from_s});
}

/// The debug names of a UAV that ROS 2 nodes fly: the nodes name no values themselves.
std::vector<std::string> debug_names_of_environment(const std::string& uav) {
  const char* const variable = std::getenv(kDebugValuesVariable);
  std::vector<std::string> names = split(variable == nullptr ? "" : variable, ' ');
  std::erase(names, "");
  check_debug_names(names, std::string(kFreeNodes), uav);
  return names;
}

class AgentMember final : public bus::FleetMember {
 public:
  /// @param scenario, bus  the node refers to them. @param steps_alone  an external program steps the planner.
  AgentMember(const ProgramOptions& options, std::string planner, StatusPipe& status,
              std::shared_ptr<const Scenario> scenario, std::unique_ptr<bus::Bus> bus, std::unique_ptr<MemberNode> node,
              bool steps_alone)
      : dds_(options.dds),
        planner_(std::move(planner)),
        beside_(!steps_alone && !python_spec(planner_)),  // an interpreter has one thread at a time
        status_(status),
        scenario_(std::move(scenario)),
        bus_(std::move(bus)),
        node_(std::move(node)),
        report_(options.out / run_folder::report_file(programs::agent_program(node_->member()))),
        map_(options.out / run_folder::map_file(node_->member())) {
    withdraw_report(report_);
    withdraw_report(map_);
  }

  bus::LockstepNode& node() override { return *node_; }
  bus::Bus& bus() override { return *bus_; }
  bool flies_beside() const override { return beside_; }

  std::optional<int> ended(bus::NodeEnd end) override {
    const int code = bus::exit_code(end, node_->member());
    if (node_->came_too_late()) return code;
    const auto map = node_->octomap_file();
    const std::string no_map = map ? write_if_possible(map_, *map) : "", no_maps = node_->end_maps();
    const CpuHistogram& cpu = node_->planner_cpu();
    constexpr double kMs = 1e3, kShare = 0.99;  // format of the report: milliseconds, and which quantile
    AgentReport report{.planner_cpu_s = cpu.total_s(),
                       .planner_cpu_p99_ms = kMs * cpu.quantile_s(kShare),
                       .planner_cpu_max_ms = kMs * cpu.max_s(),
                       .planner_exchanges_over_50ms = cpu.over_field_exchange(),
                       .waited_s = node_->waited_s(),
                       .waits = node_->waits(),
                       .no_way = node_->no_ways(),
                       .from_nodes = node_->from_nodes(),
                       .safety_filter = node_->safety_filter(),
                       .planner_parts = node_->planner_parts(),
                       .malformed = node_->malformed(),
                       .unsent = node_->unsent(),
                       .planner = planner_,
                       .dds = dds_};
    std::vector<std::string> unwritten = {no_map, no_maps};
    std::erase(unwritten, "");
    if (!unwritten.empty()) report.unwritten = std::move(unwritten);
    hand_in_report(json_of(report), report_, status_);
    return code;
  }

 private:
  const std::string dds_, planner_;
  const bool beside_;
  StatusPipe& status_;
  const std::shared_ptr<const Scenario> scenario_;
  const std::unique_ptr<bus::Bus> bus_;
  const std::unique_ptr<MemberNode> node_;
  const std::filesystem::path report_, map_;
};

}  // namespace

void AgentProgram::add_options(CLI::App& app) {
  app.description("Skein: on-board software of a UAV, or a program at the ground station");
  app.add_option("--role", role_, "uav, or gcs: the strategy's program at the ground station")
      ->check(CLI::IsMember({"uav", "gcs"}))
      ->capture_default_str();
  app.add_option("--uav", uav_, "UAV whose software this is (default: the first of the fleet)");
  app.add_option("--planner", planner_, "NAME or NAME:key=value,... or NAME:file.yaml; NAME may be py:FILE[:CLASS]");
  app.add_option("--maps-every", maps_every_s_,
                 "Keep the UAV's map in maps-UAV.mcap: interval of the snapshots in simulated time [s]");
  app.add_flag("--time-parts", times_parts_, "Time the parts of the planner's work, for the report")->group("Launcher");
  app.add_option("--pdb", pdb_from_s_,
                 "Run Python's debugger in this terminal, which stops from this simulated time on [s]")
      ->group("Launcher");
  app.add_flag("--list-planners", list_, "Print the strategies' names as JSON, then stop");
}

std::variant<int, std::unique_ptr<bus::FleetMember>> AgentProgram::prepare(const ProgramOptions& options,
                                                                           StatusPipe& status) {
  if (list_) return list_strategies();
  show_log_time(*spdlog::default_logger());
  if (maps_every_s_) check_maps_period(*maps_every_s_);
  std::shared_ptr<const Scenario> scenario = scenarios_->load(options.scenario, options.load_options_without_scene());
  const UavIndex uav = scenario->uav_index(uav_.empty() ? scenario->fleet.front().name : uav_);
  std::unique_ptr<GroundProgram> ground;
  std::unique_ptr<Planner> planner;
  std::vector<std::string> debug_names;
  const bool stands_in = role_ != "gcs" && planner_ == kFreeNodes;
  check_planner_options(role_ != "gcs" && !stands_in, maps_every_s_.has_value(), pdb_from_s_.has_value(), times_parts_);
  if (role_ == "gcs" && !uav_.empty())
    throw InputError("--uav " + uav_ + ": a program at the ground station has no UAV");
  if (role_ == "gcs") {
    ground = make_ground_program(planner_, ground_config(*scenario));
  } else if (stands_in) {
    debug_names = debug_names_of_environment(scenario->fleet[uav].name);
  } else {
    planner = planner_of(planner_, *scenario, uav, options.seed, pdb_from_s_);
    check_debug_names(planner->debug_names(), planner_, scenario->fleet[uav].name);
  }
  if (!options.check_only) options.check_out();
  auto bus = bus::make_bus(options, *scenario, 1);  // 1: only the domain of this UAV or station
  if (options.check_only) return kExitDone;
  std::unique_ptr<MemberNode> node;
  Learner* const learner = planner ? planner->learner() : nullptr;
  if (learner != nullptr && !desk_) {
    throw InputError("--planner " + scenario->fleet[uav].name + "=" + planner_ +
                     ": a learner needs a program that steps the fleet: skein.Fleet(learners=[\"" +
                     scenario->fleet[uav].name + "\"]) in Python");
  }
  if (ground) {
    node = std::make_unique<GroundNode>(*scenario, std::move(ground), options.domain, *bus);
  } else if (stands_in) {
    node = std::make_unique<StandInNode>(*scenario, uav, options.domain, *bus, debug_names);
  } else {
    auto on_board = std::make_unique<AgentNode>(*scenario, uav, std::move(planner), options.domain, *bus, frames_,
                                                wants_hands(planner_));
    if (times_parts_) on_board->time_parts();
    if (maps_every_s_) {
      on_board->keep_maps(std::make_unique<KeptMaps>(options.out, scenario->fleet[uav].name, ticks(*maps_every_s_)));
    }
    if (learner != nullptr) {
      desk_->enter(scenario->fleet[uav].name, *learner);
      on_board->step_by(*desk_);
    }
    node = std::move(on_board);
  }
  return std::make_unique<AgentMember>(options, planner_, status, std::move(scenario), std::move(bus), std::move(node),
                                       learner != nullptr);
}

}  // namespace skein::agent
