// Planners in Python for tests. The fixture writes their code to a folder of the test, and calls them with inputs of
// its own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/places.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/world_map.hpp"
#include "uav_agent/python/python_planner.hpp"

namespace skein::agent {

namespace fs = std::filesystem;

inline constexpr const char* kHead =
    "from dataclasses import dataclass, field\nimport numpy as np\nfrom skein.planner import *\n";

class PythonPlannerTest : public testing::Test {
 protected:
  PythonPlannerTest() : folder_(fs::path(testing::TempDir()) / ("python_planner_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    ::setenv("SKEIN_BIN_DIR", build_path("bin").c_str(), 1);
    for (const char* name : {"jurong", "raffles", "sentosa"}) agent_.fleet.push_back({.name = name});
  }
  ~PythonPlannerTest() override { fs::remove_all(folder_); }

  /// @param code  follows the imports. @returns the spec of a file with this code.
  std::string file(const std::string& code, const std::string& name = "mine.py") const {
    std::ofstream(folder_ / name) << kHead << code;
    return "py:" + (folder_ / name).string();
  }
  std::unique_ptr<Planner> make(const std::string& spec, std::uint64_t seed = 1, std::size_t self = 0) {
    agent_.self = UavIndex(self);
    return make_python_planner(spec, agent_, {.seed = seed, .radio_topics = {"/plan", "/talk"}});
  }
  /// A planner whose plan() has this body.
  std::unique_ptr<Planner> planning(const std::string& body, const std::string& more = "") {
    return make(file("class Mine(Planner):\n" + more + "    def plan(self, inputs):\n        " + body + "\n"));
  }
  PlannerOutput ask(Planner& planner, std::uint64_t k = 7) {
    Peers peers(agent_);
    peers.update(0, {});
    for (const auto& neighbours : seen_) peers.update(static_cast<Tick>(20 * k), neighbours, links_);
    PlannerInput in{.k = k,
                    .tick = static_cast<Tick>(20 * k),
                    .state = {.p_WB = {1.0, 2.0, 3.0}, .v_WB = {0.5, 0.25, 0.125}},
                    .gimbal = {},
                    .tracking = {},
                    .map = map_,
                    .boxes = boxes_,
                    .peers = peers,
                    .mission_remaining_s = 12.5,
                    .detected = detected_,
                    .radio = {},
                    .scans = scans_,
                    .world_map = &world_,
                    .station_link = peers.station_link()};
    return planner.plan(in);
  }
  std::string refusal(Planner& planner, std::uint64_t k = 7) {
    try {
      ask(planner, k);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }
  std::string input_error(const std::string& spec) {
    try {
      make(spec);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  const fs::path folder_;
  AgentConfig agent_;
  OccupancyMap map_;
  WorldMap world_{WorldMap::Config{}};
  std::vector<OrientedBox> boxes_ = {{"box", {1, 2, 3}, {4, 5, 6}, Matrix3d::Identity()}};
  std::vector<Scan> scans_ = {{20, {{1, 2, 3}, {4, 5, 6}}}};
  std::vector<std::vector<Neighbour>> seen_;  ///< one update of the peers after the other
  LinkQualities links_;
  std::vector<DetectedPoint> detected_ = {{{1, 2, 3}, 0.5, 9, {0, 0, 1}}, {{4, 5, 6}, 0.25, 8, {1, 0, 0}}};
};

inline void expect_has(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
}

}  // namespace skein::agent
