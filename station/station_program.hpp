// The station as a program.
#pragma once

#include <memory>

#include "bus/lockstep/fleet_program.hpp"
#include "results/run_folder.hpp"
#include "station/score_view.hpp"
#include "station/view_node.hpp"

namespace skein::station {

class StationProgram final : public bus::FleetProgram {
 public:
  /// @param score  gets a pointer to the tally, for other code in this process; nullptr: none needs it.
  explicit StationProgram(std::shared_ptr<ScoreView> score = nullptr) : score_(std::move(score)) {}
  const char* name() const override { return programs::kStation; }
  void add_options(CLI::App& app) override;
  std::variant<int, std::unique_ptr<bus::FleetMember>> prepare(const ProgramOptions& options,
                                                               StatusPipe& status) override;

 private:
  bool settle_only_ = false;
  ViewOptions view_;
  const std::shared_ptr<ScoreView> score_;
};

}  // namespace skein::station
