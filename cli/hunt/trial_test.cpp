// States of the fleet in a trial whose faults wait for a condition.
#include "cli/hunt/trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/faults/fault_writer.hpp"

namespace skein::cli {
namespace {

/// A mission of 20 s in which nothing happens: all programs take part, all links are open, no UAV holds a capture.
class QuietMission final : public properties::RunSignals {
 public:
  const std::vector<double>& values(const SignalUse& signal) override { return signal.is("held") ? none_ : all_; }
  std::size_t exchanges() const override { return none_.size(); }
  double period_s() const override { return 0.05; }
  std::optional<double> healed_s() const override { return 0.0; }

 private:
  const std::vector<double> none_ = std::vector<double>(401, 0.0), all_ = std::vector<double>(401, 1.0);
};

TEST(StatesOfATrial, AWaitingFaultIsInForceAsLongAsInTheFlight) {
  Scenario scenario;
  for (const char* name : {"a", "b"}) scenario.fleet.emplace_back().name = name;
  QuietMission mission;
  std::mt19937 random(1);
  const auto drawn_s = [&](double most_s) { return most_s * static_cast<double>(random() % 1000) / 1000.0; };
  for (int trial = 0; trial < 200; ++trial) {
    Fault waited{.at_s = 0.0, .until_s = std::nullopt, .action = Blackout{"a"}, .waits = true};
    if (random() % 4 != 0) waited.until_s = drawn_s(20.0);
    if (random() % 4 != 0) waited.for_s = drawn_s(20.0);
    const auto begin = static_cast<Tick>(drawn_s(waited.until_s.value_or(20.0)) * kTicksPerSecond);
    TrialOutcome outcome;
    outcome.began_s = {seconds(begin)};
    Fault flown = waited;
    flown.set_off(begin);
    flown.for_s.reset();
    EXPECT_EQ(states_of(mission, scenario, {waited}, outcome), states_of(mission, scenario, {flown}, outcome))
        << "the fault began at " << *outcome.began_s[0] << " s: " << fault_line(waited);
  }
}

}  // namespace
}  // namespace skein::cli
