// comm_router: relays radio messages between the domains of the nodes, as far as the radio links permit.
#include "comm_router/router_program.hpp"
#include "process/host/environment.hpp"

int main(int argc, char** argv) {
  skein::take_fleet_environment(argv);
  skein::router::RouterProgram program;
  return skein::bus::run_fleet_program(program, argc, argv);
}
