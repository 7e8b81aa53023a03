// station: the ground station, which tallies what reaches it.
#include "process/host/environment.hpp"
#include "station/station_program.hpp"

int main(int argc, char** argv) {
  skein::take_fleet_environment(argv);
  skein::station::StationProgram program;
  return skein::bus::run_fleet_program(program, argc, argv);
}
