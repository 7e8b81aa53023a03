// A participant in a DDS domain, not a member of the fleet, that subscribes to topics and counts their samples.
//   radio_listener VENDOR DOMAIN FILE TOPIC TYPE [TOPIC TYPE]...
// With SKEIN_SECURITY it presents the certificate in that folder, else none. Keeps FILE up to date with one line per
// topic: TOPIC, the number of writers matched, the number of samples received. Runs until it is killed.
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <sstream>
#include <string>
#include <thread>

#include "bus/bus.hpp"
#include "process/files/atomic_file.hpp"

namespace {

struct Heard {
  std::string topic;
  std::atomic<long> count = 0;
  std::unique_ptr<skein::bus::Reader> reader;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) return 2;
  const char* security = std::getenv("SKEIN_SECURITY");
  const auto bus = skein::bus::make_bus({.vendor = argv[1], .security = security != nullptr ? security : ""});
  const auto participant = bus->join(std::stoi(argv[2]));
  std::deque<Heard> heard;
  for (int i = 4; i + 1 < argc; i += 2) {
    Heard& topic = heard.emplace_back();
    topic.topic = argv[i];
    // Requests no durability, so that it matches latched and volatile writers alike.
    topic.reader = participant->create_reader({argv[i], argv[i + 1], {.reliable = true, .depth = 1000}},
                                              [&topic](skein::bus::Sample&&) { ++topic.count; });
  }
  for (std::string before;;) {
    std::ostringstream now;
    for (const Heard& topic : heard) {
      now << topic.topic << ' ' << topic.reader->matched().size() << ' ' << topic.count << '\n';
    }
    if (now.str() != before) skein::write_file_atomically(argv[3], before = now.str());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polling period; nothing depends on it
  }
}
