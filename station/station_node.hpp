// The station as a process: takes capture reports from the radio, compares them with the referee's ledger, tallies,
// journals, acknowledges.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/client_node.hpp"
#include "core/scenario/scenario.hpp"
#include "core/topics.hpp"
#include "process/status/status_pipe.hpp"
#include "recording/recorder.hpp"
#include "station/journal.hpp"
#include "station/point_names.hpp"
#include "station/score_view.hpp"
#include "station/scoreboard.hpp"
#include "station/station_report.hpp"
#include "station/view_node.hpp"

namespace skein::station {

class StationNode final : public bus::ClientNode {
 public:
  /// @param out  folder of the journal; if it has records of this run, a restarted station continues from them.
  /// @param recorder  records the tally, and the score topics; must outlive this. nullptr: nothing is recorded.
  /// @param view  the page to serve to browsers; nullptr: none.
  /// @param score  gets a pointer to the tally, for other code in this process; nullptr: none needs it.
  StationNode(const Scenario& scenario, int base_domain, bus::Bus& bus, const std::filesystem::path& out,
              StatusPipe& status, recording::Recorder* recorder = nullptr, const ReadyView* view = nullptr,
              std::shared_ptr<ScoreView> score = nullptr);
  ~StationNode() override;

  bus::Inbox& inbox() override { return inbox_; }
  /// Facts for the report that are not in the scoreboard, without those of earlier nodes.
  StationNotes notes() const;
  /// When the station's part in the run is over: writes its result files (station_report.hpp), unless it never received
  /// the number of points. @param notes  of all its nodes
  void write_report(StationNotes notes);
  /// Ends the page at once, as if the process were killed: browsers get nothing more.
  void stop_serving();

 private:
  bus::LockstepClient& client() override { return client_; }
  /// A writer in the GCS domain; the recorder, if any, records what it writes.
  bus::CountedWriter heard_writer(const topics::WireTopic& topic);
  void think() override;
  bool answered_last() const override { return last_step_answered_; }
  void on_reports(std::size_t source, const msg::CaptureReports& reports);
  void on_ledger(const msg::Ledger& ledger);
  void open_scoreboard(std::size_t points);
  void acknowledge(const StepOutcome& outcome);
  void show_score(Tick tick);
  void record_tally(Tick tick);
  void show_to_viewers(Tick tick);
  void tell(bool now);

  const Scenario& scenario_;
  const std::filesystem::path out_;
  StatusPipe& status_;
  recording::Recorder* const recorder_;
  std::vector<std::string> uavs_;
  Journal journal_;
  std::vector<std::string> unwritten_;  ///< files that the disk refused, one sentence each
  const std::shared_ptr<ScoreView> score_view_;
  std::optional<Scoreboard> scoreboard_;  ///< from the first message of the ledger on: it has the number of points
  std::vector<InterestPoint> points_;     ///< from the ledger; empty: not received yet
  PointNames names_;
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> world_, gcs_;
  std::unique_ptr<bus::Reader> ledger_reader_;
  bus::CountedWriter score_, score_eval_;
  std::unique_ptr<bus::Writer> viz_scored_;
  bool viz_stale_ = true;  ///< the tally has changed since viewers were last shown it
  Tick viz_due_ = 0;
  bus::LockstepClient client_;
  std::unique_ptr<ViewNode> view_;  ///< null: there is no page
  bool last_step_answered_ = false;
  std::chrono::steady_clock::time_point told_{};
};

}  // namespace skein::station
