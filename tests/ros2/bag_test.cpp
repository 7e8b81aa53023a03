// A run's folder as a bag of ROS 2. rosbag2 is not installed, so @mcap/core reads the recording, and a small player
// plays it as rosbag2 would, for an rclcpp node, which must receive the recorded messages.
#include <fstream>
#include <sstream>

#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "packages_fixture.hpp"
#include "recording/mcap/reader.hpp"
#include "results/run_folder.hpp"
#include "tests/free_domain.hpp"
#include "tests/recording/independent_reader.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

constexpr const char* kTopics[] = {"/jurong/ground_truth/odometry",
                                   "/jurong/gimbal",
                                   "/jurong/command/trajectory",
                                   "/gcs/bounding_box_vertices",
                                   "/tf",
                                   "/tf_static"};
constexpr const char* kLatched[] = {"/gcs/bounding_box_vertices", "/tf_static"};

using Stamps = std::map<std::string, std::vector<std::int64_t>>;  ///< by topic [ns]

template <class Message>
std::int64_t stamp_of(std::span<const std::uint8_t> data) {
  Message message;
  EXPECT_TRUE(decode(data, message));
  const auto nanoseconds = [](const msg::Header& header) {
    return header.stamp().sec() * std::int64_t{1'000'000'000} + header.stamp().nanosec();
  };
  if constexpr (std::is_same_v<Message, msg::TFMessage>) {
    return nanoseconds(message.transforms().at(0).header());
  } else {
    return nanoseconds(message.header());
  }
}

Stamps recorded_in(const std::filesystem::path& file) {
  Stamps stamps;
  mcap::Reader reader(file);
  reader.messages([&](const mcap::Channel& channel, const mcap::Message& message) {
    const std::string& topic = channel.topic;
    if (std::ranges::find(kTopics, topic) == std::end(kTopics)) return;
    const auto stamp = topic.ends_with("odometry")       ? stamp_of<msg::Odometry>
                       : topic.ends_with("gimbal")       ? stamp_of<msg::TwistStamped>
                       : topic.ends_with("trajectory")   ? stamp_of<msg::MultiDOFJointTrajectory>
                       : topic.ends_with("box_vertices") ? stamp_of<msg::PointCloud>
                                                         : stamp_of<msg::TFMessage>;
    stamps[topic].push_back(stamp(message.data));
  });
  return stamps;
}

class Bag : public ExtraMessagesTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    ExtraMessagesTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    const std::string why = install_reader(source_path("tests/ros2/bag/dump.mjs"));
    if (!why.empty()) GTEST_SKIP() << why;
    const std::string to = build_path("ros2_bag_listener");
    ChildProcess& build =
        start_looker("fastrtps", 1,
                     "flock " + to + ".lock sh -c 'cmake -G Ninja -S " + source_path("tests/ros2/bag") + " -B " + to +
                         " -DCMAKE_PREFIX_PATH=" + build_path("ros2_packages") + " && cmake --build " + to + "'");
    const auto is_built = [&] { return build.ended().has_value(); };
    ASSERT_TRUE(eventually(is_built, std::chrono::minutes(5)));
    ASSERT_EQ(build.wait().code, 0) << build.out() << build.err();
  }

  ChildProcess& start_listener(int domain, const std::string& name) {
    return start_looker(GetParam(), domain, build_path("ros2_bag_listener/listen ") + (folder() / name).string());
  }
  Stamps heard_by(const std::string& name) const {
    Stamps stamps;
    std::ifstream lines(folder() / (name + ".heard"));
    std::string topic;
    for (std::int64_t stamp = 0; lines >> topic >> stamp;) stamps[topic].push_back(stamp);
    return stamps;
  }
};

TEST_P(Bag, IsPlayedIntoRclcppAsItWasRecorded) {
  SkeinRun& flown = run("flown", {"towers", "--planner", "patrol", "--stop-at", "20"});
  const std::filesystem::path recording = flown.dir() / run_folder::kRecording;
  std::string command = "node " + reader_folder() + "/dump.mjs " + recording.string();
  for (const char* topic : kTopics) command += std::string(" ") + topic;
  const std::string dump = folder() / "dump", stay = folder() / "stay", heard = folder() / "listener.heard";
  ASSERT_EQ(std::system((command + " >" + dump).c_str()), 0);

  // Not in the domain of the flight, because another fleet may use it by now and publish its own /tf there.
  const FreeDomains domains(1);
  const int domain = domains.base();
  ChildProcess& listener = start_listener(domain, "listener");
  ChildProcess& player = start_looker(
      GetParam(), domain, "python3 " + source_path("tests/ros2/bag/play.py ") + dump + " " + stay + " " + heard);
  const auto exists = [](const std::string& file) { return [file] { return std::filesystem::exists(file); }; };
  ASSERT_TRUE(eventually(exists(stay + ".played"))) << player.err() << listener.err();
  // A listener that starts after the player still receives the latched topics.
  ChildProcess& late = start_listener(domain, "late");
  const auto has_latched = [&] { return heard_by("late").size() == std::size(kLatched); };
  EXPECT_TRUE(eventually(has_latched)) << late.err();
  std::ofstream(stay).close();
  EXPECT_EQ(player.wait().code, 0) << player.err();
  EXPECT_EQ(listener.wait().code, 0) << listener.err();
  EXPECT_EQ(late.wait().code, 0) << late.err();

  const Stamps recorded = recorded_in(recording);
  EXPECT_EQ(recorded.size(), std::size(kTopics));
  EXPECT_GT(recorded.at("/tf").size(), 50U);
  EXPECT_EQ(heard_by("listener"), recorded);
  for (const char* topic : kLatched) EXPECT_EQ(heard_by("late")[topic], recorded.at(topic)) << topic;
  EXPECT_EQ(heard_by("late").size(), std::size(kLatched));
}

INSTANTIATE_TEST_SUITE_P(Middlewares, Bag, testing::Values("cyclonedds", "fastrtps"),
                         [](const auto& middleware) { return std::string(middleware.param); });

}  // namespace
}  // namespace skein::test
