// SimNode: the end of a run, and its report.
#include "process/host/thread_cpu.hpp"
#include "sim_server/sim_node.hpp"

namespace skein::sim {

/// @param joined  whether there was a step. @returns false: there is nothing more to do.
bool SimNode::end_run(bool joined) {
  state_ = State::over;
  if (options_.gate) options_.gate->closed(simulation_, digest_);
  tell_of_strangers(0);
  for (const std::string& name : uav_names_) summary_.commands_unheard.push_back(strangers_.unheard(name));
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> wall = now - started_;
  summary_.wall_time_s = joined ? wall.count() - (watch_ ? watch_->held_s(now) : 0.0) : 0.0;
  summary_.timing = clock_.summary();
  summary_.timing.cpu_s = joined ? thread_cpu_s() - cpu_before_s_ : 0.0;
  summary_.malformed = inbox_.malformed();
  summary_.unsent = participants_.front()->unsent().count();
  summary_.faults = faults_.report();
  if (work_) summary_.work = work_->tracks();
  summary_.differences = recording_.differences();
  summary_.status = end_status();
  // If the wall clock has affected the run or its end, the digest cannot be compared with that of another run.
  if (options_.realtime_factor || summary_.status == RunStatus::interrupted || aborted_) summary_.deterministic = false;
  if (summary_.deterministic) summary_.digest = digest_.hex();
  summary_.hand = hand_.report();
  for (std::string& trouble : hand_.finish()) files_.note_unwritten(std::move(trouble));
  files_.note_unwritten(recording_.close());
  files_.write_report(simulation_, summary_, status_);
  if (joined) progress_.tell_now(simulation_, summary_.lost);
  status_.send_surely(status::line_json(status::Ended{summary_.status, stalled_}));
  return false;
}

RunStatus SimNode::end_status() const {
  if (aborted_) return RunStatus::aborted;
  if (stop_requested_) return RunStatus::interrupted;
  if (simulation_.mission().end() == MissionEnd::takeoff_timeout) return RunStatus::no_takeoff;
  return RunStatus::completed;
}

}  // namespace skein::sim
