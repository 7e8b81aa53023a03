#include "cli/bench/table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "cli/bench/report.hpp"
#include "cli/bench/targets.hpp"

namespace skein::cli {
namespace {

std::string printed(const Json& report) {
  std::ostringstream out;
  print_bench(out, report);
  return out.str();
}

TEST(BenchTable, SaysOfEachTargetWhetherItIsMet) {
  Json report = {{"scale", {scale_entry(20, {{{"real_time_factor", 12.0}}})}}};
  report["targets"] = targets_of(report);
  const std::string text = printed(report);
  EXPECT_NE(text.find("12 x: missed, 80 % of it"), std::string::npos) << text;
  EXPECT_NE(text.find("not measured"), std::string::npos) << text;
  report["scale"][0]["real_time_factor"]["median"] = 16.0;
  report["targets"] = targets_of(report);
  EXPECT_NE(printed(report).find("16 x: met"), std::string::npos);
}

TEST(BenchTable, ShowsEveryKindOfWork) {
  const Json run = {{"sim_time_s", 10.0}, {"processes", {{"station", {{"cpu_s", 2.0}}}}}};
  const std::string text = printed({{"speed", {speed_entry({run}, nullptr)}}, {"targets", Json::array()}});
  for (const char* kind : {"physics", "lidar", "camera", "line_of_sight", "recording", "agents", "exchange", "station"})
    EXPECT_NE(text.find(kind), std::string::npos) << kind;
}

TEST(BenchTable, AnEmptyReportIsPrintable) { EXPECT_FALSE(printed(Json::object()).empty()); }

}  // namespace
}  // namespace skein::cli
