// A fleet over the engines of a swarm, from a file of `skein compose --stack`: two engines on two hosts, which are
// network namespaces (swarm.sh).
#include <unistd.h>

#include <set>

#include "container_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFar = "node2";  ///< the swarm's other node, which is not a manager
constexpr const char* kPlaces = "jurong=node2,changi=node2";

class Stack : public Containers {
 protected:
  void SetUp() override {
    Containers::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    if (!programs_of_this_build().empty())
      GTEST_SKIP() << "the images are of another build, and a swarm cannot mount this build's programs";
    fs::create_directories(swarm_);
    const Answer up = shell(script() + " up " + swarm_.string() + " skein skein-agent");
    up_ = true;
    if (up.code == 77) GTEST_SKIP() << "a swarm cannot run here: " << up.text;
    ASSERT_EQ(up.code, 0) << up.text;
  }
  void TearDown() override {
    if (up_) shell(script() + " down " + swarm_.string());
    Containers::TearDown();
  }

  static std::string script() { return source_path("tests/containers/swarm.sh"); }
  Answer on(int node, const std::string& command) const {
    return shell("docker --host unix://" + (swarm_ / ("node" + std::to_string(node) + ".sock")).string() + " " +
                 command);
  }
  /// Deploys the file that `skein compose --stack` writes.
  void deploy(Arguments arguments) {
    const std::string file = folder() / "stack.yaml";
    for (const char* word : {"--stack", "--file", file.c_str()}) arguments.emplace_back(word);
    arguments.insert(arguments.begin(), "compose");
    ASSERT_EQ(skein(arguments).wait().code, 0);
    const Answer deployed = on(1, "stack deploy --compose-file " + file + " fleet");
    ASSERT_EQ(deployed.code, 0) << deployed.text;
  }
  std::string state_of(const std::string& program) const {
    return on(1, "service ps --format '{{.Node}} {{.CurrentState}}' fleet_" + program).text;
  }
  bool is_complete(const std::string& program) const { return state_of(program).find("Complete") != std::string::npos; }
  /// Waits until these programs have ended, and merges the files in their nodes' volumes. @returns the result.
  Json merged(const Arguments& programs = kPrograms) {
    for (const std::string& program : programs) {
      EXPECT_TRUE(eventually([&] { return is_complete(program); }, std::chrono::minutes(3)))
          << program << ": " << state_of(program) << on(1, "service logs fleet_" + program).text;
    }
    const fs::path dir = folder() / "results";
    fs::create_directories(dir);
    for (const int node : {1, 2}) {
      for (const std::string& id : words(on(node, "ps --all --quiet").text)) {
        EXPECT_EQ(on(node, "cp " + id + ":/results/. " + dir.string()).code, 0);
      }
    }
    const ChildProcess& merge = skein({"merge", dir, "--scenario", "towers"});
    if (!fs::exists(dir / "result.json")) throw std::runtime_error(merge.err());
    return Json::parse(text_of(dir / "result.json"));
  }

  const fs::path swarm_ = folder() / "swarm";

 private:
  bool up_ = false;
};

TEST_F(Stack, FliesTheSameOverTwoEnginesAsOnOneHost) {
  ASSERT_NO_FATAL_FAILURE(deploy({"towers", "--planner", "kios", "--duration", "60", "--place", kPlaces}));
  const Json result = merged();
  for (const char* program : {"uav_agent-jurong", "uav_agent-changi"}) {
    EXPECT_TRUE(state_of(program).starts_with(kFar)) << state_of(program);
  }
  EXPECT_EQ(result["status"], "completed");
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
  EXPECT_EQ((Flight{result["digest"], result["score"]}), alone(arguments("kios", "60")));
}

TEST_F(Stack, ASecuredFleetTakesItsKeysAlong) {
  ASSERT_EQ(skein({"keys", "towers", "--dds", "fastdds", "--out", folder() / "keys"}).wait().code, 0);
  ASSERT_NO_FATAL_FAILURE(
      deploy({"towers", "--planner", "kios", "--duration", "30", "--dds", "fastdds", "--secure", "--place", kPlaces}));
  const Json result = merged();
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
  EXPECT_EQ((Flight{result["digest"], result["score"]}), alone(arguments("kios", "30")));
}

TEST_F(Stack, AFleetLosesTheUavsOfAnEngineThatVanishes) {
  ASSERT_NO_FATAL_FAILURE(deploy({"towers", "--planner", "kios", "--duration", "600", "--lease", "5", "--place",
                                  "jurong=node2,changi=node2,raffles=node1,sentosa=node1,nanyang=node1"}));
  const auto log = [&] { return on(1, "service logs fleet_sim_server").text; };
  const auto flies = [&] {
    const std::vector<std::string> id = words(on(1, "ps --quiet --filter name=sim_server").text);
    return id.size() == 1 && on(1, "exec " + id[0] + " sed -n 100q1 /results/trajectories.csv").code == 1;
  };
  ASSERT_TRUE(eventually(flies)) << log();
  ASSERT_EQ(shell(script() + " cut " + swarm_.string()).code, 0);
  EXPECT_TRUE(eventually([&] { return is_complete("sim_server"); }, std::chrono::minutes(3))) << log();
  const Json result = merged({"sim_server", "comm_router", "station", "uav_agent-raffles"});
  std::set<std::string> lost;
  for (const Json& one : result["lost_members"]) {
    lost.insert(one["member"].get<std::string>());
    EXPECT_GT(one["time_s"], 0.0) << one;
  }
  EXPECT_EQ(lost, (std::set<std::string>{"changi", "jurong"}));
}

}  // namespace
}  // namespace skein::test
