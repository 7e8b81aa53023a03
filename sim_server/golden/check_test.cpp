// Checks the production code against every reference vector, one test per table.
#include "sim_server/golden/check.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/types.hpp"
#include "tests/support/places.hpp"

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

/// The reference vectors that Skein ships: our own, computed by a second implementation.
class ShippedVectors : public testing::TestWithParam<const char*> {};

TEST_P(ShippedVectors, AllRowsAgree) {
  const GoldenReport report = check_golden(source_path("config/reference_vectors/" + std::string(GetParam()) + ".csv"));
  EXPECT_EQ(report.table, GetParam());
  EXPECT_GE(report.rows, 300u);
  for (const auto& message : report.messages) ADD_FAILURE() << message;
}

INSTANTIATE_TEST_SUITE_P(Tables, ShippedVectors, testing::Values("scoring", "gimbal"),
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

TEST_F(GoldenFile, AFailureNamesLineAndColumnOfTheWrongValue) {
  const std::string row = "1,explorer,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0.5,0\n";
  const auto path = write(kAttitudeHeader + row);
  const GoldenReport report = check_golden(path);
  EXPECT_EQ(report.rows, 1u);
  EXPECT_EQ(report.failures, 1u);
  ASSERT_EQ(report.messages.size(), 1u);
  EXPECT_EQ(report.messages[0], "line 2, rotor_4: expected 0.5, computed 0");
}

/// A line with its cells in reversed order.
std::string reversed(const std::string& line) {
  std::istringstream cells(line);
  std::string result;
  for (std::string cell; std::getline(cells, cell, ',');) result = cell + (result.empty() ? "" : "," + result);
  return result;
}

TEST_F(GoldenFile, TheReaderAcceptsOtherFormsOfTheSameTable) {
  const std::string header(kAttitudeHeader, sizeof(kAttitudeHeader) - 2);  // without the end of line
  const std::string row = "1,explorer,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0";
  const std::string e_row = "1,explorer,+0,0e0,0E+00,0.0,1e0,-0,1e-400,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0";
  const std::vector<std::string> files = {
      header + "\n" + row,                                               // the last line without a line end
      header + "\r\n" + row + "\r\n\r\n",                                // Windows line ends
      "\xEF\xBB\xBF" + header + "\n" + row + "\n",                       // with a byte order mark
      "# a comment\n\n" + header + "\n\n# another\n" + row + "\n   \n",  // comments and empty lines
      reversed(header) + "\n" + reversed(row) + "\n",                    // columns in another order
      header + ",remark\n" + row + ",of no importance\n",                // an additional column
      header + "\n" + e_row + "\n",                                      // scientific notation, signs, a tiny number
      "\"row_id\" , " + header.substr(7) + "\n" + " 1 , \"explorer\"" + row.substr(10) + "\n"};  // spaces, quotes
  for (const std::string& file : files) {
    const GoldenReport report = check_golden(write(file));
    EXPECT_EQ(report.rows, 1u) << file;
    EXPECT_EQ(report.failures, 0u) << file << (report.messages.empty() ? "" : report.messages[0]);
  }
}

TEST_F(GoldenFile, MessagesHaveTheLineNumberInTheFile) {
  const auto path = write(std::string("# first\n") + kAttitudeHeader +
                          "\n1,explorer,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0.5,0,0,0,0,0\n");
  EXPECT_EQ(check_golden(path).messages.at(0), "line 4, rotor_0: expected 0.5, computed 0");
}

TEST_F(GoldenFile, NanAndInfinityNeverAgreeWithAnExpectedValue) {
  const auto path =
      write(std::string(kAttitudeHeader) + "1,explorer,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,nan,inf,0,0,0,0,0,0,0\n");
  const GoldenReport report = check_golden(path);
  EXPECT_EQ(report.failures, 1u);
  EXPECT_EQ(report.messages.size(), 2u);
}

constexpr char kGimbalHeader[] =
    "sequence_id,tick,mode,cmd_pitch,cmd_yaw,ticks_since_command,pitch_limit_deg,yaw_limit_deg,rate_limit_deg_s,"
    "pitch_before,yaw_before,effective_mode,pitch,yaw,pitch_rate,yaw_rate,saturated_reference_quirk,"
    "partial_saturation_quirk,stale_rate_quirk\n";

TEST_F(GoldenFile, AGimbalModeIsAnyNumberAndSequencesMayInterleave) {
  // docs/rules.md, G6: the mode 0.5 means angle, -1e-8 freeze, and -0.3 rate.
  const auto path = write(std::string(kGimbalHeader) +
                          "a,0,0.5,0.01,0,0,80,90,60,0,0,1,0.01,0,0.2,0,0,0,0\n"
                          "b,0,-0.3,0,0.4,0,80,90,60,0,0,-1,0,0.02,0,0.4,0,0,0\n"
                          "a,1,-1e-8,0,0,0,80,90,60,0.01,0,0,0.01,0,0.2,0,0,0,1.0\n"
                          "b,1,-0.3,0,0.4,1,80,90,60,0,0.02,-1.0,0,0.04,0,0.4,0,false,0\n");
  const GoldenReport report = check_golden(path);
  EXPECT_EQ(report.rows, 4u);
  EXPECT_EQ(report.failures, 0u) << report.messages.at(0);
  EXPECT_THROW(check_golden(write(std::string(kGimbalHeader) + "a,3,0,0,0,0,80,90,60,0,0,0,0,0,0,0,0,0,0\n")),
               InputError);
}

constexpr char kPositionHeader[] =
    "role,cmd_px,cmd_py,cmd_pz,cmd_vx,cmd_vy,cmd_vz,cmd_ax,cmd_ay,cmd_az,cmd_yaw,px,py,pz,q_w,q_x,q_y,q_z,vel_world_x,"
    "vel_world_y,vel_world_z,pos_err_acc_x,pos_err_acc_y,pos_err_acc_z,yaw_err_acc,state_before,command_age_s,"
    "state_after,eff_cmd_px,eff_cmd_py,eff_cmd_pz,eff_cmd_yaw,pos_err_acc_out_x,pos_err_acc_out_y,pos_err_acc_out_z,"
    "yaw_err_acc_out,tar_acc_x,tar_acc_y,tar_acc_z,roll_cmd,pitch_cmd,yaw_rate_cmd,thrust_cmd_N\n";

TEST_F(GoldenFile, ACommandMustBeOlderThanTheLimitToExpire) {
  // An explorer hovers at its target, and its last command ages. When the command is exactly 0.1 s old, no rule changes
  // the state (docs/rules.md, P9); when it is older, the UAV holds its position.
  const std::string before = "explorer,5,0,3,0,0,0,0,0,0,0,5,0,3,1,0,0,0,0,0,0,0,0,0,0,moving,";
  const std::string after = ",5,0,3,0,0,0,0,0,0,0,9.781,0,0,0,30.21\n";
  const auto failures = [&](const std::string& age, const std::string& state) {
    return check_golden(write(kPositionHeader + before + age + "," + state + after)).failures;
  };
  EXPECT_EQ(failures("0.0999", "moving"), 0u);
  EXPECT_EQ(failures("0.1", "moving"), 0u);
  EXPECT_EQ(failures("0.1000001", "hold"), 0u);
  EXPECT_EQ(failures("7", "hold"), 0u);
  EXPECT_EQ(failures("0.1000001", "moving"), 1u);
  EXPECT_THROW(check_golden(write(kPositionHeader + ("pilot" + before.substr(8)) + "0,moving" + after)), InputError);
}

TEST_F(GoldenFile, BadTablesAreRefused) {
  EXPECT_THROW(check_golden("no such file"), InputError);
  EXPECT_THROW(check_golden(write("a,b\n1,2\n")), InputError);
  EXPECT_THROW(check_golden(write("")), InputError);
  EXPECT_THROW(check_golden(write(kAttitudeHeader)), InputError) << "no rows";
  EXPECT_THROW(check_golden(write("row_id," + std::string(kAttitudeHeader) + "1,1\n")), InputError)
      << "the header names a column twice";
  EXPECT_THROW(
      check_golden(write(std::string(kAttitudeHeader) + "1,tractor,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n")),
      InputError);
  EXPECT_THROW(check_golden(write(std::string(kAttitudeHeader) + "1,explorer\n")), InputError);
  EXPECT_THROW(check_golden(write(std::string(kAttitudeHeader) +
                                  "1,explorer,x,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n")),
               InputError);
}

}  // namespace
}  // namespace skein::sim
