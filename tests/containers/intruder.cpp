// A program in a UAV's container that joins DDS domains other than its own, by all addresses that it knows:
//   container_intruder VENDOR RUN NETWORK OWN OTHERS...
// OWN and OTHERS are domain ids; NETWORK holds the network of its own domain under the name "own". It reads the
// lock-step topics of all these domains, and writes on them in all but its own. Prints one line per domain: DOMAIN, the
// numbers of readers and writers found and of samples received, and the topics of these writers. The line of its own
// domain shows that the intruder works.
#include <atomic>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bus/lockstep/names.hpp"

namespace skein {
namespace {

constexpr std::chrono::seconds kPatience{20}, kListens{3};

struct Place {
  int domain = 0;
  std::unique_ptr<bus::Participant> participant;
  std::map<std::string, std::unique_ptr<bus::Reader>> readers;  ///< by topic
  std::vector<std::unique_ptr<bus::Writer>> writers;
  std::atomic<long> heard = 0;

  std::size_t writers_found() const {
    std::size_t count = 0;
    for (const auto& [topic, reader] : readers) count += reader->matched().size();
    return count;
  }
  std::size_t readers_found() const {
    std::size_t count = 0;
    for (const auto& writer : writers) count += writer->matched().size();
    return count;
  }
};

std::unique_ptr<Place> join(bus::Bus& bus, int domain, bool writes) {
  auto place = std::make_unique<Place>();
  place->domain = domain;
  place->participant = bus.join(domain);
  for (const topics::WireTopic& topic :
       {topics::step(), topics::done(), topics::ready(), topics::station_done(), topics::attached(), topics::routed(),
        topics::ledger(), topics::capture(), topics::drop(), topics::resync()}) {
    const bus::TopicSpec spec = bus::spec(topic);
    place->readers[spec.name] =
        place->participant->create_reader(spec, [&heard = place->heard](bus::Sample&&) { ++heard; });
    if (writes) place->writers.push_back(place->participant->create_writer(spec));
  }
  return place;
}

int intrude(const std::vector<std::string>& arguments) {
  const NetworkConfig network = read_network(arguments.at(2));
  bus::BusConfig config{.vendor = arguments.at(0), .run = RunId{std::stoull(arguments.at(1))}};
  for (std::size_t i = 3; i < arguments.size(); ++i) {
    config.networks[std::stoi(arguments[i])] = i == 3 ? network.of("own") : network.usual;
  }
  const auto bus = bus::make_bus(config);
  std::vector<std::unique_ptr<Place>> places;
  for (std::size_t i = 3; i < arguments.size(); ++i) places.push_back(join(*bus, std::stoi(arguments[i]), i > 3));

  using Clock = std::chrono::steady_clock;
  const Clock::time_point patience = Clock::now() + kPatience;
  while (places[0]->heard == 0 && Clock::now() < patience) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const std::vector<std::uint8_t> forged = {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
  for (const Clock::time_point end = Clock::now() + kListens; Clock::now() < end;) {
    for (const auto& place : places) {
      for (const auto& writer : place->writers) writer->write(forged);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  for (const auto& place : places) {
    std::cout << place->domain << ' ' << place->readers_found() << ' ' << place->writers_found() << ' ' << place->heard;
    for (const auto& [topic, reader] : place->readers) {
      if (!reader->matched().empty()) std::cout << ' ' << topic;
    }
    std::cout << std::endl;
  }
  return 0;
}

}  // namespace
}  // namespace skein

int main(int argc, char** argv) try {
  return skein::intrude({argv + 1, argv + argc});
} catch (const std::exception& error) {
  std::cerr << error.what() << std::endl;
  return 3;
}
