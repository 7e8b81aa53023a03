// The station as a process: takes capture reports from the radio, compares them with the referee's ledger, tallies,
// journals, acknowledges. Everything happens on the thread that calls run().
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/client_loop.hpp"
#include "core/scenario.hpp"
#include "process/status_pipe.hpp"
#include "station/journal.hpp"
#include "station/point_names.hpp"
#include "station/scoreboard.hpp"

namespace skein::station {

class StationNode {
 public:
  /// @param out  where the journal is; what it holds from an earlier life of this run is taken up again.
  StationNode(const Scenario& scenario, int base_domain, bus::Bus& bus, const std::filesystem::path& out,
              StatusPipe& status);

  /// Takes part until the last step, or until asked to stop; then writes the report.
  /// @returns the program's exit code; nothing when a fault stopped it and is over: go on with a new node.
  std::optional<int> run(const StopSignal& stop);
  /// Makes run() look at `stop`; from any thread.
  void wake() { inbox_.wake(); }

 private:
  void on_reports(std::size_t source, const msg::CaptureReports& reports);
  void on_ledger(const msg::Ledger& ledger);
  void open_scoreboard(std::size_t points);
  void think();
  void acknowledge(const StepOutcome& outcome);
  void show_score(Tick tick);
  void tell(bool now);

  const Scenario& scenario_;
  const std::filesystem::path out_;
  StatusPipe& status_;
  std::vector<std::string> uavs_;
  Journal journal_;
  std::vector<std::string> unwritten_;    ///< what the disk refused, one sentence each
  std::optional<Scoreboard> scoreboard_;  ///< once the ledger told the number of points
  std::vector<InterestPoint> points_;     ///< once it told where they are
  PointNames names_;
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> world_, gcs_;
  std::unique_ptr<bus::Reader> ledger_reader_;
  std::unique_ptr<bus::CountedWriter> score_, score_eval_;
  bus::LockstepClient client_;
  bool last_step_answered_ = false;
  std::chrono::steady_clock::time_point told_{};
};

}  // namespace skein::station
