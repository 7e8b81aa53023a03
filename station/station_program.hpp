// The station as a program.
#pragma once

#include "bus/lockstep/fleet_program.hpp"
#include "process/run_folder.hpp"
#include "station/view_node.hpp"

namespace skein::station {

class StationProgram final : public bus::FleetProgram {
 public:
  const char* name() const override { return programs::kStation; }
  void add_options(CLI::App& app) override;
  std::variant<int, std::unique_ptr<bus::FleetMember>> prepare(const ProgramOptions& options,
                                                               StatusPipe& status) override;

 private:
  bool settle_only_ = false;
  ViewOptions view_;
};

}  // namespace skein::station
