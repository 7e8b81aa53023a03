// Measures CPU time and memory of the programs of a fleet between the first step and the last.
#include <algorithm>
#include <utility>

#include "run/fleet_run.hpp"

namespace skein::cli {

/// CPU time before the first step belongs to startup, and is subtracted later.
void FleetRun::on_first_step() {
  first_progress_ = Clock::now();
  facts_.startup_s = std::chrono::duration<double>(*first_progress_ - started_).count();
  if (in_containers_) return;
  for (const std::string& process : host_->processes()) cpu_before_s_[process] = host_->cpu_s(process);
}

/// After the last step; what the programs do while they leave does not count.
void FleetRun::note_use() {
  over_ = true;
  if (in_containers_) return;
  for (const std::string& process : host_->processes()) {
    facts_.processes[process].cpu_s += host_->cpu_s(process) - cpu_before_s_[process];
    facts_.processes[process].memory_share_mb = host_->memory_share_mb(process);
  }
}

void FleetRun::note_end(const Event& event) {
  if (event.exit.shared || in_containers_) return;
  results::ProcessUse& use = facts_.processes[event.program];
  use.peak_memory_mb = std::max(use.peak_memory_mb, event.exit.peak_memory_mb);
  if (!over_) use.cpu_s += event.exit.cpu_s - std::exchange(cpu_before_s_[event.program], 0.0);
}

}  // namespace skein::cli
