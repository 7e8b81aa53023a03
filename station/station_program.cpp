#include "station/station_program.hpp"

#include <CLI/CLI.hpp>

#include "bus/program_bus.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "process/reports/program_report.hpp"
#include "results/run_folder.hpp"
#include "station/settlement.hpp"
#include "station/station_node.hpp"

namespace skein::station {
namespace {

class StationMember final : public bus::FleetMember {
 public:
  StationMember(Scenario scenario, const ProgramOptions& options, StatusPipe& status, std::unique_ptr<bus::Bus> bus,
                std::optional<ReadyView> view, std::shared_ptr<ScoreView> score)
      : scenario_(std::move(scenario)),
        options_(options),
        status_(status),
        bus_(std::move(bus)),
        view_(std::move(view)),
        score_(std::move(score)),
        recorder_(options_.out, programs::kStation, recording::scope_of(options_.record)) {
    withdraw_report(options_.out / run_folder::report_file(programs::kStation));
    make_node();
  }

  bus::LockstepNode& node() override { return *node_; }
  bus::Bus& bus() override { return *bus_; }
  void vanish() override {
    node_->stop_serving();
    FleetMember::vanish();
  }

  // Starts a new node after a fault that stopped the station: it continues from the journal.
  std::optional<int> ended(bus::NodeEnd end) override {
    keep_notes();
    if (end == bus::NodeEnd::resumed) {
      make_node();
      return std::nullopt;
    }
    recorder_.close();
    if (!recorder_.write_error().empty()) add_new({recorder_.write_error()}, notes_.unwritten);
    if (!node_->came_too_late()) node_->write_report(notes_);
    return bus::exit_code(end, programs::kStation);
  }

 private:
  void make_node() {
    node_.reset();
    node_.emplace(scenario_, options_.domain, *bus_, options_.out, status_, &recorder_, view_ ? &*view_ : nullptr,
                  score_);
  }

  /// Adds the facts of the present node, which has ended, to those of the nodes before it.
  void keep_notes() {
    const StationNotes notes = node_->notes();
    notes_.malformed += notes.malformed;
    notes_.unsent += notes.unsent;
    add_new(notes.unwritten, notes_.unwritten);
  }

  const Scenario scenario_;
  const ProgramOptions options_;
  StatusPipe& status_;
  const std::unique_ptr<bus::Bus> bus_;
  const std::optional<ReadyView> view_;
  const std::shared_ptr<ScoreView> score_;
  recording::Recorder recorder_;
  StationNotes notes_{.dds = options_.dds};  ///< of all nodes until now
  std::optional<StationNode> node_;
};

}  // namespace

void StationProgram::add_options(CLI::App& app) {
  app.description("Skein: the ground station of a fleet, which counts what is delivered");
  app.add_flag("--settle", settle_only_, "Write the report of a station that died in this folder, then stop")
      ->group("Launcher");
  app.add_option("--view-fd", view_.listener, "File descriptor of a socket to which browsers connect")
      ->group("Launcher");
  app.add_option("--view-listen", view_.listen, "NAME:PORT, instead of such a socket: the station listens there")
      ->group("Launcher");
  app.add_option("--view-name", view_.names, "Name by which browsers may ask for the page")
      ->allow_extra_args(false)
      ->group("Launcher");
  app.add_option("--view-key", view_.key, "File with the key of the page")->group("Launcher");
  app.add_option("--view-script", view_.script, "File with the script of the page")->group("Launcher");
  app.add_option("--view-title", view_.title, "Title of the page")->group("Launcher");
}

std::variant<int, std::unique_ptr<bus::FleetMember>> StationProgram::prepare(const ProgramOptions& options,
                                                                             StatusPipe& status) {
  Scenario scenario = load_scenario(options.scenario, options.load_options_without_scene());
  if (!options.check_only) options.check_out();
  if (settle_only_) {
    settle(options.out, scenario, options.run, status);
    return kExitDone;
  }
  auto bus = bus::make_bus(options, scenario, 2);  // GCS and world
  if (options.check_only) return kExitDone;
  std::optional<ReadyView> view;
  if (view_.listener >= 0 || !view_.listen.empty()) view.emplace(view_);
  return std::make_unique<StationMember>(std::move(scenario), options, status, std::move(bus), std::move(view), score_);
}

}  // namespace skein::station
