#include "doctor/net_program.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <future>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"
#include "doctor/checks_program.hpp"
#include "doctor/greeting_socket.hpp"
#include "process/host/host_name.hpp"

namespace skein::doctor {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kGreetAgain{250}, kLookAgain{20}, kAskAgain{200}, kLeaving{2000};
/// With --until-heard: number of greetings that a host still sends once all hosts hear each other. These greetings tell
/// the other hosts that this host hears them.
constexpr int kFarewells = 4;
constexpr std::array<std::uint8_t, 4> kEncapsulation = {0, 1, 0, 0};  // CDR_LE

bus::TopicSpec greeting_topic() { return {"rt/skein/doctor", "skein_doctor::msg::dds_::Greeting_", {}}; }

/// This host's participant in one domain, with one vendor.
struct Voice {
  std::size_t meeting = 0;
  std::string vendor;
  std::unique_ptr<bus::Participant> participant;
  std::unique_ptr<bus::Writer> writer{};
  std::unique_ptr<bus::Reader> reader{};
};

double time_of_day_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::uint32_t drawn_id() {
  std::random_device source;
  return std::uniform_int_distribution<std::uint32_t>(1)(source);
}

/// The domains in which to take part. @throws InputError if there are none, or --only lists an unknown one.
std::vector<std::string> chosen(const NetVisit& visit) {
  for (const std::string& name : visit.only) {
    if (std::ranges::find(visit.domains, name) != visit.domains.end()) continue;
    throw InputError("--only: there is no domain '" + name + "'; " + suggestion(name, visit.domains));
  }
  std::vector<std::string> names;
  for (const std::string& name : visit.domains) {
    const bool wanted = visit.only.empty() || std::ranges::find(visit.only, name) != visit.only.end();
    if (wanted && !visit.network.of(name).host_only()) names.push_back(name);
  }
  if (names.empty()) {
    throw InputError(std::string("by its network settings, ") +
                     (visit.only.empty() ? "no domain of the fleet" : "none of these domains") +
                     " reaches other hosts, so there is nothing to check; say with --network how the hosts reach each "
                     "other");
  }
  return names;
}

class Host {
 public:
  Host(const NetVisit& visit, StopSignal& stop) : visit_(visit), stop_(stop) {
    all_.id = drawn_id();
    all_.name = visit.name.empty() ? host_name("host") : visit.name;
    for (const std::string& name : chosen(visit)) {
      const auto place = std::ranges::find(visit.domains, name) - visit.domains.begin();
      bus::check_interface(visit.network.of(name), name);
      all_.domains.push_back({.domain = name, .number = visit.base + static_cast<int>(place), .base = visit.base});
    }
  }

  const Meetings& run() {
    look_up_peers();
    for (Meeting& meeting : all_.domains) find_way(meeting);
    for (const std::string& vendor : visit_.vendors) join(vendor);
    stop_.on_stop([this] { inbox_.wake(); });
    const auto end = SteadyClock::now() + visit_.time;
    int farewells = visit_.until_heard ? kFarewells : std::numeric_limits<int>::max();
    for (auto due = SteadyClock::now(); SteadyClock::now() < end && farewells > 0 && !stop_.requested(); listen()) {
      if (SteadyClock::now() < due) continue;
      due += kGreetAgain;
      greet();
      if (farewells < kFarewells || (visit_.until_heard && all_hear_each_other(all_))) --farewells;
    }
    stop_.on_stop({});
    return all_;
  }

 private:
  const DomainNetwork& network_of(const Meeting& meeting) const { return visit_.network.of(meeting.domain); }

  /// Looks up all peers in parallel, again and again until all are known.
  void look_up_peers() {
    std::set<std::string> names;
    for (const Meeting& meeting : all_.domains) {
      names.insert(network_of(meeting).peers.begin(), network_of(meeting).peers.end());
    }
    const auto deadline = SteadyClock::now() + visit_.time;
    while (!stop_.requested()) {
      const bus::Addresses addresses = bus::look_up_all({names.begin(), names.end()});
      for (Meeting& meeting : all_.domains) meeting.peers = peers_of(network_of(meeting).peers, addresses);
      if (addresses.size() == names.size() || SteadyClock::now() >= deadline) return;
      inbox_.dispatch(kAskAgain);  // no event reports that a name has become known
    }
  }

  void find_way(Meeting& meeting) {
    try {
      const bus::Reach reach = bus::find_reach(network_of(meeting), meeting.domain, std::chrono::milliseconds(0));
      meeting.address = reach.address;
      meeting.largest = reach.largest_datagram;
      if (network_of(meeting).peers.empty()) socket_.join_group(meeting.address);
    } catch (const std::runtime_error& error) {
      meeting.trouble = error.what();
    }
  }

  void join(const std::string& vendor) {
    bus::BusConfig config{.vendor = vendor, .peers_patience = std::chrono::milliseconds(0)};
    for (const Meeting& meeting : all_.domains) config.networks[meeting.number] = network_of(meeting);
    buses_.push_back(bus::make_bus(config));
    for (std::size_t i = 0; i < all_.domains.size(); ++i) {
      Meeting& meeting = all_.domains[i];
      if (meeting.largest == 0) continue;  // find_way() failed
      try {
        voices_.push_back(make_voice(*buses_.back(), vendor, i));
        meeting.vendors.push_back(vendor);
      } catch (const std::runtime_error& error) {
        meeting.trouble += (meeting.trouble.empty() ? "" : "; ") + vendor + " cannot join: " + error.what();
      }
    }
  }

  Voice make_voice(bus::Bus& bus, const std::string& vendor, std::size_t i) {
    Voice voice{.meeting = i, .vendor = vendor, .participant = bus.join(all_.domains[i].number)};
    voice.writer = voice.participant->create_writer(greeting_topic());
    voice.reader = inbox_.subscribe(*voice.participant, greeting_topic(), [this, i](bus::Sample&& sample) {
      if (sample.payload.size() < kEncapsulation.size()) return;
      const auto greeting = read_greeting(std::span(sample.payload).subspan(kEncapsulation.size()));
      if (greeting) all_.note_sample(all_.domains[i], *greeting);
    });
    return voice;
  }

  void greet() {
    for (Meeting& meeting : all_.domains) {
      if (meeting.largest == 0) continue;
      Greeting greeting = all_.greeting(meeting);
      greeting.sent_s = time_of_day_s();
      if (network_of(meeting).peers.empty()) send(meeting, greeting, GreetingSocket::kGroup);
      for (const PeerFacts& peer : meeting.peers) {
        if (peer.address && !peer.ourselves()) send(meeting, greeting, *peer.address);
      }
    }
    for (const Voice& voice : voices_) {
      Greeting greeting = all_.greeting(all_.domains[voice.meeting]);
      greeting.by = voice.vendor;
      std::vector<std::uint8_t> payload(kEncapsulation.begin(), kEncapsulation.end());
      const std::vector<std::uint8_t> bytes = bytes_of(greeting);
      payload.insert(payload.end(), bytes.begin(), bytes.end());
      payload.resize((payload.size() + 3) / 4 * 4, ' ');  // else the bus would pad it with zeros
      voice.writer->write(payload);
    }
  }
  void send(Meeting& meeting, const Greeting& greeting, const std::string& to) {
    for (const std::size_t size : {std::size_t{0}, meeting.largest}) {
      const std::string refused = socket_.send(meeting.address, to, bytes_of(greeting, size));
      if (!refused.empty()) meeting.refused[to] = refused;
    }
  }

  void listen() {
    inbox_.dispatch(kLookAgain);
    socket_.take(
        [this](std::span<const std::uint8_t> bytes, const std::string& from, const std::string& at) {
          if (const auto greeting = read_greeting(bytes)) {
            all_.note_datagram(*greeting, from, at, bytes.size(), time_of_day_s());
          }
        },
        [this](const std::string& to, const std::string& why) {
          for (Meeting& meeting : all_.domains) meeting.refused[to] = why;
        });
  }

  const NetVisit& visit_;
  StopSignal& stop_;
  Meetings all_;
  GreetingSocket socket_;
  bus::Inbox inbox_;
  std::vector<std::unique_ptr<bus::Bus>> buses_;
  std::vector<Voice> voices_;
};

}  // namespace

int meet(const NetVisit& visit, StopSignal& stop, const std::function<int(const Meetings&)>& tell) {
  auto host = std::make_unique<Host>(visit, stop);
  const int code = tell(host->run());
  // To leave a domain, Cyclone DDS wakes its own threads by a datagram to itself. If a firewall drops this datagram,
  // Cyclone waits for ever.
  std::promise<void> left;
  std::thread watch([code, done = left.get_future()] {
    if (done.wait_for(kLeaving) == std::future_status::timeout) std::_Exit(code);
  });
  host.reset();
  left.set_value();
  watch.join();
  return code;
}

}  // namespace skein::doctor
