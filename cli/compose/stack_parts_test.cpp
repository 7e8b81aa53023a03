// Files for `docker stack`, for random fleets: on which node each program runs, and which files go there with it.
#include "cli/compose/stack_parts.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <random>

#include "cli/compose/compose_file.hpp"
#include "cli/testing/compose_reader.hpp"
#include "host/supervisor.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/files/security_files.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

const Texts kTruth = {"mesh.stl", "points.pcd", "boxes.yaml"};
constexpr unsigned kStacks = 20;

class StackParts : public testing::Test {
 protected:
  struct Stack {
    FleetPlan plan;
    ComposeLayout layout;
    bool scene_files = false;
  };

  Stack draw(unsigned seed) const {
    std::mt19937 random(seed);
    const auto coin = [&] { return std::bernoulli_distribution(0.5)(random); };
    Stack stack;
    stack.scene_files = coin();
    fs::create_directories(dir_);
    for (const std::string& file : kTruth) write_text(dir_ / file, "");
    write_text(dir_ / "parameters.yaml", "");
    std::string text = "name: drawn\ndesired_mm_per_pixel: 2.0\nscene: ";
    text +=
        stack.scene_files ? "{meshes: [./mesh.stl], points: ./points.pcd, boxes: ./boxes.yaml}" : "{family: towers}";
    text += "\nfleet:\n";
    const int uavs = std::uniform_int_distribution(1, 9)(random);
    for (int i = 0; i < uavs; ++i)
      text += fmt::format("  - {{name: u{}, vehicle: explorer, start: [{}, 0]}}\n", i, 10 * i);
    write_text(dir_ / "drawn.yaml", text);
    RunOptions run;
    run.scenario = dir_ / "drawn.yaml";
    run.planner = "hover";
    run.secure = coin();
    if (coin()) run.lease_s = std::uniform_int_distribution(1, 3600)(random);
    stack.plan = plan_fleet(run, programs_.dir());
    if (coin()) stack.plan.planners[0].spec = "hover:" + (dir_ / "parameters.yaml").string();
    stack.layout.stack = true;
    for (int i = 0; i < uavs; ++i) {
      if (coin()) stack.layout.nodes[programs::agent_program("u" + std::to_string(i))] = "node" + std::to_string(i % 3);
    }
    if (coin()) stack.layout.subnet = parse_subnet("172.30.0.0/20");
    return stack;
  }

  const FakePrograms programs_;
  const fs::path dir_ = programs_.dir() / "a 'b'";
};

TEST_F(StackParts, ProgramsRunOnTheirNodesAndEachAgentGetsOnlyItsOwnFiles) {
  for (unsigned seed = 0; seed < kStacks && !HasFailure(); ++seed) {
    SCOPED_TRACE("stack " + std::to_string(seed));
    const Stack stack = draw(seed);
    const std::string text = compose_file(stack.plan, stack.layout);
    const Compose file(text);
    const YAML::Node root = YAML::Load(text);
    for (const std::string& network : file.networks()) {
      EXPECT_EQ(file.network(network)["driver"].as<std::string>(), "overlay");
      EXPECT_TRUE(file.network(network)["internal"].as<bool>());
    }
    for (const std::string& service : file.services()) {
      const YAML::Node deploy = file.of(service, "deploy");
      EXPECT_EQ(deploy["endpoint_mode"].as<std::string>(), "dnsrr")
          << "DDS finds no peers behind the virtual address of a service";
      const auto node = stack.layout.nodes.find(service);
      const bool agent = programs::is_agent(service);
      const std::string where = node != stack.layout.nodes.end() ? "node.hostname == " + node->second
                                : agent                          ? ""
                                                                 : "node.role == manager";
      const YAML::Node placement = deploy["placement"];
      const Texts constraints = placement ? texts_of(placement["constraints"]) : Texts();
      EXPECT_EQ(constraints, where.empty() ? Texts() : Texts{where}) << service;
      EXPECT_FALSE(file.of(service, "healthcheck")) << "DNS has no name for a service that is not healthy yet";
      EXPECT_EQ(file.option(service, "--lease"), std::to_string(stack.plan.options.lease_s.value_or(10)));
      Texts sent;
      for (const YAML::Node& config : file.of(service, "configs")) {
        sent.push_back(root["configs"][config["source"].as<std::string>()]["file"].as<std::string>());
      }
      const auto has = [](const Texts& files, const std::string& name) {
        return std::ranges::any_of(files, [&](const std::string& one) { return one.ends_with("/" + name); });
      };
      EXPECT_EQ(has(sent, "drawn.yaml"), agent) << service;
      for (const std::string& truth : kTruth) EXPECT_FALSE(has(sent, truth)) << service;
      Texts mounted;
      for (const auto& [there, here] : file.mounts(service)) mounted.push_back(here);
      EXPECT_EQ(has(mounted, "points.pcd"), stack.scene_files && service == programs::kSimServer);
      if (agent) {
        EXPECT_EQ(mounted.size(), 1U) << "only its results folder is mounted";
      }
      Texts keys;
      for (const YAML::Node& secret : file.of(service, "secrets")) {
        keys.push_back(filled_in(root["secrets"][secret["source"].as<std::string>()]["file"].as<std::string>()));
        EXPECT_EQ(secret["mode"].as<int>(), 0400);
      }
      EXPECT_EQ(keys.size(), stack.plan.options.secure ? security_files::kAll.size() : 0U);
      for (const std::string& key : keys) EXPECT_TRUE(key.starts_with("./keys/" + service + "/")) << key;
    }
  }
}

TEST_F(StackParts, DockerReadsTheFile) {
  const auto ends_well = [&](const std::string& command) {
    const ExitStatus exit =
        run_to_end({"docker", {"/bin/sh", "-c", command}, environment_with({}), dir_ / "docker.log"});
    return exit.code == 0;
  };
  fs::create_directories(dir_);
  if (!ends_well("docker stack config --help"))
    GTEST_SKIP() << "no Docker client on this machine checks files of stacks";
  for (unsigned seed = 0; seed < 4; ++seed) {
    Stack stack = draw(seed);
    for (const auto& [program, vendor] : dds_vendors(stack.plan)) {
      for (const char* key : security_files::kAll) {
        fs::create_directories(dir_ / "keys" / program);
        write_text(dir_ / "keys" / program / key, "");
      }
    }
    write_text(dir_ / "stack.yaml", compose_file(stack.plan, stack.layout));
    EXPECT_TRUE(ends_well("cd \"" + dir_.string() + "\" && docker stack config --compose-file stack.yaml"))
        << last_lines_below(dir_ / "docker.log", 5);
  }
}

}  // namespace
}  // namespace skein::cli
