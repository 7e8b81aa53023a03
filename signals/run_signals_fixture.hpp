// Fixture for tests of signals: a run of 2 s of the UAVs `a` and `b`, made by hand.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

#include "core/expressions/expression_parser.hpp"
#include "signals/run_signals.hpp"

namespace skein::signals {

inline constexpr std::size_t kExchanges = 41;  // 2 s

class RunSignalsTest : public testing::Test {
 protected:
  RunSignalsTest() {
    for (const char* name : {"a", "b"}) {
      UavConfig uav;
      uav.name = name;
      scenario_.fleet.push_back(uav);
    }
    run_.dir = std::filesystem::path(testing::TempDir()) / ("skein_signals_" + std::to_string(::getpid()));
    std::filesystem::create_directories(run_.dir);
    run_.result = {{"sim_time_s", 2.0}, {"score", 7.5}, {"radio", {{"sent", 12}}}};
    run_.result["uavs"] = Json::array({{{"name", "a"}, {"idle_s", 1.5}}, {{"name", "b"}, {"idle_s", 0.5}}});
    run_.result["faults"] = Json::array();
  }
  ~RunSignalsTest() override { std::filesystem::remove_all(run_.dir); }

  std::vector<double> values(const std::string& text, const results::RunRecord* undisturbed = nullptr) {
    const SignalNames names(scenario_);
    std::vector<SignalUse> signals;
    parse_condition("not " + text + " or " + text, {.names = names}, signals);
    FolderSignals all(run_, scenario_, undisturbed);
    return all.values(signals.at(0));
  }
  std::vector<double> number(const std::string& text, const results::RunRecord* undisturbed = nullptr) {
    const SignalNames names(scenario_);
    std::vector<SignalUse> signals;
    parse_condition(text + " == " + text, {.names = names}, signals);
    FolderSignals all(run_, scenario_, undisturbed);
    return all.values(signals.at(0));
  }
  /// Values that are 0 at first, then each of these from its exchange on.
  static std::vector<double> steps(const std::vector<std::pair<std::size_t, double>>& changes) {
    std::vector<double> values(kExchanges, 0.0);
    for (const auto& [exchange, value] : changes) {
      std::fill(values.begin() + static_cast<std::ptrdiff_t>(exchange), values.end(), value);
    }
    return values;
  }

  Scenario scenario_;
  results::RunRecord run_;
};

/// A row of the table of captures.
inline results::CaptureRow capture(const std::string& uav, std::uint64_t number, double time_s,
                                   std::optional<double> delivered_at_s, std::size_t point = 0, double q = 0.5) {
  return {uav, number, time_s, point, q, delivered_at_s, "", 1.0, q, q};
}

}  // namespace skein::signals
