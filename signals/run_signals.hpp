// The signals of a run. All code about signals is in this folder, except their table, which fault files need, too:
//
//   core/expressions/signal_table.cpp  the signals that exist, with arguments, unit and meaning (docs/properties.md)
//   live_signals.cpp                   values during the run, of the signals that the server knows; they see the world
//                                      through sim_server/simulated_world.hpp, and faults may wait for them
//   run_signals.cpp                    values in a finished run, computed from its folder, each when it is first
//                                      requested; those of captures are in capture_signals.cpp, those of radio messages
//                                      in message_signals.cpp
//   judge.cpp                          verdicts on properties about the signals of a finished run
//
// A signal with values during the run has the same values afterwards. Not thread-safe.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/scenario/scenario.hpp"
#include "results/run_record.hpp"
#include "signals/properties/evaluation.hpp"
#include "signals/radio_log.hpp"

namespace skein::signals {

/// Whether a signal compares the run with the same one without faults.
bool is_comparison(const SignalUse& signal);

class FolderSignals final : public properties::RunSignals {
 public:
  using Values = std::vector<double>;  ///< one for each exchange

  /// All parameters must outlive this. @param undisturbed  the same run without faults, if there is one.
  /// @param faults  of the run; without them, `custody_differences` cannot be computed
  FolderSignals(const results::RunRecord& run, const Scenario& scenario,
                const results::RunRecord* undisturbed = nullptr, const FaultPlan* faults = nullptr);

  const std::vector<double>& values(const SignalUse& signal) override;
  std::size_t exchanges() const override { return exchanges_; }
  double period_s() const override { return scenario_.exchange_period_s; }
  std::optional<double> healed_s() const override;

 private:
  struct Track {
    std::vector<Vector3d> positions, velocities;
    Values alive, clearance, charge;
  };

  Values work_out(const SignalUse& signal);
  Values of_fleet(const SignalUse& signal);
  Values of_members(const SignalUse& signal);
  Values of_captures(const SignalUse& signal);
  Values of_messages(const SignalUse& signal);
  Values of_custody(const SignalUse& signal);
  Values custody_differences() const;
  bool has_path(const std::string& uav, std::size_t from, std::size_t to);
  Values of_work(const SignalUse& signal);
  std::optional<double> failed_s(const std::string& uav) const;
  Values missed(const std::string& uav, const results::RunRecord& without);
  Values separation(const SignalUse& signal);
  Values result(const SignalUse& signal) const;
  Values debug(const SignalUse& signal);
  Values without_work(const std::string& uav) const;
  Values on_off(const std::string& on, const std::string& off, const std::string& subject,
                const std::string& object) const;
  Values counted(const std::vector<std::size_t>& exchanges) const;
  Values constant(double value) const { return Values(exchanges_, value); }
  const RadioLog& radio();
  const std::map<std::string, Track>& tracks();
  std::map<std::string, Track> tracks_of(const results::RunRecord& run) const;
  Values way_flown(const std::map<std::string, Track>& tracks, const std::string& uav) const;
  /// @throws InputError when there is none.
  const results::RunRecord& undisturbed(const SignalUse& signal) const;
  std::size_t exchange_at(double time_s) const;
  double end_s() const { return static_cast<double>(exchanges_ - 1) * period_s(); }
  const std::vector<double>& use(const std::string& name, std::vector<std::string> arguments = {});

  const results::RunRecord& run_;
  const Scenario& scenario_;
  const results::RunRecord* const undisturbed_;
  const FaultPlan* const faults_;
  const std::size_t exchanges_;
  std::map<std::string, Values> known_;  ///< by SignalUse::text()
  std::optional<RadioLog> radio_;
  std::map<std::string, Track> tracks_;
};

}  // namespace skein::signals
