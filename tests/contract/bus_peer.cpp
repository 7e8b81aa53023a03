// The second process of the bus contract tests, which a test pauses and kills:
//   bus_contract_peer VENDOR DOMAIN
// It reads the topic "to_peer" and answers each sample on "from_peer". It publishes its id on the latched topic
// "hello".
#include <unistd.h>

#include <cstdlib>
#include <memory>

#include "tests/contract/bus_fixture.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  using namespace skein::test;
  auto bus = skein::bus::make_bus({.vendor = argv[1]});
  auto participant = bus->join(std::atoi(argv[2]));
  auto hello = participant->create_writer(topic("hello", {.latched = true, .depth = 1}));
  hello->write(numbered(participant->id()));
  auto answer = participant->create_writer(topic("from_peer"));
  auto reader = participant->create_reader(topic("to_peer"),
                                           [&answer](skein::bus::Sample&& sample) { answer->write(sample.payload); });
  for (;;) pause();
}
