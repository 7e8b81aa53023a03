// Files for docker-compose: the built programs accept the command lines in them.
#include <yaml-cpp/yaml.h>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class ComposeCommands : public FleetTest {
 protected:
  /// Expects all programs to accept the arguments and variables that their containers would get.
  void expect_accepted(Arguments fleet) {
    const fs::path file = folder() / "compose.yaml";
    fleet.insert(fleet.begin(), "compose");
    fleet.insert(fleet.end(), {"--file", file});
    ChildProcess& made = skein(fleet);
    ASSERT_EQ(made.wait().code, 0) << made.err();
    for (const auto& service : YAML::LoadFile(file)["services"]) {
      const auto name = service.first.as<std::string>();
      Arguments argv;
      if (name.starts_with("uav_agent")) argv.push_back("uav_agent");  // the image's entry point
      for (const YAML::Node& argument : service.second["command"]) argv.push_back(here(argument.as<std::string>()));
      argv.front() = program(argv.front());
      argv.push_back("--check");
      ChildProcess& checked = start_program(
          name, argv, {{"SKEIN_NETWORK", service.second["environment"]["SKEIN_NETWORK"].as<std::string>()}});
      EXPECT_EQ(checked.wait().code, 0) << name << ": " << checked.err();
    }
  }

 private:
  /// Replaces paths in a container with paths on this host.
  std::string here(std::string argument) const {
    const std::map<std::string, std::string> places = {
        {"/usr/share/skein/config", source_path("config")},
        {"=/results", "=" + folder().string()},
        {":/planner.yaml", ":" + (folder() / "parameters.yaml").string()},
        {"${SKEIN_RUN:-1}", "1"}};
    for (const auto& [there, place] : places) {
      if (const std::size_t at = argument.find(there); at != std::string::npos) {
        argument.replace(at, there.size(), place);
      }
    }
    return argument;
  }
};

TEST_F(ComposeCommands, AreAcceptedByThePrograms) {
  expect_accepted({"towers", "--planner", "kios"});
  if (fs::exists(source_path("build/web/live.js"))) {
    expect_accepted({"towers", "--planner", "kios", "--view", "0.0.0.0:8080", "--speed", "max"});
  }
  const fs::path parameters = write("parameters.yaml", "height_m: 4\n");
  expect_accepted({"towers",
                   "--planner",
                   "xxh,jurong=hover:" + parameters.string() + ",changi=hover:height_m=3",
                   "--seed",
                   "7",
                   "--scene-seed",
                   "3",
                   "--uavs",
                   "7",
                   "--duration",
                   "61.5",
                   "--rules",
                   "reference",
                   "--faults",
                   source_path("config/faults/station_outage.yaml"),
                   "--dds",
                   "fastdds",
                   "--clock",
                   "realtime:2",
                   "--stop-at",
                   "9",
                   "--agent-timeout",
                   "11"});
}

}  // namespace
}  // namespace skein::test
