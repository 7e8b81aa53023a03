// A UAV's on-board software as a program; with `--role gcs`, a strategy's program at the ground station.
#pragma once

#include "bus/lockstep/fleet_program.hpp"
#include "process/run_folder.hpp"

namespace skein::agent {

class AgentProgram final : public bus::FleetProgram {
 public:
  const char* name() const override { return programs::kAgent; }
  void add_options(CLI::App& app) override;
  std::variant<int, std::unique_ptr<bus::FleetMember>> prepare(const ProgramOptions& options,
                                                               StatusPipe& status) override;

 private:
  std::string role_ = "uav";
  std::string uav_, planner_ = "patrol";
  bool list_ = false;
};

}  // namespace skein::agent
