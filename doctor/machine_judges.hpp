// Judges the facts of the machine (doctor/machine_facts.hpp) for a fleet.   Pure; safe from any thread.
#pragma once

#include "doctor/finding.hpp"
#include "doctor/fleet_needs.hpp"
#include "doctor/machine_facts.hpp"

namespace skein::doctor {

Finding judge_container(const MachineFacts& machine);
Finding judge_open_files(const MachineFacts& machine, const FleetNeeds& needs);
Finding judge_processes(const MachineFacts& machine, const FleetNeeds& needs);
Finding judge_buffers(const MachineFacts& machine);
Finding judge_memory(const MachineFacts& machine, const FleetNeeds& needs);
Finding judge_cpus(const MachineFacts& machine);
Finding judge_disk(const DiskFacts& disk);
/// Two findings: the monotonic clock, by which a run waits, and the time of day.
Findings judge_clocks(const ClockFacts& clocks);

}  // namespace skein::doctor
