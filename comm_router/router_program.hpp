// The router as a program.
#pragma once

#include <string>
#include <vector>

#include "bus/lockstep/fleet_program.hpp"
#include "recording/replay.hpp"
#include "results/run_folder.hpp"

namespace skein::router {

class RouterProgram final : public bus::FleetProgram {
 public:
  const char* name() const override { return programs::kCommRouter; }
  void add_options(CLI::App& app) override;
  std::variant<int, std::unique_ptr<bus::FleetMember>> prepare(const ProgramOptions& options,
                                                               StatusPipe& status) override;

 private:
  bool settle_only_ = false;
  std::vector<std::string> stand_ins_;
  recording::ReplayOptions replay_;
};

}  // namespace skein::router
