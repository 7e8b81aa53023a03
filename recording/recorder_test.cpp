#include "recording/recorder.hpp"

#include <gtest/gtest.h>

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "idl/conversions.hpp"
#include "recording/mcap/join.hpp"
#include "recording/mcap/testing.hpp"
#include "results/run_folder.hpp"

namespace skein::recording {
namespace {

class RecorderTest : public mcap::McapFiles {
 protected:
  std::vector<mcap::Said> part(const std::string& program, int life = 0) {
    return mcap::read_all(folder_ / run_folder::recording_part(program, life));
  }
};

TEST_F(RecorderTest, RecordsPosesTwiceASecondAndAllCommands) {
  {
    Recorder recorder(folder_, programs::kSimServer, Scope::run);
    const bus::Ear pose = recorder.ear("jurong", bus::spec(topics::odometry("jurong")));
    const bus::Ear command = recorder.ear("jurong", bus::spec(topics::gimbal_command("jurong")));
    EXPECT_FALSE(recorder.ear("jurong", bus::spec(topics::clock())).hear);
    const mcap::Bytes payload = encode(msg::Twist());
    for (Tick tick = 0; tick < kTicksPerSecond; tick += 20) {
      recorder.set_time(tick);
      pose.hear(payload);
      command.hear(payload);
      command.hear(payload);
    }
  }
  std::map<std::string, int> counts;
  for (const mcap::Said& said : part(programs::kSimServer)) ++counts[said.topic];
  EXPECT_EQ(counts, (std::map<std::string, int>{{"/jurong/ground_truth/odometry", 2}, {"/jurong/command/gimbal", 40}}));
}

TEST_F(RecorderTest, WritesTheDefinitionsOfItsMessages) {
  msg::Tally tally;
  tally.points(7);
  {
    Recorder recorder(folder_, programs::kStation, Scope::run);
    recorder.set_time(kTicksPerSecond / 2);
    recorder.add("/skein/tally", tally);
    recorder.add("/jurong/odd", "their_msgs::msg::dds_::Odd_", encode(tally));
  }
  mcap::Reader reader(folder_ / run_folder::recording_part(programs::kStation, 0));
  std::vector<std::string> types;
  reader.messages([&](const mcap::Channel& channel, const mcap::Message& message) {
    EXPECT_EQ(message.log_time, 500'000'000U);
    types.push_back(channel.schema_id == 0 ? "" : reader.schemas().at(channel.schema_id).name);
    msg::Tally read;
    ASSERT_TRUE(decode(message.data, read));
    EXPECT_EQ(read, tally);
  });
  EXPECT_EQ(types, (std::vector<std::string>{"skein_msgs/msg/Tally", ""}));
}

TEST_F(RecorderTest, APartOutlivesItsProgramAndTheNextProgramWritesAnother) {
  msg::Tally tally;
  // This recorder is not closed before `next` starts, as if SIGKILL had ended its program.
  auto* dies = new Recorder(folder_, programs::kStation, Scope::run);
  dies->add("/skein/tally", tally);
  dies->flush();
  {
    Recorder next(folder_, programs::kStation, Scope::run);
    next.set_time(4);
    next.add("/skein/tally", tally);
  }
  EXPECT_EQ(part(programs::kStation).size(), 1U);
  EXPECT_EQ(part(programs::kStation, 1).size(), 1U);
  const auto of = [&](int life) { return folder_ / run_folder::recording_part(programs::kStation, life); };
  EXPECT_EQ(mcap::join({of(0), of(1)}, folder_ / run_folder::kRecording, {}), "");
  EXPECT_EQ(mcap::read_all(folder_ / run_folder::kRecording).size(), 2U);
  delete dies;
}

TEST_F(RecorderTest, ARecorderThatRecordsNothingLeavesNoFile) {
  {
    Recorder recorder(folder_, programs::kStation, Scope::none);
    recorder.add("/skein/tally", msg::Tally());
    EXPECT_FALSE(recorder.ear("jurong", bus::spec(topics::odometry("jurong"))).hear);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(RecorderTest, AFolderThatCannotBeWrittenIsReportedWithoutAnException) {
  Recorder recorder(folder_ / "missing", programs::kStation, Scope::run);
  recorder.add("/skein/tally", msg::Tally());
  recorder.close();
  EXPECT_NE(recorder.write_error().find("cannot write"), std::string::npos);
}

}  // namespace
}  // namespace skein::recording
