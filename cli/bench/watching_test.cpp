#include "cli/bench/watching.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace skein::cli {
namespace {

Json flown(double server_s, double station_s) {
  return {{"processes", {{"sim_server", {{"cpu_s", server_s}}}, {"station", {{"cpu_s", station_s}}}}}};
}

TEST(WatchingEntries, HoldTheMedianOfTheRatiosOfPairs) {
  const std::vector<WatchedPair> pairs = {
      {flown(4.0, 1.0), flown(4.0, 1.5), {{"first_picture_ms", 800.0}, {"script_ms", 2.0}, {"frames", 100}}},
      {flown(8.0, 2.0), flown(8.0, 2.2), {{"first_picture_ms", 600.0}, {"script_ms", 4.0}, {"frames", 300}}},
      {flown(1.0, 1.0), flown(2.0, 2.0), {{"first_picture_ms", 700.0}, {"script_ms", 3.0}, {"frames", 200}}}};
  const Json entry = watching_entry(pairs);
  EXPECT_EQ(entry["pairs"], 3);
  EXPECT_DOUBLE_EQ(entry["cpu_ratio"]["median"], 1.1);
  EXPECT_DOUBLE_EQ(entry["cpu_ratio"]["max"], 2.0);
  EXPECT_DOUBLE_EQ(entry["first_picture_ms"]["median"], 700.0);
  EXPECT_DOUBLE_EQ(entry["script_ms"]["min"], 2.0);
  EXPECT_DOUBLE_EQ(entry["pictures"]["median"], 200.0);
  EXPECT_TRUE(entry["draw_calls"].is_null()) << "no flight counted draw calls";
}

TEST(WatchingEntries, LeaveOutFlightsThatFailed) {
  const Json entry = watching_entry({{Json(), flown(1.0, 1.0), Json()}});
  EXPECT_TRUE(entry["cpu_ratio"].is_null());
  EXPECT_TRUE(entry["first_picture_ms"].is_null());
  std::ostringstream out;
  print_watching(out, entry);
  EXPECT_NE(out.str().find("first picture"), std::string::npos);
}

}  // namespace
}  // namespace skein::cli
