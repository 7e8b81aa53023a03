// Every reference vector through the production code, one test per table.
#include "sim_server/golden_check.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/types.hpp"

namespace skein::sim {
namespace {

class GoldenTables : public testing::TestWithParam<const char*> {};

TEST_P(GoldenTables, AllRowsAgree) {
  const char* folder = std::getenv("SKEIN_GOLDEN");
  if (!folder) GTEST_SKIP() << "SKEIN_GOLDEN is not set";
  const GoldenReport report = check_golden(std::filesystem::path(folder) / (std::string(GetParam()) + ".csv"));
  EXPECT_EQ(report.table, GetParam());
  EXPECT_GT(report.rows, 1000u);
  EXPECT_EQ(report.failures, 0u);
  EXPECT_LE(report.worst, 1.0) << report.worst_column;
  for (const auto& message : report.messages) ADD_FAILURE() << message;
  RecordProperty("rows", static_cast<int>(report.rows));
  RecordProperty("worst", std::to_string(report.worst) + " of the tolerance, in " + report.worst_column);
}

INSTANTIATE_TEST_SUITE_P(Tables, GoldenTables,
                         testing::Values("scoring", "gimbal", "position_control", "attitude_control", "los_antenna"),
                         [](const auto& table) { return std::string(table.param); });

class GoldenFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& content) {
    const auto path = std::filesystem::path(testing::TempDir()) /
                      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
    std::ofstream(path) << content;
    return path;
  }
};

constexpr char kAttitudeHeader[] =
    "row_id,role,roll_cmd,pitch_cmd,yaw_rate_cmd,thrust_cmd_N,q_w,q_x,q_y,q_z,w_B_x,w_B_y,w_B_z,roll_int,pitch_int,"
    "roll_int_out,pitch_int_out,ang_acc_x,ang_acc_y,ang_acc_z,rotor_0,rotor_1,rotor_2,rotor_3,rotor_4,rotor_5\n";

TEST_F(GoldenFile, WrongValueIsFoundAndNamed) {
  const std::string row = "1,explorer,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0.5,0\n";
  const auto path = write(kAttitudeHeader + row);
  const GoldenReport report = check_golden(path);
  EXPECT_EQ(report.rows, 1u);
  EXPECT_EQ(report.failures, 1u);
  ASSERT_EQ(report.messages.size(), 1u);
  EXPECT_EQ(report.messages[0], "line 2, rotor_4: expected 0.5, computed 0");
}

TEST_F(GoldenFile, BadTablesAreRefused) {
  EXPECT_THROW(check_golden("no such file"), InputError);
  EXPECT_THROW(check_golden(write("a,b\n1,2\n")), InputError);
  EXPECT_THROW(check_golden(write(std::string(kAttitudeHeader) + "1,explorer\n")), InputError);
  EXPECT_THROW(check_golden(write(std::string(kAttitudeHeader) +
                                  "1,explorer,x,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n")),
               InputError);
}

}  // namespace
}  // namespace skein::sim
