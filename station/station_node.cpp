#include "station/station_node.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "bus/lockstep/names.hpp"
#include "core/radio/radio_routes.hpp"
#include "idl/conversions.hpp"
#include "process/status/status_lines.hpp"
#include "results/run_folder.hpp"

namespace skein::station {

using bus::LockstepClient;

namespace {

constexpr std::chrono::milliseconds kStatusPeriod{200};
constexpr Tick kVizPeriod = kTicksPerSecond / 10;

}  // namespace

StationNode::StationNode(const Scenario& scenario, int base_domain, bus::Bus& bus, const std::filesystem::path& out,
                         StatusPipe& status, recording::Recorder* recorder, const ReadyView* view,
                         std::shared_ptr<ScoreView> score)
    : scenario_(scenario),
      out_(out),
      status_(status),
      recorder_(recorder),
      uavs_(scenario.uav_names()),
      journal_(out / run_folder::kJournal, bus.run()),
      score_view_(std::move(score)),
      names_(uavs_.size()),
      inbox_(bus.run()),
      world_(bus.join(world_domain(base_domain))),
      gcs_(bus.join(gcs_domain(base_domain))),
      score_(heard_writer(topics::score())),
      score_eval_(heard_writer(topics::score_eval())),
      viz_scored_(world_->create_writer(bus::spec(topics::viz_scored()))),
      client_(*gcs_, inbox_, std::string(bus::kStationName)) {
  ledger_reader_ = bus::subscribe<msg::Ledger>(inbox_, *world_, bus::spec(topics::ledger()),
                                               [this](const msg::Ledger& ledger) { on_ledger(ledger); });
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    client_.read<msg::CaptureReports>(bus::spec(topics::captures_at_station(uavs_[i])),
                                      LockstepClient::Counterpart::router,
                                      [this, i](const msg::CaptureReports& reports) { on_reports(i, reports); });
    client_.declare_writer(bus::spec(topics::captures_ack(uavs_[i])), LockstepClient::Counterpart::router);
  }
  if (recorder_ != nullptr) client_.before_obeying([this] { recorder_->flush(); });
  if (view != nullptr) view_ = std::make_unique<ViewNode>(*view, *world_, inbox_);
  client_.think_when([this](const msg::Step& step) {
    return scoreboard_ && points_.size() == scoreboard_->delivered().points().size() &&
           scoreboard_->has_entries(step.ledger_upto());
  });
}

StationNode::~StationNode() {
  if (score_view_) score_view_->board = nullptr;
}

void StationNode::on_ledger(const msg::Ledger& ledger) {
  if (!scoreboard_) open_scoreboard(ledger.interest_points());
  if (points_.empty()) {
    for (const auto& point : ledger.points()) points_.push_back(from_message(point));
  }
  for (const auto& message : ledger.entries()) {
    if (const auto entry = from_message(message, uavs_)) scoreboard_->add_entry(*entry);
  }
  names_.follow(scoreboard_->ledger());
}

void StationNode::open_scoreboard(std::size_t points) {
  scoreboard_.emplace(uavs_.size(), points, scenario_.rules);
  if (score_view_) score_view_->board = &*scoreboard_;
  for (const TallyRecord& record : journal_.replayed()) scoreboard_->restore(record);
  if (view_) view_->add_records(journal_.replayed());
  if (!journal_.replayed().empty()) spdlog::info("took up {} records of the journal", journal_.replayed().size());
}

void StationNode::on_reports(std::size_t source, const msg::CaptureReports& reports) {
  for (const auto& message : reports.reports()) {
    if (auto report = from_message(message, uavs_)) {
      names_.resolve(*report);
      scoreboard_->add_report(source, std::move(*report));
    } else {
      CaptureReport unreadable;
      unreadable.uav = UavIndex(uavs_.size());
      scoreboard_->add_report(source, std::move(unreadable));
    }
  }
}

void StationNode::think() {
  const msg::Step& step = client_.step();
  const std::uint64_t stood = scoreboard_->standing();
  const StepOutcome outcome = scoreboard_->end_step(step.tick(), step.ledger_upto());
  // If the station is killed for good, the last tally that it reported tells the score earned.
  const bool news = outcome.score_changed || scoreboard_->standing() != stood;
  if (std::string trouble = journal_.append(outcome.records); !trouble.empty()) {
    spdlog::warn("{}; a station that is killed will not remember what it acknowledges from here on", trouble);
    unwritten_.push_back(std::move(trouble));
  }
  const bus::Burst burst(*gcs_);
  acknowledge(outcome);
  if (outcome.score_changed) show_score(step.tick());
  if (news) record_tally(step.tick());
  if (view_) view_->end_step(*scoreboard_, outcome, step.ledger_upto());
  viz_stale_ |= outcome.score_changed;
  show_to_viewers(step.tick());
  client_.done(outcome.digest);
  last_step_answered_ = step.final_step();
  tell(news || last_step_answered_);
}

bus::CountedWriter StationNode::heard_writer(const topics::WireTopic& topic) {
  bus::TopicSpec spec = bus::spec(topic);
  bus::Ear ear = recorder_ != nullptr ? recorder_->ear(scenario_.node_name(kStationNode), spec) : bus::Ear{};
  return {*gcs_, std::move(spec), std::move(ear)};
}

void StationNode::stop_serving() {
  if (view_) view_->stop();
}

void StationNode::record_tally(Tick tick) {
  if (recorder_ == nullptr || recorder_->scope() == recording::Scope::none) return;
  msg::Tally tally;
  tally.stamp(to_time(tick));
  tally.points(static_cast<std::uint32_t>(scoreboard_->delivered().points_detected()));
  tally.score(scoreboard_->delivered().score());
  tally.earned(scoreboard_->earned().score());
  recorder_->set_time(tick);
  recorder_->add("/skein/tally", tally);
}

// Sends the whole list each time that it changes, if there are readers. No member waits for it: it is not counted.
void StationNode::show_score(Tick tick) {
  if (!score_.is_wanted() && !score_eval_.is_wanted()) return;
  if (recorder_ != nullptr) recorder_->set_time(tick);
  const std::vector<PointTally>& tally = scoreboard_->delivered().points();
  std::vector<ScoredPoint> points;
  for (std::uint32_t i = 0; i < tally.size(); ++i) {
    if (tally[i].q > 0.0F) points.push_back({points_[i], tally[i].q, i});
  }
  for (const auto& [writer, with_indices] : {std::pair(&score_, false), std::pair(&score_eval_, true)}) {
    if (!writer->is_wanted()) continue;
    writer->begin_step();
    writer->write(to_score_cloud(tick, points, with_indices));
  }
}

// Only the station knows which points were delivered. It sends them in the world domain, where it reads the ledger
// anyway, so that viewers find them beside the server's topics. The topic is latched: later readers get the last
// sample.
void StationNode::show_to_viewers(Tick tick) {
  if (!viz_stale_ || tick < viz_due_ || !viz_scored_->has_readers()) return;
  viz_due_ = tick + kVizPeriod;
  viz_stale_ = false;
  const std::vector<PointTally>& tally = scoreboard_->delivered().points();
  std::vector<ScanPoint> points;
  for (std::size_t i = 0; i < tally.size(); ++i) {
    const Eigen::Vector3f& p = points_[i].p_W;
    if (tally[i].q > 0.0F) points.push_back({p.x(), p.y(), p.z(), tally[i].q});
  }
  viz_scored_->write(encode(to_cloud(tick, points)));
}

void StationNode::acknowledge(const StepOutcome& outcome) {
  for (std::size_t i = 0; i < outcome.acks.size(); ++i) {
    if (outcome.acks[i].empty()) continue;
    client_.write(topics::captures_ack(uavs_[i]).name, to_capture_ack(uavs_[i], outcome.acks[i]));
  }
}

void StationNode::tell(bool now) {
  if (!status_.is_open()) return;
  const auto time = std::chrono::steady_clock::now();
  if (!now && time - told_ < kStatusPeriod) return;
  told_ = time;
  status_.send(status::line_json(status::Tally{.points = static_cast<int>(scoreboard_->delivered().points_detected()),
                                               .score = scoreboard_->delivered().score(),
                                               .earned = scoreboard_->earned().score()}));
}

StationNotes StationNode::notes() const {
  return {.malformed = inbox_.malformed(), .unsent = gcs_->unsent().count(), .unwritten = unwritten_};
}

void StationNode::write_report(StationNotes notes) {
  if (scoreboard_) write_station_report(out_, *scoreboard_, uavs_, status_, std::move(notes));
}

}  // namespace skein::station
