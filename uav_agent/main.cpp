// uav_agent: one UAV's on-board software with the planner of the user's choice; with `--role gcs`, that strategy's
// program at the ground station.
#include "process/host/environment.hpp"
#include "uav_agent/agent_program.hpp"

int main(int argc, char** argv) {
  skein::take_fleet_environment(argv);
  skein::agent::AgentProgram program;
  return skein::bus::run_fleet_program(program, argc, argv);
}
