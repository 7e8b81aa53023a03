// Serves the page of a made-up flight (made_up_flight.hpp), to measure the cost of the page alone. It reads commands
// from its standard input, one per line, and reports when each is done:
//   to SECONDS         flies up to this simulated time as fast as it can
//   fly SECONDS SPEED  flies up to this simulated time at SPEED simulated seconds per second of wall time
// The program ends at the end of its input.
// usage: view_feeder DOOR [UAVS [POINTS]]
// It writes the file DOOR: opened in a browser, DOOR leads to the page.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "made_up_flight.hpp"
#include "process/files/private_file.hpp"
#include "view/key.hpp"
#include "view/listener.hpp"
#include "view/pages.hpp"
#include "view/server.hpp"

int main(int argc, char** argv) try {
  using namespace skein;
  using Clock = std::chrono::steady_clock;
  if (argc < 2) throw std::invalid_argument("usage: view_feeder DOOR [UAVS [POINTS]]");
  const std::filesystem::path door = argv[1];
  test::MadeUpSize size;
  if (argc > 2) size.uavs = std::stoul(argv[2]);
  if (argc > 3) size.points = std::stoul(argv[3]);
  const std::filesystem::path script = view::find_script();
  const view::Listener listener(0);
  const view::Key key = view::Key::draw();
  view::Feed feed;
  test::MadeUpFlight flight(size, feed);
  const view::Server server(listener.fd(), key, view::site_of("made up", script), feed);
  write_private_file(door, view::key_file_page(listener.endpoint().from_here().text(), key));
  std::cout << "open " << door.string() << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string what;
    double until_s = 0.0, speed = 0.0;
    words >> what >> until_s >> speed;
    const double from_s = flight.time_s();
    const auto begun = Clock::now();
    while (flight.time_s() < until_s - 1e-9) {
      flight.step();
      if (what != "fly" || speed <= 0.0) continue;
      const std::chrono::duration<double> due((flight.time_s() - from_s) / speed);
      std::this_thread::sleep_until(begun + std::chrono::duration_cast<Clock::duration>(due));
    }
    std::cout << "at " << flight.time_s() << std::endl;
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << std::endl;
  return 2;
}
