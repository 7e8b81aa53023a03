// station: the ground station, which tallies the captures that are delivered to it.
#include "process/host/environment.hpp"
#include "station/station_program.hpp"

int main(int argc, char** argv) {
  skein::take_fleet_environment(argv);
  skein::station::StationProgram program;
  return skein::bus::run_fleet_program(program, argc, argv);
}
