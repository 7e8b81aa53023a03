// The program on each host in the tests of networks. In each of its domains it writes and reads the topic "talk":
//   network_peer VENDOR GO NETWORK ID SAMPLES SIZE DOMAIN=NAME:OTHERS...
// It waits until it has matched OTHERS peers in each domain (0: for two seconds) and prints "met". Once the file GO
// exists, it writes SAMPLES samples of SIZE bytes, prints "NAME:" and the number of samples from each peer, and stays
// until it is killed.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <thread>

#include "core/config/network_config.hpp"
#include "core/text/text.hpp"
#include "tests/contract/bus_fixture.hpp"

namespace skein::test {
namespace {

struct Place {
  std::string name;
  std::size_t others = 0;
  std::unique_ptr<bus::Participant> participant;
  std::unique_ptr<bus::Writer> writer;
  std::unique_ptr<bus::Reader> reader;
  std::unique_ptr<Collector> heard = std::make_unique<Collector>();
};

constexpr std::uint64_t kOf = 1'000'000;  ///< the numbers of peer ID's samples begin at ID * kOf

void tell(Place& place, std::size_t samples) {
  std::map<std::uint64_t, std::size_t> counts;
  for (const std::uint64_t number : place.heard->numbers(place.others * samples)) ++counts[number / kOf];
  std::cout << place.name << ":";
  for (const auto& [id, count] : counts) std::cout << ' ' << id << " x " << count;
  std::cout << std::endl;
}

}  // namespace
}  // namespace skein::test

int main(int argc, char** argv) {
  using namespace skein;
  using namespace skein::test;
  if (argc < 8) return 2;
  const NetworkConfig network = read_network(argv[3]);
  const std::uint64_t id = std::strtoull(argv[4], nullptr, 10);
  const std::size_t samples = std::strtoull(argv[5], nullptr, 10), size = std::strtoull(argv[6], nullptr, 10);
  bus::BusConfig config{.vendor = argv[1]};
  std::map<int, Place> places;
  for (int i = 7; i < argc; ++i) {
    const std::vector<std::string> parts = split(argv[i], '='), name = split(parts.at(1), ':');
    const int domain = std::atoi(parts[0].c_str());
    config.networks[domain] = network.of(name.at(0));
    places[domain].name = name.at(0);
    places[domain].others = std::strtoull(name.at(1).c_str(), nullptr, 10);
  }
  const auto bus = bus::make_bus(config);
  for (auto& [domain, place] : places) {
    place.participant = bus->join(domain);
    place.reader = place.participant->create_reader(topic("talk"), place.heard->callback());
    place.writer = place.participant->create_writer(topic("talk"));
  }
  for (auto& [domain, place] : places) {
    if (place.others == 0) std::this_thread::sleep_for(std::chrono::seconds(2));
    eventually([&] {
      return place.writer->matched().size() >= place.others && place.reader->matched().size() >= place.others;
    });
  }
  std::cout << "met" << std::endl;
  eventually([&] { return std::filesystem::exists(argv[2]); });  // then all peers have matched
  for (std::size_t i = 0; i < samples; ++i) {
    for (auto& [domain, place] : places) place.writer->write(numbered(id * kOf + i, size));
  }
  for (auto& [domain, place] : places) tell(place, samples);
  for (;;) pause();
}
