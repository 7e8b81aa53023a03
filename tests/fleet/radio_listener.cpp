// A stranger in a DDS domain: subscribes to topics, counts what it hears, and is no member of anything.
//   radio_listener VENDOR DOMAIN FILE TOPIC TYPE [TOPIC TYPE]...
// With SKEIN_SECURITY it shows the certificate in that folder, else none. Keeps FILE up to date with one line a topic:
// TOPIC, the number of writers matched, the number of samples heard. Runs until it is killed.
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
    // Asks for no durability, so that it matches latched writers and others alike.
    topic.reader = participant->create_reader({argv[i], argv[i + 1], {.reliable = true, .depth = 1000}},
                                              [&topic](skein::bus::Sample&&) { ++topic.count; });
  }
  for (std::string before;;) {
    std::ostringstream now;
    for (const Heard& topic : heard) {
      now << topic.topic << ' ' << topic.reader->matched().size() << ' ' << topic.count << '\n';
    }
    if (now.str() != before) skein::write_file_atomically(argv[3], before = now.str());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // between two looks; nothing waits for it
  }
}
