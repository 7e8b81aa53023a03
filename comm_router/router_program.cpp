#include "comm_router/router_program.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <system_error>

#include "bus/program_bus.hpp"
#include "comm_router/router_node.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/topics.hpp"
#include "process/files/nowhere.hpp"
#include "process/reports/program_report.hpp"
#include "process/reports/reports.hpp"

namespace skein::router {
namespace {

/// Facts for the report besides the counts.
struct Notes {
  std::uint64_t malformed = 0, unheard = 0, unsent = 0;
  std::vector<std::string> warnings = {};
  std::vector<std::string> unwritten = {};  ///< files that could not be written
  std::optional<std::vector<std::string>> differences = {};
};

RadioCounts radio_counts(const LinkCounts& counts) {
  return {.sent = counts.sent,
          .delivered = counts.delivered,
          .dropped_no_los = counts.dropped_no_los,
          .dropped_fault = counts.dropped_fault,
          .dropped_overflow = counts.dropped_overflow,
          .duplicated = counts.duplicated,
          .corrupted = counts.corrupted,
          .sent_bytes = counts.sent_bytes,
          .delivered_bytes = counts.delivered_bytes};
}

std::filesystem::path report_of(const ProgramOptions& options) {
  return options.out / run_folder::report_file(programs::kCommRouter);
}

void write_report(const ProgramOptions& options, const Scenario& scenario, const LinkGate& gate, const Notes& notes,
                  StatusPipe& status) {
  RouterReport report{.total = radio_counts(gate.total()),
                      .malformed = notes.malformed,
                      .unheard = notes.unheard,
                      .unsent = notes.unsent,
                      .dds = options.dds,
                      .warnings = notes.warnings,
                      .unwritten = notes.unwritten,
                      .differences = notes.differences};
  // In a large fleet, nearly all of the million links never have line of sight: only the others are listed.
  const bool large = scenario.fleet.size() > kMostUavsOverDds;
  for (const Node from : gate.nodes()) {
    for (const Node to : gate.nodes()) {
      const LinkCounts& counts = gate.counts().at(from, to);
      if (counts.sent == 0 || (large && counts.sent == counts.dropped_no_los)) continue;
      report.per_link.push_back(
          {.from = scenario.node_name(from), .to = scenario.node_name(to), .counts = radio_counts(counts)});
    }
  }
  hand_in_report(json_of(report), report_of(options), status);
}

/// Writes the report of a router that died for good, from the counts that it left on disk.
int settle(const ProgramOptions& options, const Scenario& scenario, StatusPipe& status) {
  const std::filesystem::path counts = options.out / run_folder::kCounts;
  const std::vector<RadioRoute> no_routes;
  const std::size_t nodes = scenario.fleet.size() + 1;
  LinkGate gate(no_routes, nodes);
  gate.restore(CountStore(counts, nodes, options.run).earlier_counts());
  write_report(options, scenario, gate, {}, status);
  std::filesystem::remove(counts);
  return kExitDone;
}

/// If the file cannot be opened, the router works without it, but loses its counts when it is killed.
void open_counts(std::optional<CountStore>& store, const std::filesystem::path& file, std::size_t nodes, RunId run,
                 std::vector<std::string>& unwritten) try {
  store.emplace(file, nodes, run);
} catch (const std::system_error& error) {
  spdlog::warn("{}; if the router is killed, its counts are lost", error.what());
  unwritten.push_back(error.what());
}

class RouterMember final : public bus::FleetMember {
 public:
  RouterMember(Scenario scenario, FaultPlan faults, const ProgramOptions& options, StatusPipe& status,
               std::unique_ptr<bus::Bus> bus, const recording::ReplayOptions& replay,
               std::vector<std::string> stand_ins)
      : scenario_(std::move(scenario)),
        faults_(std::move(faults)),
        options_(options),
        counts_file_(options.out / run_folder::kCounts),
        status_(status),
        bus_(std::move(bus)),
        replay_(replay),
        stand_ins_(std::move(stand_ins)),
        recorder_(options_.out, programs::kCommRouter, recording::scope_of(options_.record)) {
    withdraw_report(report_of(options_));
    make_node();
  }

  bus::LockstepNode& node() override { return *node_; }
  bus::Bus& bus() override { return *bus_; }

  // Starts a new node after a fault that stopped the router: messages that waited in it are lost, as after its death.
  std::optional<int> ended(bus::NodeEnd end) override {
    keep_notes();
    if (end == bus::NodeEnd::resumed) {
      make_node();
      return std::nullopt;
    }
    const int code = bus::exit_code(end, programs::kCommRouter);
    recorder_.close();
    if (!recorder_.write_error().empty()) add_new({recorder_.write_error()}, notes_.unwritten);
    write_report(options_, scenario_, node_->gate(), notes_, status_);
    if (!is_nowhere(counts_file_)) std::filesystem::remove(counts_file_);
    return code;
  }

 private:
  void make_node() {
    node_.reset();
    store_.reset();
    std::vector<std::string> unwritten;
    open_counts(store_, counts_file_, scenario_.fleet.size() + 1, options_.run, unwritten);
    add_new(unwritten, notes_.unwritten);
    node_.emplace(scenario_, options_.seed, options_.domain, *bus_, faults_, options_.out);
    if (store_) node_->keep_counts(*store_);
    node_->record_with(recorder_);
    node_->expect_stand_ins(stand_ins_);
    if (replay_.active()) node_->replay(replay_);
  }

  /// Adds the facts of the present node, which has ended, to those of the nodes before it.
  void keep_notes() {
    notes_.malformed += node_->malformed();
    notes_.unheard += node_->unheard();
    notes_.unsent += node_->unsent();
    add_new(node_->warnings(), notes_.warnings);
    add_new(node_->unwritten(), notes_.unwritten);
    if (store_ && !store_->write_error().empty()) add_new({store_->write_error()}, notes_.unwritten);
    if (const auto differences = node_->differences()) {
      if (!notes_.differences) notes_.differences.emplace();
      add_new(*differences, *notes_.differences);
    }
  }

  const Scenario scenario_;
  const FaultPlan faults_;
  const ProgramOptions options_;
  const std::filesystem::path counts_file_;
  StatusPipe& status_;
  const std::unique_ptr<bus::Bus> bus_;
  const recording::ReplayOptions replay_;
  const std::vector<std::string> stand_ins_;
  recording::Recorder recorder_;
  Notes notes_;  ///< of all nodes until now
  std::optional<CountStore> store_;
  std::optional<RouterNode> node_;
};

}  // namespace

void RouterProgram::add_options(CLI::App& app) {
  app.description("Skein: delivers radio messages between the UAVs of a fleet");
  app.add_flag("--settle", settle_only_, "Write the report of a router that died in this folder, then stop")
      ->group("Launcher");
  app.add_option("--stand-ins", stand_ins_, "UAVs whose agent passes on the messages of programs outside the lock-step")
      ->delimiter(',');
  recording::add_replay_options(app, replay_);
}

std::variant<int, std::unique_ptr<bus::FleetMember>> RouterProgram::prepare(const ProgramOptions& options,
                                                                            StatusPipe& status) {
  Scenario scenario = load_scenario(options.scenario, options.load_options_without_scene());
  FaultPlan faults = load_fault_plan(options.faults, scenario, options.seed);
  if (!options.check_only) options.check_out();
  if (settle_only_) return settle(options, scenario, status);
  auto bus = bus::make_bus(options, scenario, domain_names(scenario).size());
  if (options.check_only) return kExitDone;
  return std::make_unique<RouterMember>(std::move(scenario), std::move(faults), options, status, std::move(bus),
                                        replay_, stand_ins_);
}

}  // namespace skein::router
