#include "cli/doctor_command.hpp"

#include <gtest/gtest.h>

#include "host/testing/fake_programs.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

class DoctorCommand : public ::testing::Test {
 protected:
  FakePrograms programs_;
};

TEST_F(DoctorCommand, HandsItsOptionsToTheProgram) {
  const std::filesystem::path told = programs_.dir() / "told";
  write_script(programs_.dir() / "skein_doctor", "echo \"$@\" > " + told.string());
  EXPECT_EQ(consult_doctor({}), kExitDone);
  EXPECT_EQ(read_text(told), "--scenario towers --dds cyclonedds --out runs\n");
  DoctorOptions all;
  all.net = true;
  all.scenario = "mine.yaml";
  all.assets = "assets";
  all.dds = "mixed";
  all.domain = 7;
  all.network = "eth0";
  all.out = "there";
  all.json = true;
  all.name = "me";
  all.only = {"world", "gcs"};
  all.seconds = 2.5;
  EXPECT_EQ(consult_doctor(all), kExitDone);
  EXPECT_EQ(read_text(told),
            "--scenario mine.yaml --dds mixed --out there --assets assets --network eth0 --as me --domain 7 "
            "--seconds 2.5 --only world,gcs --net --json\n");
}

TEST_F(DoctorCommand, TheProgramHasTheUsersEnvironment) {
  const std::filesystem::path told = programs_.dir() / "told";
  write_script(programs_.dir() / "skein_doctor", "echo \"$ROS_DOMAIN_ID\" > " + told.string());
  ::setenv("ROS_DOMAIN_ID", "17", 1);
  EXPECT_EQ(consult_doctor({}), kExitDone);
  ::unsetenv("ROS_DOMAIN_ID");
  EXPECT_EQ(read_text(told), "17\n");
}

TEST_F(DoctorCommand, TheCommandReturnsTheProgramsExitCode) {
  for (const int code : {kExitDone, kExitCheckFailed, kExitBadInput}) {
    write_script(programs_.dir() / "skein_doctor", "exit " + std::to_string(code));
    EXPECT_EQ(consult_doctor({}), code);
  }
  write_script(programs_.dir() / "skein_doctor", "kill -9 $$");
  EXPECT_EQ(consult_doctor({}), kExitProcessFailed);
}

}  // namespace
}  // namespace skein::cli
