#include "cli/bench/table.hpp"

#include <spdlog/fmt/fmt.h>

#include <string>

#include "cli/bench/report.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"

namespace skein::cli {
namespace {

double middle(const Json& object, const char* key) {
  return number_in(value_or(object, key, Json::object()), "median");
}

/// "41.2 (39.8-42.0)"
std::string spread(const Json& object, const char* key, int digits) {
  const Json figure = value_or(object, key, Json::object());
  return fmt::format("{:.{}f} ({:.{}f}-{:.{}f})", number_in(figure, "median"), digits, number_in(figure, "min"), digits,
                     number_in(figure, "max"), digits);
}

/// "cyclonedds", "one process, 2 threads"
std::string medium(const Json& entry) {
  const int threads = static_cast<int>(number_in(entry, "threads"));
  return threads > 0 ? text_of_threads(threads) : text_in(entry, "medium");
}

Json part(const Json& report, const char* key) { return value_or(report, key, Json::array()); }

void print_speed(std::ostream& out, const Json& speed) {
  out << fmt::format(
      "\n{}, {} UAVs, patrol, {}: x{} real time, {:.1f} s simulated; {} cores busy, {:.0f} MB, start-up {:.1f} s\n",
      text_in(speed, "scenario"), number_in(speed, "uavs"), medium(speed), spread(speed, "real_time_factor", 1),
      number_in(speed, "sim_time_s"), spread(speed, "cores_busy", 2), middle(speed, "memory_mb"),
      middle(speed, "startup_s"));
  out << fmt::format("  {:<16}{:>10}{:>10}{:>18}\n", "CPU time of", "s", "share", "ms a simulated s");
  const Json all_work = value_or(speed, "work", Json::object());
  for (const auto& [kind, work] : all_work.items()) {
    out << fmt::format("  {:<16}{:>10.2f}{:>9.1f}%{:>18.2f}\n", kind, number_in(work, "cpu_s"),
                       100.0 * number_in(work, "share"), number_in(work, "ms_per_sim_s"));
  }
  const Json exchange = value_or(value_or(all_work, "exchange", Json::object()), "by_program", Json::object());
  for (const auto& [program, cpu_s] : exchange.items()) {
    out << fmt::format("  {:<16}{:>10.2f}\n", "  " + program, cpu_s.get<double>());
  }
  const Json lidar = value_or(speed, "lidar", Json::object());
  const Json every = value_or(lidar, "every_scan", Json::object());
  if (every.empty()) return;
  out << fmt::format(
      "  LiDAR: {} scans computed at {:.3f} ms; every scan along the flown path ({}): mean {:.3f}, median {:.3f}, "
      "95 % {:.3f} ms, {:.0f} returns, {} triangles\n",
      number_in(lidar, "scans_computed"), number_in(lidar, "ms_per_computed_scan"), number_in(every, "scans"),
      number_in(every, "mean_ms"), number_in(every, "median_ms"), number_in(every, "p95_ms"),
      number_in(every, "mean_returns"), number_in(every, "triangles"));
}

void print_rounds(std::ostream& out, const Json& rounds) {
  if (rounds.empty()) return;
  out << "\nlock-step rounds without physics and planning, against the same messages over bare DDS\n"
      << fmt::format("  {:<12}{:>5}{:>10}{:>10}{:>22}{:>22}{:>18}{:>26}\n", "vendor", "UAVs", "messages", "bytes",
                     "fleet [1/s]", "floor [1/s]", "times the floor", "CPU ms a round");
  for (const Json& entry : rounds) {
    out << fmt::format("  {:<12}{:>5}{:>10}{:>10}{:>22}{:>22}{:>18}{:>26}\n", text_in(entry, "vendor"),
                       number_in(entry, "uavs"), number_in(entry, "messages_per_round"),
                       number_in(entry, "bytes_per_round"), spread(entry, "fleet_rounds_per_s", 0),
                       spread(entry, "floor_rounds_per_s", 0), spread(entry, "times_floor", 2),
                       fmt::format("{:.2f} / {:.2f} = {:.2f}", middle(entry, "fleet_cpu_ms_per_round"),
                                   middle(entry, "floor_cpu_ms_per_round"), middle(entry, "times_floor_cpu")));
  }
}

void print_scale(std::ostream& out, const Json& scale) {
  if (scale.empty()) return;
  out << fmt::format("\nsizes of fleet, patrol beside the towers (more than {} UAVs: in {})\n", kMostUavsOverDds,
                     kDistrict)
      << fmt::format("  {:>5}{:>24}{:>20}{:>12}{:>12}{:>14}{:>14}{:>14}{:>10}{:>10}{:>12}\n", "UAVs", "",
                     "real-time factor", "rounds/s", "memory MB", "largest MB", "agent MB", "start-up s", "agents",
                     "exchange", "to the end");
  for (const Json& entry : scale) {
    const Json work = value_or(entry, "work", Json::object());
    const auto share = [&](const char* kind) {
      return 100.0 * number_in(value_or(work, kind, Json::object()), "share");
    };
    out << fmt::format("  {:>5}{:>24}{:>20}{:>12.1f}{:>12.0f}{:>14.0f}{:>14.1f}{:>14.1f}{:>9.0f}%{:>9.0f}%{:>12}\n",
                       number_in(entry, "uavs"), medium(entry), spread(entry, "real_time_factor", 1),
                       middle(entry, "rounds_per_s"), middle(entry, "memory_mb"),
                       number_in(entry, "largest_process_mb"), number_in(entry, "mean_agent_mb"),
                       middle(entry, "startup_s"), share("agents"), share("exchange"),
                       value_or(entry, "to_the_end", false).get<bool>() ? "yes" : "no");
  }
}

void print_radio(std::ostream& out, const Json& report) {
  const Json relays = part(report, "relay");
  if (!relays.empty()) out << "\nradio latency [us] through comm_router / through a bare relay of the same vendor\n";
  for (const Json& relay : relays) {
    out << fmt::format("  {:<12}{:>22}{:>22}{:>22} times\n", text_in(relay, "vendor"), spread(relay, "router_us", 0),
                       spread(relay, "relay_us", 0), spread(relay, "times_relay", 2));
  }
  if (const Json load = value_or(report, "load", Json::object()); !load.empty()) {
    out << fmt::format("\nradio load, {} UAVs in real time: {:.0f} messages/s, {:.0f} lost, x{} real time\n",
                       number_in(load, "uavs"), middle(load, "messages_per_s"), middle(load, "lost"),
                       spread(load, "real_time_factor", 3));
  }
  if (const Json memory = value_or(report, "memory", Json::object()); !memory.empty()) {
    out << fmt::format("\nmemory: {:.0f} MB after {:.0f} s, {:.0f} MB after {:.0f} s\n", number_in(memory, "short_mb"),
                       number_in(memory, "short_s"), number_in(memory, "long_mb"), number_in(memory, "long_s"));
  }
}

void print_targets(std::ostream& out, const Json& targets) {
  out << "\ntargets (2 cores, Cyclone DDS)\n";
  for (const Json& target : targets) {
    const bool at_least = value_or(target, "kind", "") == "at_least";
    std::string verdict = "not measured";
    if (target["met"].is_boolean()) {
      const double factor = number_in(target, "factor");
      verdict = fmt::format("{:.3g} {}: {}", number_in(target, "value"), target["unit"].get<std::string>(),
                            target["met"].get<bool>() ? "met" : fmt::format("missed, {:.0f} % of it", 100.0 * factor));
    }
    out << fmt::format("  {:<54}{:>3}{:>6}   {}\n", target["name"].get<std::string>(),
                       at_least ? ">=" : "<=", number_in(target, "target"), verdict);
  }
}

}  // namespace

void print_bench(std::ostream& out, const Json& report) {
  const Json machine = value_or(report, "machine", Json::object());
  out << fmt::format("{}, {} cores, load {:.1f} before the start; {} of each kind, medians (least-most)\n",
                     text_in(machine, "cpu"), number_in(machine, "cores"), number_in(machine, "load"),
                     number_in(report, "repeats"));
  for (const Json& speed : part(report, "speed")) print_speed(out, speed);
  print_rounds(out, part(report, "rounds"));
  print_scale(out, part(report, "scale"));
  print_radio(out, report);
  print_targets(out, part(report, "targets"));
}

}  // namespace skein::cli
