// sim_server: physics, sensors, links, referee and the lock-step clock of one run.
#include "process/host/environment.hpp"
#include "sim_server/server_program.hpp"

int main(int argc, char** argv) {
  skein::take_fleet_environment(argv);
  skein::sim::ServerProgram program;
  return skein::bus::run_fleet_program(program, argc, argv);
}
