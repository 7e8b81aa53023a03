// Fixture for fleets whose programs are started one by one, without the launcher: as in containers, or to use options
// that the launcher does not have.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include "core/topics.hpp"
#include "fleet_fixture.hpp"
#include "host/domain_block.hpp"

namespace skein::test {

class ByHand : public FleetTest {
 protected:
  struct Options {
    std::string scenario = "towers";
    Arguments all = {}, server = {};  ///< further options of all programs, and of the server
    std::filesystem::path keys = {};  ///< folder that `skein keys` made; empty: the fleet is not secured
  };

  ByHand() { std::filesystem::create_directories(dir_); }

  /// Starts all programs, the UAVs with `patrol`. @param instead_of  by agent, the command line that replaces it.
  void start_fleet(const Options& options, const std::map<std::string, Arguments>& instead_of = {}) {
    for (const std::string& name : kPrograms) {
      const auto found = instead_of.find(name);
      fleet_[name] = found == instead_of.end()
                         ? &start_program(name, command(name, options))
                         : &start_program(name, found->second,
                                          {{"SKEIN_DOMAIN", std::to_string(uav_domain(domains_.base(), index(name)))},
                                           {"SKEIN_UAV", member(name)},
                                           {"SKEIN_DDS", "cyclonedds"}});
    }
  }

  Arguments command(const std::string& name, const Options& options) const {
    Arguments argv = {program(name.substr(0, name.find('-'))),
                      "--scenario",
                      options.scenario,
                      "--domain",
                      std::to_string(domains_.base()),
                      "--out",
                      dir_};
    if (member(name) != name) argv.insert(argv.end(), {"--uav", member(name), "--planner", "patrol"});
    if (!options.keys.empty()) argv.insert(argv.end(), {"--security", options.keys / name});
    argv.insert(argv.end(), options.all.begin(), options.all.end());
    if (name == "sim_server") argv.insert(argv.end(), options.server.begin(), options.server.end());
    return argv;
  }

  /// Expects the run to complete without `victim`, which was dropped for `reason`, and all others to exit with code 0.
  void expect_run_without(const std::string& victim, const std::string& reason) {
    EXPECT_EQ(fleet_.at("sim_server")->wait().code, 0) << fleet_.at("sim_server")->err();
    const Json report = server_report();
    EXPECT_EQ(report["status"], "completed");
    EXPECT_FALSE(report["deterministic"]);
    ASSERT_EQ(report["lost_members"].size(), 1u) << report["lost_members"];
    const Json lost = report["lost_members"][0];
    EXPECT_EQ(lost["member"], member(victim));
    EXPECT_NE(lost["reason"].get<std::string>().find(reason), std::string::npos) << lost["reason"];
    EXPECT_NE(fleet_.at("sim_server")->err().find(member(victim) + " is lost"), std::string::npos);
    for (const auto& [name, process] : fleet_) {
      if (name != victim) {
        EXPECT_EQ(process->wait().code, 0) << name << ": " << process->err();
      }
    }
  }

  Json server_report() const { return Json::parse(text_of(dir_ / "sim_server.report.json")); }
  static std::string member(const std::string& program) { return program.substr(program.find('-') + 1); }
  static UavIndex index(const std::string& agent) {
    const auto found = std::ranges::find(kFleet, member(agent));
    return UavIndex(static_cast<std::size_t>(found - kFleet.begin()));
  }

  const std::filesystem::path dir_ = folder() / "by_hand";
  const cli::DomainBlock domains_{std::nullopt, 2 + static_cast<int>(kFleet.size())};
  std::map<std::string, ChildProcess*> fleet_;
};

}  // namespace skein::test
