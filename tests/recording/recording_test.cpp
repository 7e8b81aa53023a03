// recording.mcap of whole fleets: the same for each way to fly, consistent with the tables, and readable by other
// software.
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <random>

#include "fleet_fixture.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"
#include "independent_reader.hpp"
#include "recording/mcap/reader.hpp"
#include "results/run_folder.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

/// Number of messages of each topic, and the messages of two topics.
struct Recorded {
  explicit Recorded(const fs::path& file) {
    mcap::Reader reader(file);
    complete = reader.complete();
    reader.messages([&](const mcap::Channel& channel, const mcap::Message& message) {
      ++topics[channel.topic];
      last_s = std::max(last_s, static_cast<double>(message.log_time) / 1e9);
      if (channel.topic == "/skein/events") decode(message.data, events.emplace_back());
      if (channel.topic == "/skein/tally") decode(message.data, tally);
    });
  }

  bool complete = false;
  std::map<std::string, int> topics;
  double last_s = 0.0;
  std::vector<msg::Event> events;
  msg::Tally tally;  ///< the last one
};

class Recording : public FleetTest {
 protected:
  static fs::path file(const SkeinRun& run) { return run.dir() / run_folder::kRecording; }

  /// Skips the test if the packages of check.mjs cannot be installed.
  void need_independent_reader() {
    const std::string why = install_reader(source_path("tests/recording/check.mjs"));
    if (!why.empty()) GTEST_SKIP() << why;
  }
  /// The output of check.mjs. @param mode  "" or "stream"
  Json read_by_others(const fs::path& recording, const std::string& mode = "") {
    const fs::path answer = folder() / "answer.json";
    const std::string command = "node " + reader_folder() + "/check.mjs " + recording.string() + " " + mode + " >" +
                                answer.string() + " 2>" + (folder() / "check.err").string();
    EXPECT_EQ(std::system(command.c_str()), 0) << text_of(folder() / "check.err");
    return Json::parse(text_of(answer), nullptr, false);
  }
};

TEST_F(Recording, IsIdenticalOverDdsAndInOneProcess) {
  std::mt19937 draw(static_cast<unsigned>(::getpid()));
  const Arguments common = {"towers",
                            "--planner",
                            "kios",
                            "--seed",
                            std::to_string(1 + draw() % 1000),
                            "--scene-seed",
                            std::to_string(draw() % 1000),
                            "--duration",
                            "40"};
  const auto with = [&](Arguments more) {
    more.insert(more.begin(), common.begin(), common.end());
    return more;
  };
  SkeinRun& over_dds = run("over_dds", with({"--dds", "mixed"}));
  SkeinRun& one_process = run("one_process", with({"--one-process"}));
  SkeinRun& without = run("without", with({"--one-process", "--record=none"}));
  ASSERT_GT(fs::file_size(file(over_dds)), 10'000U);
  EXPECT_TRUE(text_of(file(over_dds)) == text_of(file(one_process))) << "the recordings differ";
  EXPECT_EQ(over_dds.digest(), without.digest()) << "recording changed the run";
  EXPECT_FALSE(fs::exists(file(without)));
  for (const SkeinRun* run : {&over_dds, &one_process, &without}) {
    for (const auto& entry : fs::directory_iterator(run->dir())) {
      EXPECT_TRUE(entry.path().extension() != ".mcap" || entry.path() == file(*run)) << entry.path() << " is left over";
    }
  }
}

TEST_F(Recording, AgreesWithTheTables) {
  const std::string faults = write("faults.yaml", "faults:\n  - {at_s: 20, until_s: 30, station_outage: true}\n");
  SkeinRun& flown = run("flown", {"towers", "--planner", "patrol", "--duration", "60", "--faults", faults});
  const Recorded recorded(file(flown));
  EXPECT_TRUE(recorded.complete);
  const auto rows = read_csv(flown.dir() / run_folder::kEvents);
  std::size_t row = 0;
  int faults_told = 0;
  for (const msg::Event& event : recorded.events) {
    if (event.event() == "fault") {
      ++faults_told;
      continue;
    }
    ASSERT_LT(row, rows.size());
    EXPECT_EQ(event.event(), rows[row].at("event"));
    EXPECT_EQ(event.subject(), rows[row].at("subject"));
    EXPECT_EQ(event.object(), rows[row].at("object"));
    EXPECT_EQ(std::to_string(event.step()), rows[row].at("step"));
    ++row;
  }
  EXPECT_EQ(row, rows.size());
  EXPECT_EQ(faults_told, 2) << "the begin and the end of the fault";
  EXPECT_GT(flown.result()["score"], 0.0);
  EXPECT_DOUBLE_EQ(recorded.tally.score(), flown.result()["score"]);
  EXPECT_EQ(recorded.tally.points(), flown.result()["points_detected"]);
  EXPECT_GT(recorded.topics.at("/tf"), 290);
  EXPECT_GT(recorded.topics.at("/viz/frusta"), 59);
  EXPECT_EQ(recorded.topics.at("/viz/structure"), 1);
  for (const std::string& uav : kFleet) {
    EXPECT_GT(recorded.topics.at("/" + uav + "/ground_truth/odometry"), 100) << uav;
    EXPECT_GT(recorded.topics.at("/" + uav + "/command/trajectory"), 500) << uav;
  }
}

// The programs that record are killed in the middle of a chunk; no other program has the data of this chunk.
TEST_F(Recording, LosesNothingWhenAFaultKillsARecordingProgram) {
  const auto killed = [&](const std::string& name, const std::string& program) {
    const std::string faults = write(name + ".yaml", "faults:\n  - {at_s: 23.4, until_s: 26, kill: " + program + "}\n");
    return Arguments{"towers", "--planner", "patrol", "--duration", "40", "--faults", faults};
  };
  for (const std::string program : {"comm_router", "station"}) {
    Arguments arguments = killed(program, program);
    SkeinRun& over_dds = run(program, arguments);
    arguments.push_back("--one-process");
    SkeinRun& one_process = run(program + "_one", arguments);
    EXPECT_EQ(over_dds.digest(), one_process.digest());
    EXPECT_TRUE(text_of(file(over_dds)) == text_of(file(one_process))) << "the recordings differ";
    const Recorded recorded(file(over_dds));
    EXPECT_TRUE(recorded.complete);
    EXPECT_GT(recorded.last_s, 40.0);
    EXPECT_DOUBLE_EQ(recorded.tally.score(), over_dds.result()["score"]);
  }
}

TEST_F(Recording, HasMoreOnRequest) {
  const Arguments common = {"towers", "--planner", "hover,changi=patrol", "--duration", "70", "--one-process"};
  std::map<std::string, Recorded> by_scope;
  for (const std::string scope : {"run", "all", "clouds"}) {
    Arguments arguments = common;
    arguments.push_back("--record=" + scope);
    by_scope.emplace(scope, file(run(scope, arguments)));
  }
  const std::string left = "/jurong/nbr_odom_cloud", cloud = "/jurong/cloud_inW";  // hover does not read clouds
  EXPECT_FALSE(by_scope.at("run").topics.contains(left));
  EXPECT_GT(by_scope.at("all").topics.at(left), 390);
  EXPECT_FALSE(by_scope.at("run").topics.contains("/gcs/score"));
  EXPECT_GT(by_scope.at("all").topics.at("/gcs/score"), 3);
  EXPECT_FALSE(by_scope.at("all").topics.contains(cloud));
  EXPECT_GT(by_scope.at("clouds").topics.at(cloud), 150);
  for (const auto& [topic, count] : by_scope.at("run").topics) {
    EXPECT_EQ(by_scope.at("clouds").topics.at(topic), count) << topic;
  }
}

TEST_F(Recording, IsReadByIndependentSoftware) {
  need_independent_reader();
  if (IsSkipped()) return;
  SkeinRun& flown = run("flown", {"towers", "--planner", "kios", "--duration", "60", "--record=clouds"});
  const Recorded recorded(file(flown));
  for (const std::string mode : {"", "stream"}) {
    SCOPED_TRACE(mode);
    const Json found = read_by_others(file(flown), mode);
    ASSERT_TRUE(found.is_object());
    EXPECT_EQ(found["topics"].get<decltype(recorded.topics)>(), recorded.topics);
    EXPECT_DOUBLE_EQ(found["tally"]["score"], flown.result()["score"]);
    EXPECT_EQ(found["metadata"]["skein"]["digest"], flown.digest());
    EXPECT_EQ(found["types"]["/jurong/cloud_inW"], "sensor_msgs/msg/PointCloud2");
    if (mode == "stream") {
      EXPECT_EQ(found.value("dataEnd", false), true) << "a complete file must have the record DataEnd";
      EXPECT_EQ(found.value("complete", false), true);
    } else {  // read by the index, because chunks of several programs overlap in the file
      EXPECT_EQ(found["ordered"], true) << "messages are not ordered by log time";
      EXPECT_EQ(found["statistics"], found["messages"]) << "the record Statistics has other numbers of messages";
      EXPECT_GT(found["chunks"], 0);
    }
  }
}

// If all programs are killed, the parts remain, and Skein and other software can read them up to their ends.
TEST_F(Recording, OfAKilledRunIsReadUpToItsEnd) {
  need_independent_reader();
  if (IsSkipped()) return;
  SkeinRun& flown = start("flown", {"towers", "--planner", "patrol", "--clock", "realtime:20"});
  const fs::path part = flown.dir() / run_folder::recording_part(programs::kSimServer, 0);
  ASSERT_TRUE(flown.wait_until_flying());
  ASSERT_TRUE(eventually([&] { return fs::exists(part) && Recorded(part).last_s >= 15.0; }));
  for (const auto& [name, pid] : processes_of(flown.dir())) ::kill(pid, SIGKILL);
  EXPECT_NE(flown.exit_code(), 0);
  const fs::path left = fs::exists(part) ? part : file(flown);
  const Recorded recorded(left);
  EXPECT_GT(recorded.last_s, 5.0);
  const Json found = read_by_others(left, "stream");
  EXPECT_FALSE(found.contains("dataEnd")) << "the file must end without the record DataEnd";
  EXPECT_EQ(found["topics"].get<decltype(recorded.topics)>(), recorded.topics);
}

}  // namespace
}  // namespace skein::test
