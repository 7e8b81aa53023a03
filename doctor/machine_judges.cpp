#include "doctor/machine_judges.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace skein::doctor {
namespace {

std::string megabytes(std::uint64_t bytes) {
  return bytes < 10'000'000 ? fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes))
                            : fmt::format("{} MB", bytes / 1'000'000);
}

/// The lower of two limits, either of which may be missing.
Limit less_of(const Limit& a, const Limit& b) { return a && b ? std::min(*a, *b) : a ? a : b; }

}  // namespace

Finding judge_container(const MachineFacts& machine) {
  if (machine.container.empty()) return fine("host", "no container");
  return fine("host", "a container (" + machine.container + "); limits below are what it is granted");
}

Finding judge_open_files(const MachineFacts& machine, const FleetNeeds& needs) {
  const std::string what = "open files";
  if (!machine.open_files) return fine(what, "no limit");
  const std::string found =
      fmt::format("{} per process; {} UAVs need about {}", *machine.open_files, needs.uavs, needs.open_files());
  if (*machine.open_files >= needs.open_files()) return fine(what, found);
  const std::string number = std::to_string(needs.open_files());
  if (!machine.most_open_files || *machine.most_open_files >= needs.open_files()) {
    return fine(what, found + "; each program raises this limit for itself");
  }
  return failure(what, found,
                 "as root, raise nofile in /etc/security/limits.conf to " + number +
                     " and log in again, or start the container with --ulimit nofile=" + number);
}

Finding judge_processes(const MachineFacts& machine, const FleetNeeds& needs) {
  const std::string what = "processes";
  const Limit most = less_of(less_of(machine.processes, machine.kernel_processes), machine.cgroup.processes);
  if (!most) return fine(what, "no limit");
  const std::string found =
      fmt::format("{} processes and threads may run; {} UAVs need about {}", *most, needs.uavs, needs.threads());
  if (*most >= needs.threads()) return fine(what, found);
  const std::string number = std::to_string(needs.threads());
  // Only the lowest limit is in the way.
  return failure(what, found,
                 machine.cgroup.processes == most
                     ? "raise pids.max of the cgroup, or start the container with --pids-limit " + number
                 : machine.processes == most ? "run `ulimit -u " + number + "` in the shell before the run"
                                             : "as root, on the host: sysctl -w kernel.threads-max=" + number);
}

Finding judge_buffers(const MachineFacts& machine) {
  const std::string what = "socket buffers";
  if (!machine.receive_buffer || !machine.send_buffer) {
    return fine(what, "the limits cannot be seen from here; on the host: sysctl net.core.rmem_max net.core.wmem_max");
  }
  const std::uint64_t least = std::min(*machine.receive_buffer, *machine.send_buffer);
  const std::string found =
      fmt::format("{} to receive, {} to send; DDS asks for {}", megabytes(*machine.receive_buffer),
                  megabytes(*machine.send_buffer), megabytes(kSocketBuffer));
  if (least >= kSocketBuffer) return fine(what, found);
  return warning(
      what, found + "; what overflows is sent again, which slows down large fleets",
      fmt::format("as root, on the host: sysctl -w net.core.rmem_max={0} net.core.wmem_max={0}", kSocketBuffer));
}

Finding judge_memory(const MachineFacts& machine, const FleetNeeds& needs) {
  const std::string what = "memory";
  const Limit left = less_of(machine.memory, machine.cgroup.memory_left);
  if (!left) return fine(what, "the available memory cannot be determined");
  const bool by_cgroup = left == machine.cgroup.memory_left;
  const std::string found =
      fmt::format("{} available{}; {} UAVs need about {}", megabytes(*left), by_cgroup ? " in this cgroup" : "",
                  needs.uavs, megabytes(needs.memory_bytes()));
  const std::string fix = by_cgroup ? "raise memory.max of the cgroup, or start the container with more --memory"
                                    : "end other programs, or fly fewer UAVs";
  if (*left < needs.memory_bytes()) return failure(what, found, fix);
  if (*left < 2 * needs.memory_bytes()) return warning(what, found + ", and more in large scenes", fix);
  return fine(what, found);
}

Finding judge_cpus(const MachineFacts& machine) {
  const std::string what = "processors";
  const std::string found = std::to_string(machine.cpus);
  const auto& quota = machine.cgroup.cpus;
  if (!quota || *quota >= machine.cpus) return fine(what, found);
  const std::string limited = fmt::format("{}, of which the cgroup grants the time of {:.2f}", found, *quota);
  if (*quota >= 1.0) return fine(what, limited);
  return warning(what, limited + "; this slows a fleet down and pauses it again and again",
                 "start the container with --cpus 1 or more");
}

Finding judge_disk(const DiskFacts& disk) {
  const std::string what = "results folder", folder = disk.folder.string();
  if (!disk.create_error.empty()) {
    return failure(what, folder + ": no file can be created there: " + disk.create_error,
                   "choose another folder with --out, or change its permissions");
  }
  if (!disk.free) return fine(what, folder + "; the free space is unknown");
  const std::string found = folder + " has " + megabytes(*disk.free) + " free";
  const std::string fix = "free some space, or choose another folder with --out";
  if (*disk.free < kLeastDisk) return failure(what, found + ", less than a run writes", fix);
  if (*disk.free < kAmpleDisk) return warning(what, found + "; a run writes tens of MB", fix);
  return fine(what, found);
}

Findings judge_clocks(const ClockFacts& clocks) {
  constexpr double kStepS = 0.01, kYear2020 = 1'577'836'800.0;
  Findings findings;
  const std::string source = clocks.source.empty() ? "" : ", by " + clocks.source;
  if (clocks.monotonic_s <= 0.0) {
    findings.push_back(failure("monotonic clock", "it does not advance" + source,
                               "repair the host's clock source (/sys/devices/system/clocksource)"));
  } else if (clocks.source == "hpet" || clocks.source == "acpi_pm" || clocks.source == "jiffies") {
    findings.push_back(warning("monotonic clock", "it advances" + source + ", which is slow to read",
                               "if its processor has a stable TSC, boot the host's kernel with clocksource=tsc"));
  } else {
    findings.push_back(fine("monotonic clock", "it advances" + source + "; programs measure all waiting times by it"));
  }
  const std::string dates =
      "no result depends on it, but hosts of a fleet with both DDS vendors need clocks that agree";
  if (clocks.date_s < kYear2020) {
    findings.push_back(warning("time of day",
                               "it is before 2020; " + dates + ", and the certificates of --secure need the date",
                               "set the host's date"));
  } else if (std::abs(clocks.realtime_s - clocks.monotonic_s) > kStepS) {
    findings.push_back(warning("time of day", "it is being set right now; " + dates, "try again"));
  } else {
    findings.push_back(fine("time of day", "it is set; " + dates));
  }
  return findings;
}

}  // namespace skein::doctor
