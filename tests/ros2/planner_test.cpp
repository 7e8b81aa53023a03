// Planners that are ROS 2 nodes (ros2/skein_ros): they fly and score in the lock-step, identically over both
// middlewares and in each repetition, and messages name forbidden behaviour.
#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>
#include <tuple>

#include "core/radio/radio_routes.hpp"
#include "core/topics.hpp"
#include "idl/filled_message.hpp"
#include "ros2/skein_ros/src/step/fleet_topics.hpp"
#include "tests/support/places.hpp"
#include "workspace_fixture.hpp"

namespace skein::test {
namespace {

constexpr const char* kMiddlewares[] = {"cyclonedds", "fastrtps"};

class RosPlanner : public WorkspaceTest {};

TEST_F(RosPlanner, FliesTheSameOverAllMiddlewaresAndVendors) {
  const Arguments flight = {"towers", "--planner", "hover,jurong=ros:skein_ros_examples/circle", "--duration", "60"};
  std::set<std::string> digests;
  for (const auto* middleware : kMiddlewares) {
    // The fleet uses the other vendor; in one case, its messages are delayed and reordered.
    const bool other = std::string(middleware) == "cyclonedds";
    const Environment chaos = other ? Environment{} : Environment{{"SKEIN_CHAOS", "38"}};
    SkeinRun& done =
        run_with(middleware, middleware, joined(flight, {"--dds", other ? "fastdds" : "cyclonedds"}), 0, chaos);
    const Json result = done.result();
    EXPECT_EQ(result["status"], "completed");
    EXPECT_TRUE(result["deterministic"]) << done.err();
    EXPECT_EQ(result["uavs"][0]["commands_rejected"], 0);
    EXPECT_GT(result["score_by_uav"]["jurong"], 1.0) << "captures of the node's UAV did not reach the station";
    digests.insert(done.digest());
    EXPECT_NE(text_of(done.dir() / "activity.csv").find(",jurong,circles,"), std::string::npos);
  }
  EXPECT_EQ(digests.size(), 1U);
}

TEST_F(RosPlanner, InPythonFliesBesideAnOrdinaryRosNode) {
  const std::string climber = "ros:skein_ros/run_in_step libplain_node.so:plain::Climber --ros-args -p height_m:=4.0";
  const Arguments flight = {"towers", "--planner", "hover,jurong=ros:skein_ros_examples/climb.py,sentosa=" + climber,
                            "--duration", "20"};
  std::set<std::string> digests;
  for (const auto* middleware : kMiddlewares) {
    SkeinRun& done = run_with(middleware, middleware, flight);
    const Json result = done.result();
    EXPECT_TRUE(result["deterministic"]) << done.err();
    EXPECT_NEAR(result["uavs"][0]["distance_m"].get<double>(), 6.0, 1.0)
        << "the node did not fly its UAV to its height and stop there";
    EXPECT_NEAR(result["uavs"][2]["distance_m"].get<double>(), 4.0, 0.7)
        << "the wall timer or the parameter of the node does not work";
    EXPECT_GT(result["radio"]["sent"], 300) << "the node must send a radio message in each step";
    digests.insert(done.digest());
  }
  EXPECT_EQ(digests.size(), 1U);
}

TEST_F(RosPlanner, FliesOnAfterAFaultKillsOrStopsIt) {
  const auto faults = write("faults.yaml",
                            "faults:\n"
                            "  - {at_s: 4, until_s: 6, kill: jurong}\n"
                            "  - {at_s: 9, until_s: 11, pause: sentosa}\n");
  const Arguments flight = {
      "towers",     "--planner", "hover,jurong=ros:skein_ros_examples/circle,sentosa=ros:skein_ros_examples/circle",
      "--duration", "25",        "--faults",
      faults};
  std::set<std::string> digests;
  for (const auto* middleware : kMiddlewares) {
    SkeinRun& done = run_with(middleware, middleware, flight);
    EXPECT_TRUE(done.result()["deterministic"]) << done.err();
    EXPECT_GT(done.result()["uavs"][0]["distance_m"], 10.0);
    digests.insert(done.digest());
  }
  EXPECT_EQ(digests.size(), 1U);
}

/// The words in a file of /proc of a process.
std::vector<std::string> words_in(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

// The fleet does not wait for a node that a fault keeps away from the start on; it joins later, and flies identically
// each time.
TEST_F(RosPlanner, FliesIfItJoinsLate) {
  const auto faults = write("faults.yaml", "faults:\n  - {at_s: 0.05, until_s: 6, kill: jurong}\n");
  const Arguments flight = {"towers",   "--planner", "hover,jurong=ros:skein_ros_examples/circle", "--duration", "20",
                            "--faults", faults};
  std::set<std::string> digests;
  for (const auto* middleware : kMiddlewares) {
    SkeinRun& done = run_with(middleware, middleware, flight);
    EXPECT_TRUE(done.result()["deterministic"]) << done.err();
    EXPECT_GT(done.result()["uavs"][0]["distance_m"], 8.0);
    digests.insert(done.digest());
  }
  EXPECT_EQ(digests.size(), 1U);
}

// The node is killed from outside, and restarted by hand with the command and the environment from the launcher.
TEST_F(RosPlanner, FliesOnAfterItIsKilledAndRestartedByHand) {
  for (const auto* middleware : kMiddlewares) {
    SkeinRun& fleet = start_with(middleware, middleware,
                                 {"towers", "--planner", "hover,jurong=ros:skein_ros_examples/circle", "--clock",
                                  "realtime:4", "--duration", "600", "--no-oracle"});
    ASSERT_TRUE(fleet.wait_until_flying()) << fleet.err();
    const pid_t node = processes_of(fleet.dir()).at("uav_agent-jurong");
    const std::filesystem::path proc = "/proc/" + std::to_string(node);
    const Arguments argv = words_in(proc / "cmdline");
    Environment environment;
    for (const std::string& entry : words_in(proc / "environ")) {
      environment[entry.substr(0, entry.find('='))] = entry.substr(entry.find('=') + 1);
    }
    ASSERT_EQ(::kill(node, SIGKILL), 0);
    const std::filesystem::path log = fleet.dir() / "sim_server.log";
    ASSERT_TRUE(eventually([&] { return text_of(log).find("jurong is lost") != std::string::npos; })) << text_of(log);
    ChildProcess& again = start_program(std::string("again_") + middleware, argv, environment);
    ASSERT_TRUE(fleet.wait_for("jurong was started again by hand")) << fleet.err() << again.err();
    const auto flown_s = [&] {
      const auto rows = read_csv(fleet.dir() / "trajectories.csv", LastLine::may_be_unfinished);
      return rows.empty() ? 0.0 : std::stod(rows[rows.size() - kFleet.size()].at("time_s"));
    };
    const double back_s = flown_s();
    EXPECT_TRUE(eventually([&] { return flown_s() > back_s + 15.0; })) << fleet.err() << again.err();
    fleet.skein().signal(SIGINT);
    fleet.exit_code();
    again.wait();
    const Json lost = fleet.result()["lost_members"];
    ASSERT_EQ(lost.size(), 1U);
    ASSERT_TRUE(lost[0]["back_at_s"].is_number()) << lost;
    std::set<int> places;  // x coordinates on its circle, in whole metres
    for (const auto& row : read_csv(fleet.dir() / "trajectories.csv")) {
      const bool since = std::stod(row.at("time_s")) > lost[0]["back_at_s"].get<double>() + 2.0;
      if (since && row.at("uav") == "jurong") places.insert(static_cast<int>(std::stod(row.at("x"))));
    }
    EXPECT_GT(places.size(), 3U) << "the UAV does not fly on its circle after the restart";
  }
}

// The node uses its UAV's certificate and the fleet's vendor as middleware. Another vendor is refused before the start.
TEST_F(RosPlanner, FliesInASecuredFleetOfItsVendor) {
  const Arguments flight = {"towers", "--planner", "hover,jurong=ros:skein_ros_examples/circle", "--duration", "10"};
  std::set<std::string> digests = {run_with("cyclonedds", "open", flight).digest()};
  for (const auto& [middleware, vendor, other] :
       {std::tuple("cyclonedds", "cyclonedds", "fastdds"), {"fastrtps", "fastdds", "cyclonedds"}}) {
    SkeinRun& done = run_with(middleware, middleware, joined(flight, {"--secure", "--dds", vendor}));
    EXPECT_TRUE(done.result()["deterministic"]) << done.err();
    EXPECT_GT(done.result()["uavs"][0]["distance_m"], 5.0);
    digests.insert(done.digest());
    const std::string refused = std::string("refused_") + middleware;
    const std::string why = run_with(middleware, refused, joined(flight, {"--secure", "--dds", other}), 2).err();
    EXPECT_NE(why.find("RMW_IMPLEMENTATION="), std::string::npos) << why;
  }
  EXPECT_EQ(digests.size(), 1U);
}

// The fleet waits for a slow node, and the result is the same.
TEST_F(RosPlanner, FliesTheSameIfItAnswersSlowly) {
  std::set<std::string> digests;
  for (const char* what : {"nothing", "hesitate"}) {
    const std::string node = "exec:python3 " + source_path("tests/ros2/odd_node.py") + " " + what;
    SkeinRun& done = run_with("fastrtps", what, {"towers", "--planner", "hover,jurong=" + node, "--duration", "10"});
    EXPECT_TRUE(done.result()["deterministic"]) << done.err();
    digests.insert(done.digest());
  }
  EXPECT_EQ(digests.size(), 1U);
}

struct Oddity {
  const char* what;
  const char* word;
};

class OddRosPlanner : public WorkspaceTest, public testing::WithParamInterface<Oddity> {};

TEST_P(OddRosPlanner, IsNamedAndTheRunGoesOn) {
  const std::string node = "exec:python3 " + source_path("tests/ros2/odd_node.py") + " " + GetParam().what;
  SkeinRun& done =
      run_with("cyclonedds", "run",
               {"towers", "--planner", "hover,jurong=" + node, "--duration", "20", "--agent-timeout", "5"}, 3);
  const Json result = done.result();
  EXPECT_EQ(result["status"], "completed");
  ASSERT_EQ(result["lost_members"].size(), 1U);
  EXPECT_EQ(result["lost_members"][0]["member"], "jurong");
  const std::string all = log_of(done) + result["lost_members"].dump();
  EXPECT_NE(all.find(GetParam().word), std::string::npos) << all;
}

INSTANTIATE_TEST_SUITE_P(Oddities, OddRosPlanner,
                         testing::Values(Oddity{"thread", "publishes on /plan in a second thread"},
                                         Oddity{"throw", "the planner threw: no way ahead"},
                                         Oddity{"service", "a call of the service /another/get_parameters"},
                                         Oddity{"late", "made after the node's first wait"},
                                         Oddity{"stall", "did not answer"}),
                         [](const auto& oddity) { return oddity.param.what; });

TEST_F(RosPlanner, IsRefusedBeforeTheStartIfItDoesNotExist) {
  const auto expect_error = [&](const std::string& planner, const std::string& word) {
    SkeinRun& refused = run_with("cyclonedds", "refused", {"towers", "--planner", planner, "--force"}, 2);
    EXPECT_NE(refused.err().find(word), std::string::npos) << refused.err();
  };
  expect_error("ros:skein_ros_examples/cirkle", "did you mean 'circle'?");
  expect_error("ros:skein_ros_exampels/circle", "did you mean 'skein_ros_examples'?");
  expect_error("ros:circle", "write ros:PACKAGE/EXECUTABLE");
  SkeinRun& without = run("without", {"towers", "--planner", "ros:a/b"}, {{"AMENT_PREFIX_PATH", ""}}, 2);
  EXPECT_NE(without.err().find("AMENT_PREFIX_PATH is not set"), std::string::npos) << without.err();
}

std::vector<std::uint8_t> bytes_of(const std::string& hexadecimal) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hexadecimal.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

std::string hexadecimal(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

/// Decodes bytes as a message of one of Skein's types, and encodes it again; nullopt: they are no such message.
using Again = std::function<std::optional<std::vector<std::uint8_t>>(const std::vector<std::uint8_t>& bytes)>;
template <class Message>
std::optional<std::vector<std::uint8_t>> again(const std::vector<std::uint8_t>& bytes) {
  Message message;
  if (!decode(bytes, message)) return std::nullopt;
  return encode(message);
}

template <class... Messages>
std::map<std::string, Again> all_types(testing::Types<Messages...>) {
  return {{type_name<Messages>(), again<Messages>}...};
}

class RosMessages : public WorkspaceTest, public testing::WithParamInterface<const char*> {};

TEST_P(RosMessages, AreTheSameBytesForRosAndForSkein) {
  constexpr const char* kCount = "40";
  const auto script = [&](const char* what, const std::string& file) {
    ChildProcess& python = start_node(
        what, GetParam(), 0, "",
        with_workspace("python3 " + source_path("tests/ros2/message_bytes.py ") + what + " " + file + " " + kCount));
    ASSERT_EQ(python.wait().code, 0) << python.err();
  };
  const std::string theirs = folder() / "theirs", ours = folder() / "ours";
  script("write", theirs);
  const auto types = all_types(AllMessageTypes());
  std::set<std::string> seen;
  std::ifstream lines(theirs);
  std::ofstream out(ours);
  for (std::string line; std::getline(lines, line);) {
    Json entry = Json::parse(line);
    const std::string type = entry["type"];
    ASSERT_TRUE(types.contains(type)) << type;
    seen.insert(type);
    auto bytes = types.at(type)(bytes_of(entry["bytes"]));
    ASSERT_TRUE(bytes) << line;
    const std::size_t length = bytes_of(entry["bytes"]).size();
    // Skein pads a message to a multiple of four bytes, as in a datagram.
    for (; bytes->size() > length && bytes->size() % 4 != 1; bytes->pop_back()) ASSERT_EQ(bytes->back(), 0) << type;
    // rmw_fastrtps writes arbitrary bytes as padding, and also pads after an empty sequence. With it, the test compares
    // only the messages that ROS 2 reads from Skein's bytes.
    if (std::string(GetParam()) == "cyclonedds") {
      ASSERT_EQ(hexadecimal(*bytes), entry["bytes"]) << type;
    }
    entry["bytes"] = hexadecimal(*bytes);
    out << entry.dump() << "\n";
  }
  out.close();
  script("read", ours);
  for (const auto& [type, unused] : types) {
    const bool ours_alone = type.starts_with("skein_msgs::");
    EXPECT_TRUE(!ours_alone || seen.contains(type)) << type << " was not compared";
  }
}

INSTANTIATE_TEST_SUITE_P(Middlewares, RosMessages, testing::ValuesIn(kMiddlewares),
                         [](const auto& middleware) { return std::string(middleware.param); });

TEST(RosPage, ShowsThePlannersOfTheExamples) {
  const std::string page = text_of(source_path("docs/how-to-ros2.md"));
  for (const char* file : {"circle.cpp", "climb.py"}) {
    const std::string text = text_of(source_path("ros2/skein_ros_examples/src/") + file);
    ASSERT_FALSE(text.empty()) << file;
    EXPECT_NE(page.find("\n" + text + "```"), std::string::npos) << file;
  }
}

TEST(RosMessageFiles, HaveTheFieldsOfTheIdl) {
  EXPECT_EQ(std::system(("python3 " + source_path("ros2/generate_messages.py") + " --check").c_str()), 0);
}

// The package has its own table of topics, because it does not need Skein.
TEST(RosTopics, AgreeWithSkeinsTable) {
  const auto way = [](const topics::TopicInfo& topic) {
    return topic.direction == topics::Direction::from_agent ? skein_ros::Way::from_node : skein_ros::Way::to_node;
  };
  std::size_t expected = 0;
  for (const topics::TopicInfo& topic : topics::uav_topics()) {
    const bool counted =
        topic.direction == topics::Direction::to_agent || topic.direction == topics::Direction::from_agent;
    if (!counted || topic.pattern == topics::kHand.pattern) continue;  // a UAV with a node is not flown by hand
    ++expected;
    const auto found = std::ranges::find_if(skein_ros::kFleetTopics,
                                            [&](const auto& entry) { return entry.pattern == topic.pattern; });
    ASSERT_NE(found, std::end(skein_ros::kFleetTopics)) << topic.pattern;
    EXPECT_EQ(found->way, way(topic)) << topic.pattern;
    EXPECT_EQ(found->depth, topic.depth) << topic.pattern;
    EXPECT_EQ(found->latched, topic.latched) << topic.pattern;
    EXPECT_EQ(found->explorers_only, topic.explorers_only) << topic.pattern;
  }
  EXPECT_EQ(std::size(skein_ros::kFleetTopics), expected);
  EXPECT_EQ(skein_ros::kRadioDepth, topics::kRadioDepth);
  EXPECT_EQ(skein_ros::kArrivalDepth, topics::radio_depth(topics::kMostRadioSources));
}

}  // namespace
}  // namespace skein::test
