#include "cli/bench/python.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace skein::cli {
namespace {

Json flight_of(double cpu_s, double real_time_factor) {
  return {{"processes", {{"one_process", {{"cpu_s", cpu_s}}}}}, {"real_time_factor", real_time_factor}};
}

const Json* row_named(const Json& rows, const std::string& part) {
  const auto found = std::ranges::find_if(
      rows, [&](const Json& row) { return row["name"].get<std::string>().find(part) != std::string::npos; });
  return found == rows.end() ? nullptr : &*found;
}

TEST(PythonPairs, AreComparedOneByOne) {
  const Json entry = language_pairs_entry(
      {{flight_of(0.8, 200.0), flight_of(1.0, 100.0)}, {flight_of(3.0, 50.0), flight_of(4.0, 45.0)}, {Json(), Json()}});
  EXPECT_EQ(entry["pairs"], 3);
  EXPECT_EQ(entry["speed_cpu"]["values"], Json({0.8, 0.75})) << "the speed is lower if the flight needs more CPU time";
  EXPECT_EQ(entry["speed_clock"]["values"], Json({0.5, 0.9}));
  EXPECT_TRUE(language_pairs_entry({{Json(), flight_of(1.0, 1.0)}})["speed_cpu"].is_null()) << "nothing was measured";
}

TEST(PythonRows, SayWhetherTheirTargetsAreMet) {
  const Json planners = {{"one process", language_pairs_entry({{flight_of(0.6, 2.0), flight_of(1.0, 1.0)}})}};
  const Json rows = python_rows(planners, {{"stepping_cpu", {90.0, 101.0, 130.0}},
                                           {"resets_per_minute_cpu", {999.0}},
                                           {"growth_here_mb", {0.1}},
                                           {"copy_mbs_clock_ms", {19.0, 30.0, 21.0}},
                                           {"copy_towers_clock_ms", {500.0}}});
  const auto met = [&](const char* part) {
    const Json* row = row_named(rows, part);
    return row == nullptr ? Json("no row") : (*row)["met"];
  };
  EXPECT_EQ(met("hover in Python"), Json(false)) << "0.6 of the speed, and 0.7 is asked";
  EXPECT_EQ(met("steps of 0.05 s"), Json(true));
  EXPECT_EQ(met("resets a minute"), Json(false));
  EXPECT_EQ(met("Python's memory"), Json(true));
  EXPECT_EQ(met("beside MBS"), Json(false)) << "the median counts";
  EXPECT_EQ(met("in towers"), Json()) << "this row has no target";
  EXPECT_EQ(row_named(rows, "safety filter"), nullptr) << "the safety filter was not measured";
  std::ostringstream out;
  print_python(out, rows);
  for (const char* words : {"101.0", "130.0", "missed", "met\n", "by the clock"}) {
    EXPECT_NE(out.str().find(words), std::string::npos) << words << '\n' << out.str();
  }
}

}  // namespace
}  // namespace skein::cli
