#include "cli/bench/report.hpp"

#include <gtest/gtest.h>

#include "cli/bench/targets.hpp"

namespace skein::cli {
namespace {

/// The result of a run of two UAVs for 100 simulated seconds. All programs together need 10 s of CPU time.
Json result(double wall_s = 2.0) {
  return {{"scenario", "towers"},
          {"status", "completed"},
          {"lost_members", Json::array()},
          {"sim_time_s", 100.0},
          {"wall_time_s", wall_s},
          {"real_time_factor", 100.0 / wall_s},
          {"memory_mb", 300.0},
          {"startup_s", 1.5},
          {"timing",
           {{"physics_s", 1.0},
            {"lidar_s", 0.5},
            {"camera_s", 0.25},
            {"links_s", 0.25},
            {"recording_s", 0.5},
            {"cpu_s", 3.5},
            {"steps", 2000},
            {"scans", 40},
            {"lidar_ms_per_scan", 12.5}}},
          {"processes",
           {{"sim_server", {{"cpu_s", 5.0}, {"peak_memory_mb", 120.0}}},
            {"comm_router", {{"cpu_s", 1.0}, {"peak_memory_mb", 30.0}}},
            {"station", {{"cpu_s", 0.5}, {"peak_memory_mb", 30.0}}},
            {"uav_agent-a", {{"cpu_s", 2.0}, {"peak_memory_mb", 70.0}}},
            {"uav_agent-b", {{"cpu_s", 1.5}, {"peak_memory_mb", 50.0}}}}},
          {"uavs", {{{"name", "a"}, {"planner_cpu_s", 1.25}}, {{"name", "b"}, {"planner_cpu_s", 0.75}}}}};
}

Json floor_report(double wall_s) {
  return {{"uavs", 2}, {"rounds", 4000}, {"wall_s", wall_s}, {"cpu_s", 4.0}, {"messages", 23}, {"bytes", 5000}};
}

TEST(BenchReport, MedianIsTheMiddleValue) {
  EXPECT_EQ(median({}), 0.0);
  EXPECT_EQ(median({3.0}), 3.0);
  EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
}

TEST(BenchReport, WorkSumsUpToAllCpuTime) {
  const Json work = work_of(result());
  double cpu_s = 0.0, share = 0.0, ms_per_sim_s = 0.0;
  for (const auto& [kind, entry] : work.items()) {
    cpu_s += entry["cpu_s"].get<double>();
    share += entry["share"].get<double>();
    ms_per_sim_s += entry["ms_per_sim_s"].get<double>();
  }
  EXPECT_NEAR(cpu_s, 10.0, 1e-12);
  EXPECT_NEAR(share, 1.0, 1e-12);
  EXPECT_NEAR(ms_per_sim_s, 100.0, 1e-12);
  EXPECT_EQ(work["agents"]["cpu_s"], 2.0);
  EXPECT_DOUBLE_EQ(work["physics"]["share"], 0.1);
}

TEST(BenchReport, ExchangeIsTheSumOfItsPrograms) {
  const Json exchange = work_of(result())["exchange"];
  double cpu_s = 0.0;
  for (const auto& [program, part] : exchange["by_program"].items()) cpu_s += part.get<double>();
  EXPECT_NEAR(cpu_s, exchange["cpu_s"].get<double>(), 1e-12);
  EXPECT_EQ(exchange["by_program"]["sim_server"], 2.5);
  EXPECT_EQ(exchange["by_program"]["uav_agents"], 1.5);
}

TEST(BenchReport, AnEmptyReportIsNotAnError) {
  for (const Json& nothing : {Json(), Json::object()}) {
    EXPECT_EQ(work_of(nothing)["exchange"]["share"], 0.0);
    EXPECT_EQ(speed_entry({nothing}, nullptr)["real_time_factor"]["median"], 0.0);
    EXPECT_EQ(rounds_entry("cyclonedds", 5, {{nothing, nothing}})["times_floor"]["median"], 0.0);
    EXPECT_EQ(scale_entry(5, {nothing})["to_the_end"], false);
  }
}

TEST(BenchReport, RoundsAreComparedPairByPair) {
  // Fleet: 2,000 rounds in 2, 4 and 1 s; floor: 4,000 rounds in 2 s.
  const Json entry = rounds_entry(
      "cyclonedds", 2,
      {{result(2.0), floor_report(2.0)}, {result(4.0), floor_report(2.0)}, {result(1.0), floor_report(2.0)}});
  EXPECT_EQ(entry["fleet_rounds_per_s"]["median"], 1000.0);
  EXPECT_EQ(entry["floor_rounds_per_s"]["median"], 2000.0);
  EXPECT_EQ(entry["times_floor"]["values"], (Json{2.0, 4.0, 1.0}));
  EXPECT_EQ(entry["times_floor"]["median"], 2.0);
  EXPECT_EQ(entry["fleet_cpu_ms_per_round"]["median"], 5.0);
  EXPECT_EQ(entry["floor_cpu_ms_per_round"]["median"], 1.0);
  EXPECT_EQ(entry["simulation_cpu_ms_per_round"]["median"], 1.0);
}

TEST(BenchReport, TheTimeOfAStepIsThatOfTheMedianRun) {
  // 2,000 steps in 2, 4 and 1 s; 10 s of CPU each.
  const Json entry = step_entry({result(2.0), result(4.0), result(1.0)});
  EXPECT_EQ(entry["round_ms"], 1.0);
  EXPECT_EQ(entry["cpu_ms"], 5.0);
  EXPECT_EQ(step_entry({Json::object()})["round_ms"], 0.0);
}

TEST(BenchReport, TheBreakdownIsThatOfTheMedianRun) {
  const Json entry = speed_entry({result(4.0), result(2.0), result(1.0)}, {{"mean_ms", 0.2}});
  EXPECT_EQ(entry["real_time_factor"]["median"], 50.0);
  EXPECT_EQ(entry["real_time_factor"]["min"], 25.0);
  EXPECT_EQ(entry["cores_busy"]["median"], 5.0);
  EXPECT_EQ(entry["lidar"]["every_scan"]["mean_ms"], 0.2);
  EXPECT_EQ(entry["uavs"], 2);
}

Json named(const Json& targets, const std::string& name) {
  for (const Json& target : targets) {
    if (target["name"] == name) return target;
  }
  ADD_FAILURE() << "no target " << name << " in " << targets.dump(2);
  return {{"value", nullptr}, {"met", nullptr}, {"factor", 0.0}};
}

/// The result of the same run in one process.
Json in_one_process(Json run) {
  run["processes"] = {{"one_process", {{"cpu_s", 10.0}, {"memory_share_mb", 50.0}}}};
  return run;
}

TEST(BenchReport, TargetsHaveTheMeasuredValueAndItsFactor) {
  Json five = rounds_entry("cyclonedds", 5, {{result(2.0), floor_report(2.0)}});
  const Json report = {
      {"speed",
       {speed_entry({result(5.0)}, {{"mean_ms", 0.5}}), speed_entry({in_one_process(result(1.0))}, nullptr, 1),
        speed_entry({in_one_process(result(1.0))}, nullptr, 2)}},
      {"rounds", {rounds_entry("fastdds", 5, {}), five}},
      {"scale",
       {scale_entry(20, {result(10.0)}), scale_entry(20, {in_one_process(result(4.0))}, 1),
        scale_entry(20, {in_one_process(result(2.0))}, 2), scale_entry(100, {result()})}}};
  const Json targets = targets_of(report);
  const Json speed = named(targets, "real-time factor, 2 UAVs, towers");
  EXPECT_EQ(speed["value"], 20.0);  // at least 50
  EXPECT_EQ(speed["met"], false);
  EXPECT_DOUBLE_EQ(speed["factor"], 20.0 / 50.0);
  const Json one_thread = named(targets, "real-time factor, 2 UAVs, towers, one process, 1 thread");
  EXPECT_EQ(one_thread["value"], 100.0);  // at least 80
  EXPECT_EQ(one_thread["met"], true);
  const Json threads = named(targets, "real-time factor, 2 UAVs, towers, one process, 2 threads");
  EXPECT_EQ(threads["met"], false);  // at least 130
  EXPECT_EQ(named(targets, "memory, 2 UAVs, towers, one process, 2 threads")["kind"], "at_most");
  const Json lidar = named(targets, "LiDAR, every scan, 2 UAVs, towers");
  EXPECT_EQ(lidar["met"], false);  // at most 0.25
  EXPECT_DOUBLE_EQ(lidar["factor"], 0.5);
  const Json rounds = named(targets, "lock-step against bare DDS, 5 UAVs");
  EXPECT_EQ(rounds["value"], 2.0);  // at most 1.5 times the floor's time
  EXPECT_EQ(rounds["met"], false);
  EXPECT_EQ(named(targets, "real-time factor, 20 UAVs")["value"], 10.0);
  EXPECT_EQ(named(targets, "real-time factor, 20 UAVs, one process, all cores")["value"], 50.0);
  EXPECT_EQ(named(targets, "real-time factor, 20 UAVs, one process, all cores")["met"], true);
  EXPECT_TRUE(named(targets, "real-time factor, 100 UAVs, one process, all cores")["met"].is_null());
  EXPECT_EQ(named(targets, "100 UAVs run to the end")["met"], true);
}

TEST(BenchReport, ATargetThatWasNotMeasuredIsNeitherMetNorMissed) {
  const Json targets = targets_of({{"scale", {scale_entry(5, {result()})}}});
  ASSERT_FALSE(targets.empty());
  for (const Json& target : targets) EXPECT_TRUE(target["met"].is_null() && target["value"].is_null()) << target;
}

TEST(BenchReport, InOneProcessTheServersShareIsWhatItsOwnClockMeasures) {
  Json run = in_one_process(result());
  run["timing"]["cpu_s"] = 4.0;
  const Json work = work_of(run), of_server = work["exchange"]["by_program"]["sim_server"];
  double server_s = of_server.get<double>(), all_s = 0.0;
  for (const char* kind : {"physics", "lidar", "camera", "line_of_sight", "recording"})
    server_s += work[kind]["cpu_s"].get<double>();
  EXPECT_DOUBLE_EQ(server_s, 4.0);
  for (const auto& [kind, of_kind] : work.items()) all_s += of_kind["cpu_s"].get<double>();
  EXPECT_DOUBLE_EQ(all_s, 10.0);
}

TEST(BenchReport, ARunThatLostAMemberDidNotRunToTheEnd) {
  EXPECT_TRUE(ran_to_the_end(result()));
  Json lost = result();
  lost["lost_members"].push_back({{"member", "a"}});
  EXPECT_FALSE(ran_to_the_end(lost));
  Json aborted = result();
  aborted["status"] = "aborted";
  EXPECT_FALSE(ran_to_the_end(aborted));
}

TEST(BenchReport, RadioAndMemoryEntriesMeetOrMissTheirTargets) {
  const Json relay = relay_entry(
      "fastdds",
      {{{"bytes", 200}, {"router_us", {{"median", 90.0}}}, {"relay_us", {{"median", 60.0}}}, {"times_relay", 1.5}}});
  Json run = {{"status", "completed"}, {"sim_time_s", 10.0}, {"wall_time_s", 10.0}, {"real_time_factor", 1.0}};
  run["radio"] = {{"sent", 80000}, {"dropped_no_los", 1000}, {"delivered", 79000}};
  const Json load = load_entry(20, {run});
  EXPECT_EQ(load["lost"]["median"], 0.0);
  EXPECT_EQ(load["messages_per_s"]["median"], 8000.0);
  const Json memory = memory_entry({{"processes", {{"a", {{"memory_share_mb", 100.0}}}}}},
                                   {{"processes", {{"a", {{"memory_share_mb", 105.0}}}}}});
  EXPECT_DOUBLE_EQ(memory["growth"], 1.05);
  const Json targets = targets_of({{"relay", {relay}}, {"load", load}, {"memory", memory}});
  EXPECT_EQ(named(targets, "router against a bare relay, fastdds")["met"], false);  // at most 1.3
  EXPECT_EQ(named(targets, "radio, 20 UAVs x 20 topics x 20 Hz: arrived")["met"], true);
  EXPECT_EQ(named(targets, "and in real time")["met"], true);
  EXPECT_EQ(named(targets, "memory after an hour")["met"], true);
}

}  // namespace
}  // namespace skein::cli
