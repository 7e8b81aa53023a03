// Files for docker-compose, for random fleets: which services share a network, and what a container may do and see.
#include "cli/compose/compose_file.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <random>
#include <set>

#include "cli/testing/compose_programs.hpp"
#include "cli/testing/compose_reader.hpp"
#include "core/config/network_config.hpp"
#include "host/supervisor.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"
#include "run/exec_variables.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

const Texts kSceneFiles = {"mesh.stl", "points.pcd", "boxes.yaml"};
/// Names that YAML, DNS or docker-compose might misread.
const Texts kOddNodes = {
    "on", "yes", "null", "true", "n", "usual", "host", "results", "uav", "router", "E5", "z__9_", std::string(64, 'a')};
constexpr int kFleets = 40;

class ComposeFile : public testing::Test {
 protected:
  struct Fleet {
    FleetPlan plan;
    ComposeLayout layout;
    Compose file() const { return Compose(compose_file(plan, layout)); }
  };

  /// The plan of a fleet whose scene, vehicle, parameters and scenario are in a folder with an odd name.
  FleetPlan plan_of(const Texts& uavs, bool scene_files, bool own_vehicle, const RunOptions& options) {
    fs::create_directories(dir_);
    for (const std::string& file : kSceneFiles) write_text(dir_ / file, "");
    fs::copy_file(source_path("config/vehicles/explorer.yaml"), dir_ / "mine.yaml",
                  fs::copy_options::overwrite_existing);
    write_text(dir_ / "parameters.yaml", "");
    std::string text = "name: drawn\ndesired_mm_per_pixel: 2.0\nscene: ";
    text += scene_files ? "{meshes: [./mesh.stl], points: ./points.pcd, boxes: ./boxes.yaml}" : "{family: towers}";
    text += "\nfleet:\n";
    for (std::size_t i = 0; i < uavs.size(); ++i) {
      text += fmt::format("  - {{name: \"{}\", vehicle: {}, start: [{}, 0]}}\n", uavs[i],
                          own_vehicle && i % 2 == 0 ? "./mine.yaml" : "photographer", 10 * i);
    }
    write_text(dir_ / "mine_too.yaml", text);
    RunOptions run = options;
    run.scenario = dir_ / "mine_too.yaml";
    run.planner = "hover";
    return plan_fleet(run, programs_.dir());
  }

  Texts draw_names(std::mt19937& random) {
    Texts names = kOddNodes;
    for (int i = 0; i < 20; ++i) names.push_back("u" + std::to_string(i));
    std::ranges::shuffle(names, random);
    names.resize(std::uniform_int_distribution<std::size_t>(1, 20)(random));
    return names;
  }

  Fleet draw(unsigned seed) {
    std::mt19937 random(seed);
    const auto coin = [&] { return std::bernoulli_distribution(0.5)(random); };
    const Texts names = draw_names(random);
    RunOptions options;
    options.secure = coin();
    options.dds = options.secure || coin() ? "fastdds" : "mixed";
    options.seed = random();
    if (coin()) options.faults = dir_ / "faults.yaml";
    if (coin()) options.duration_s = 31.5;
    fs::create_directories(dir_);
    write_text(dir_ / "faults.yaml", "faults:\n  - {at_s: 5, until_s: 9, kill: \"" + names[0] + "\"}\n");
    Fleet fleet{plan_of(names, coin(), coin(), options), {}};
    if (coin()) fleet.plan.ground = UavPlanner{"gcs", "xxh"};
    if (coin()) fleet.plan.planners[0].spec = "hover:" + (dir_ / "parameters.yaml").string();
    if (coin()) fleet.plan.planners.back().spec = "hover:note=$HOME ${X} \"quoted\"";
    if (coin()) fleet.layout.images[names.back()] = "mine:latest";
    if (coin()) fleet.layout.subnet = parse_subnet("172.30.0.0/20");
    if (coin()) fleet.layout.results = dir_ / "out";
    if (coin()) {
      fleet.plan.watched.emplace();
      fleet.layout.view = ComposeView{{"127.0.0.1", 8123}, {}, dir_ / "view"};
      if (coin()) fleet.layout.view = ComposeView{{"2001:db8::7", 80}, {"2001:db8::7", "flier"}, "./view"};
    }
    return fleet;
  }

  /// Calls `look` with many random fleets and their compose files.
  void for_all(const std::function<void(const Fleet&, const Compose&)>& look) {
    for (unsigned seed = 0; seed < kFleets && !HasFailure(); ++seed) {
      SCOPED_TRACE("fleet " + std::to_string(seed));
      const Fleet fleet = draw(seed);
      look(fleet, fleet.file());
    }
  }
  static std::string error_of(const Fleet& fleet) {
    try {
      compose_file(fleet.plan, fleet.layout);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  const FakePrograms programs_;
  const fs::path dir_ = programs_.dir() / "a $b: 'c' \"d\" #{e}";
};

TEST_F(ComposeFile, EachDomainIsANetworkOfItsServices) {
  for_all([](const Fleet& fleet, const Compose& file) {
    Names networks = {"world", "gcs"}, services = {"sim_server", "comm_router", "station"};
    if (fleet.plan.ground) services.insert("uav_agent-gcs");
    for (const UavConfig& uav : fleet.plan.scenario.fleet) {
      networks.insert(uav.name);
      services.insert("uav_agent-" + uav.name);
    }
    EXPECT_EQ(file.services(), services);
    Names all = networks;
    if (fleet.layout.view) all.insert("view");
    ASSERT_EQ(file.networks(), all);
    for (const std::string& network : networks) {
      Names members = {"sim_server", "comm_router"};
      if (network == "world" || network == "gcs") members.insert("station");
      if (network != "world" && services.contains("uav_agent-" + network)) members.insert("uav_agent-" + network);
      EXPECT_EQ(file.members(network), members) << network;
      EXPECT_TRUE(file.network(network)["internal"].as<bool>()) << network;
      EXPECT_EQ(file.network(network)["driver_opts"]["com.docker.network.bridge.inhibit_ipv4"].as<std::string>(),
                "true");
    }
  });
}

TEST_F(ComposeFile, EachContainerHasFewRights) {
  for_all([](const Fleet&, const Compose& file) {
    for (const std::string& service : file.services()) {
      EXPECT_TRUE(file.of(service, "init").as<bool>() && file.of(service, "read_only").as<bool>()) << service;
      EXPECT_EQ(texts_of(file.of(service, "cap_drop")), Texts{"ALL"});
      EXPECT_EQ(texts_of(file.of(service, "security_opt")), Texts{"no-new-privileges:true"});
      EXPECT_NE(file.text(service, "user").substr(0, 2), "0:");
      EXPECT_GT(file.of(service, "pids_limit").as<int>(), 0);
      EXPECT_EQ(file.of(service, "logging")["options"]["max-size"].as<std::string>(""), "64m")
          << "limits the engine's log";
      for (const char* key : {"mem_limit", "healthcheck", "stop_grace_period", "restart", "image"}) {
        EXPECT_TRUE(file.of(service, key).IsDefined()) << service << ' ' << key;
      }
      for (const char* key : {"privileged", "cap_add", "devices", "network_mode", "pid", "ipc"}) {
        EXPECT_FALSE(file.of(service, key).IsDefined()) << service << ' ' << key;
      }
      const std::string health = file.option(service, "--health");
      EXPECT_NE(file.of(service, "healthcheck")["test"][1].as<std::string>().find(health), std::string::npos);
    }
  });
}

TEST_F(ComposeFile, EachProgramGetsThePeersOfItsNetworksByTheirAliases) {
  for_all([](const Fleet&, const Compose& file) {
    Names all;
    std::size_t count = 0;
    for (const std::string& service : file.services()) {
      for (const std::string& network : file.networks_of(service)) {
        for (const std::string& alias : file.aliases(service, network)) {
          all.insert(alias);
          ++count;
        }
      }
    }
    EXPECT_EQ(all.size(), count) << "two services have the same name";
    for (const std::string& service : file.services()) {
      const NetworkConfig config = read_network(filled_in(file.of(service, "environment")["SKEIN_NETWORK"].Scalar()));
      for (const std::string& network : file.networks_of(service)) {
        if (network == "view") continue;  // browsers are not peers
        Names peers, members;
        for (const std::string& peer : config.of(network).peers) peers.insert(peer);
        for (const std::string& member : file.members(network)) {
          for (const std::string& alias : file.aliases(member, network)) members.insert(alias);
        }
        EXPECT_EQ(peers, members) << service << " in " << network;
      }
      for (const auto& [domain, network] : config.domains) {
        EXPECT_TRUE(file.networks_of(service).contains(domain)) << service << " is told about " << domain;
      }
    }
  });
}

TEST_F(ComposeFile, TheStationAloneServesThePageInANetworkOfItsOwn) {
  for_all([](const Fleet& fleet, const Compose& file) {
    const auto& view = fleet.layout.view;
    EXPECT_EQ(file.option("sim_server", "--watch").empty(), !view);
    for (const std::string& service : file.services()) {
      const bool serves = view && service == "station";
      EXPECT_EQ(file.of(service, "ports").IsDefined(), serves) << service;
      for (const char* option : {"--view-listen", "--view-key", "--view-script", "--view-title"}) {
        EXPECT_EQ(file.option(service, option).empty(), !serves) << service << ' ' << option;
      }
      EXPECT_EQ(file.mounts(service).contains("/view"), serves) << service;
    }
    if (!view) return;
    EXPECT_EQ(file.members("view"), Names{"station"});
    EXPECT_FALSE(file.network("view")["internal"].IsDefined()) << "Docker publishes no ports of an internal network";
    const std::string listens = file.option("station", "--view-listen"), alias = listens.substr(0, listens.find(':'));
    EXPECT_EQ(file.aliases("station", "view"), Texts{alias}) << "the station listens for browsers in no other network";
    const bool local = view->published.is_loopback();
    EXPECT_EQ(texts_of(file.of("station", "ports")),
              Texts{(local ? "127.0.0.1:8123" : "[2001:db8::7]:80") + listens.substr(listens.find(':'))});
    EXPECT_EQ(file.option("station", "--view-name"), local ? "" : "2001:db8::7") << "the first of the given names";
    EXPECT_EQ(file.mounts("station").at("/view"), view->folder);
    EXPECT_EQ(file.option("station", "--view-key"), "/view/view.key");
  });
}

TEST_F(ComposeFile, AServiceMountsOnlyTheFilesThatItNeeds) {
  for_all([&](const Fleet& fleet, const Compose& file) {
    for (const std::string& service : file.services()) {
      const auto mounts = file.mounts(service);
      Names here;
      for (const auto& [there, source] : mounts) here.insert(source);
      for (const std::string& scene : kSceneFiles) {
        EXPECT_EQ(here.contains(dir_ / scene), service == "sim_server" && fleet.plan.scenario.scene.family.empty())
            << service << ' ' << scene;
      }
      for (const char* option : {"--scenario", "--faults"}) {
        const std::string path = file.option(service, option);
        EXPECT_TRUE(path.empty() || mounts.contains(path)) << service << ' ' << path;
      }
      for (const fs::path& vehicle : fleet.plan.scenario.vehicle_files) {
        const bool own = vehicle.filename() == "mine.yaml";
        EXPECT_EQ(here.contains(fs::weakly_canonical(vehicle)), own) << service << ' ' << vehicle;
      }
      EXPECT_EQ(mounts.contains("/keys"), fleet.plan.options.secure);
      EXPECT_EQ(file.option(service, "--security"), fleet.plan.options.secure ? "/keys" : "");
    }
  });
}

TEST_F(ComposeFile, APlannerInPythonHasItsFilesAndAnImageWithPython) {
  Fleet fleet{plan_of({"a", "b"}, false, false, {}), {}};
  for (const char* file : {"mine.py", "helper.py"}) write_text(dir_ / file, "");
  const std::string spec = "py:" + (dir_ / "mine.py").string();
  fleet.plan.planners[0].spec = spec + ":x=1";
  const Compose file = fleet.file();
  EXPECT_EQ(file.option("uav_agent-a", "--planner"), spec + ":x=1");
  for (const char* name : {"mine.py", "helper.py"}) {
    EXPECT_TRUE(file.mounts("uav_agent-a").contains(dir_ / name)) << name;
    EXPECT_FALSE(file.mounts("uav_agent-b").contains(dir_ / name)) << name;
  }
  EXPECT_NE(compose_file(fleet.plan, fleet.layout).find("${SKEIN_PYTHON_AGENT_IMAGE:-skein-agent-python}"),
            std::string::npos);
  fleet.layout.chosen = {{"SKEIN_IMAGE", "s"}, {"SKEIN_AGENT_IMAGE", "b"}, {"SKEIN_PYTHON_AGENT_IMAGE", "a"}};
  for (const auto& [service, image] : {std::pair("uav_agent-a", "a"), {"uav_agent-b", "b"}, {"sim_server", "s"}}) {
    EXPECT_EQ(fleet.file().text(service, "image"), image);
  }
  fleet.plan.planners[0].spec = spec + ":" + (dir_ / "parameters.yaml").string();
  EXPECT_EQ(fleet.file().option("uav_agent-a", "--planner"), spec + ":/planner.yaml");
}

TEST_F(ComposeFile, AnAgentSeesNeitherTheResultsOfOtherAgentsNorThoseOfTheServers) {
  for_all([](const Fleet& fleet, const Compose& file) {
    std::map<std::string, Names> users;
    for (const std::string& service : file.services()) {
      EXPECT_EQ(file.option(service, "--out"), "/results");
      users[file.mounts(service).at("/results")].insert(service);
    }
    EXPECT_EQ(users.size(), file.services().size() - 2);
    for (const auto& [volume, services] : users) {
      const Names servers = {"sim_server", "comm_router", "station"};
      EXPECT_TRUE(services.size() == 1 || services == servers) << volume;
      EXPECT_EQ(file.volumes().contains(volume), !fleet.layout.results) << volume;
    }
  });
}

TEST_F(ComposeFile, PlannersGetTheirParametersAsTheUserWroteThem) {
  for_all([&](const Fleet& fleet, const Compose& file) {
    for (const UavPlanner& planner : fleet.plan.planners) {
      const std::string service = "uav_agent-" + planner.uav, told = file.option(service, "--planner");
      EXPECT_EQ(file.option(service, "--uav"), planner.uav);
      if (planner.spec.find("parameters.yaml") == std::string::npos) {
        EXPECT_EQ(told, planner.spec);
      } else {
        ASSERT_EQ(told.find("hover:/"), 0u) << told;
        EXPECT_EQ(file.mounts(service).at(told.substr(6)), dir_ / "parameters.yaml");
      }
    }
  });
}

TEST_F(ComposeFile, TheNetworksDivideTheGivenSubnetWithoutOverlap) {
  for_all([](const Fleet& fleet, const Compose& file) {
    std::set<std::uint32_t> taken;
    for (const std::string& network : file.networks()) {
      const YAML::Node ipam = file.network(network)["ipam"];
      ASSERT_EQ(ipam.IsDefined(), fleet.layout.subnet.has_value());
      if (!ipam) continue;
      const Subnet subnet = parse_subnet(ipam["config"][0]["subnet"].as<std::string>());
      EXPECT_GE(std::uint32_t{1} << (32 - subnet.prefix), file.members(network).size() + 3);
      for (std::uint32_t i = 0; i < std::uint32_t{1} << (32 - subnet.prefix); ++i) {
        EXPECT_TRUE(taken.insert(subnet.address + i).second) << network;
        EXPECT_EQ((subnet.address + i) >> (32 - fleet.layout.subnet->prefix),
                  fleet.layout.subnet->address >> (32 - fleet.layout.subnet->prefix));
      }
    }
  });
}

// `skein run` gives the same variables to the program of a planner exec:CMD or ros:PACKAGE/EXECUTABLE.
TEST_F(ComposeFile, AProgramOfTheUsersOwnImageIsToldItsRoleItsRadioTopicsAndTheTimeOfAnExchange) {
  std::set<std::string> roles;
  for_all([&](const Fleet& fleet, const Compose& file) {
    for (const UavConfig& uav : fleet.plan.scenario.fleet) {
      const std::string program = programs::agent_program(uav.name);
      const auto environment = file.of(program, "environment");
      const bool foreign = fleet.layout.images.contains(uav.name);
      const auto told = exec_variables(fleet.plan, program, kComposeBaseDomain, "out", {});
      for (const char* name : {"SKEIN_ROLE", "SKEIN_EXCHANGE_S", "SKEIN_RADIO_SENDS", "SKEIN_RADIO_HEARS"}) {
        ASSERT_EQ(environment[name].IsDefined(), foreign) << program << " " << name;
        if (!foreign) continue;
        EXPECT_EQ(filled_in(environment[name].Scalar()), told.at(name)) << program;
      }
      if (foreign) roles.insert(environment["SKEIN_ROLE"].Scalar());
    }
  });
  EXPECT_EQ(roles, (std::set<std::string>{"explorer", "photographer"}));
}

TEST_F(ComposeFile, MistakesAreReportedWithACorrectValue) {
  const auto fleet = [&](const Texts& names) { return Fleet{plan_of(names, false, false, {}), {}}; };
  for (const Texts& alike : {Texts{"jurong", "Jurong"}, Texts{"a", "world"}, Texts{"GCS"}}) {
    EXPECT_NE(error_of(fleet(alike)).find("choose another name"), std::string::npos) << alike.back();
  }
  Fleet shown = fleet({"a", "View"});
  EXPECT_EQ(error_of(shown), "none");
  shown.layout.view.emplace();
  EXPECT_NE(error_of(shown).find("choose another name"), std::string::npos);
  Fleet foreign = fleet({"a", "b"});
  foreign.plan.planners[0].spec = "exec:./mine";
  EXPECT_NE(error_of(foreign).find("--image a=IMAGE"), std::string::npos) << error_of(foreign);
  foreign.layout.images["a"] = "mine";
  EXPECT_EQ(error_of(foreign), "none");
  foreign.layout.images["bb"] = "mine";
  EXPECT_NE(error_of(foreign).find("a, b"), std::string::npos) << error_of(foreign);
  for (std::size_t uavs = 1; uavs <= 20; ++uavs) {  // the size in the message is the smallest that is enough
    Texts names;
    for (std::size_t i = 0; i < uavs; ++i) names.push_back("u" + std::to_string(i));
    Fleet tight = fleet(names);
    tight.layout.subnet = parse_subnet("10.1.0.0/28");
    const std::string error = error_of(tight);
    const int prefix = std::stoi(error.substr(error.find("a /") + 3));
    tight.layout.subnet = parse_subnet("10.1.0.0/" + std::to_string(prefix));
    EXPECT_EQ(error_of(tight), "none");
    tight.layout.subnet->prefix = prefix + 1;
    EXPECT_EQ(error_of(tight), error);
  }
  for (const char* text : {"", "10.0.0.0", "10.0.0.0/", "10.0.0/20", "10.0.0.0/29", "10.0.0.0/7", "10.0.0.0/20x"}) {
    EXPECT_THROW(parse_subnet(text), InputError) << text;
  }
}

TEST_F(ComposeFile, DockerComposeAcceptsTheFile) {
  const std::vector<Texts> programs = compose_programs();
  if (programs.empty()) GTEST_SKIP() << "there is no docker-compose here";
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Fleet fleet = draw(seed);
    const fs::path file = programs_.dir() / "compose.yaml", log = programs_.dir() / "compose.log";
    write_text(file, compose_file(fleet.plan, fleet.layout));
    for (Texts words : programs) {
      words.insert(words.end(), {"-f", file, "config", "-q"});
      const ExitStatus exit = run_to_end({"docker-compose", words, environment_with({}), log});
      EXPECT_EQ(exit.code, 0) << "fleet " << seed << ", " << words[2] << ": " << read_text(log);
    }
  }
}

}  // namespace
}  // namespace skein::cli
