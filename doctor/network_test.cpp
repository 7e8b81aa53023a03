// How the doctor judges random facts of the network; a fleet's ports and locks are read from this host.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <random>

#include "doctor/network_judges.hpp"
#include "process/host/host_lock.hpp"
#include "process/program.hpp"

namespace skein::doctor {
namespace {

using Random = std::mt19937_64;

std::size_t count(const Findings& findings, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count(findings, verdict, &Finding::verdict));
}

struct Network {
  std::vector<InterfaceFacts> interfaces;
  DomainNetworkFacts domain;
};

/// Random facts of a network without faults: the host reaches all peers of the domain. Sometimes it is itself among the
/// peers.
Network drawn_network(Random& random) {
  Network drawn;
  drawn.interfaces = {{.name = "lo", .address = "127.0.0.1", .mtu = 65536, .up = true}};
  for (std::size_t i = 0; i <= random() % 3; ++i) {
    drawn.interfaces.push_back({"eth" + std::to_string(i), "10.0." + std::to_string(i) + ".1", 1500, true});
  }
  drawn.domain.domains = {"world"};
  drawn.domain.address = drawn.interfaces.back().address;
  for (std::size_t i = 0; i <= random() % 5; ++i) {
    const std::string name = "host" + std::to_string(i), address = "10.0.9." + std::to_string(10 + i);
    drawn.domain.network.peers.push_back(name);
    const bool ourselves = random() % 4 == 0;
    drawn.domain.peers.push_back({name, ourselves ? drawn.domain.address : address, drawn.domain.address});
  }
  drawn.domain.network.interface = random() % 2 == 0 ? "" : drawn.interfaces.back().name;
  return drawn;
}

TEST(NetworkJudges, OnlyPeersThatTheHostDoesNotReachAreNamed) {
  Random random(1);
  const std::vector<std::function<void(PeerFacts&)>> breaks = {
      [](PeerFacts& peer) { peer.address = peer.source = std::nullopt; },
      [](PeerFacts& peer) {
        peer.address = "172.16.0.9";
        peer.source.reset();
      },
      [](PeerFacts& peer) {
        peer.address = "172.16.0.9";
        peer.source = "172.16.0.1";
      }};
  for (int i = 0; i < 500; ++i) {
    Network drawn = drawn_network(random);
    EXPECT_EQ(count(judge_network(drawn.domain, drawn.interfaces), Verdict::ok), 1 + drawn.domain.peers.size());
    PeerFacts& peer = drawn.domain.peers[random() % drawn.domain.peers.size()];
    const PeerFacts whole = peer;
    breaks[random() % breaks.size()](peer);
    const Findings findings = judge_network(drawn.domain, drawn.interfaces);
    ASSERT_EQ(count(findings, Verdict::fail), 1u);
    const Finding& found = *std::ranges::find(findings, Verdict::fail, &Finding::verdict);
    EXPECT_EQ(found.what, "peer " + peer.name);
    EXPECT_FALSE(found.fix.empty());
    peer = whole;
    EXPECT_EQ(exit_code(judge_network(drawn.domain, drawn.interfaces)), kExitDone);
  }
}

TEST(NetworkJudges, AnInterfaceThatIsNotThereOrDownFails) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    Network drawn = drawn_network(random);
    drawn.interfaces.back().up = false;
    EXPECT_EQ(count(judge_network(drawn.domain, drawn.interfaces), Verdict::fail), 1u);
    drawn.interfaces.back().up = true;
    drawn.domain.no_interface = "--network eth9 (world): this host has no network interface of that name";
    const Findings findings = judge_network(drawn.domain, drawn.interfaces);
    EXPECT_EQ(findings.front().found, drawn.domain.no_interface);
    EXPECT_EQ(exit_code(findings), kExitCheckFailed);
  }
}

TEST(NetworkJudges, TrafficWithinTheHostNeedsTheLoopbackInterface) {
  std::vector<InterfaceFacts> interfaces = {{.name = "lo", .address = "127.0.0.1", .mtu = 65536, .up = true}};
  EXPECT_EQ(count(judge_interfaces(interfaces, true), Verdict::ok), 2u);
  EXPECT_EQ(count(judge_interfaces(interfaces, false), Verdict::warn), 1u);
  EXPECT_EQ(judge_network({.domains = {"world"}}, interfaces).at(0).verdict, Verdict::ok);
  interfaces[0].up = false;
  EXPECT_EQ(exit_code(judge_interfaces(interfaces, true)), kExitCheckFailed);
  EXPECT_EQ(exit_code(judge_interfaces({}, true)), kExitCheckFailed);
}

TEST(NetworkJudges, TheFirstFreeBlockIsChosenAndAHeldOneIsRefused) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    PortFacts ports;
    const int held = kFirstDomain + static_cast<int>(random() % 50), size = 1 + static_cast<int>(random() % 20);
    for (int domain = held; domain < held + size; ++domain) ports.held[domain] = 4711;
    BlockWish wish{.base = {}, .size = 3 + static_cast<int>(random() % 10)};
    const int expected = held - kFirstDomain >= wish.size ? kFirstDomain : held + size;
    EXPECT_TRUE(judge_ports(ports, wish)[0].found.starts_with(std::to_string(expected) + "..")) << held << ' ' << size;
    const std::string block = std::to_string(held) + ".." + std::to_string(held + size - 1) + " (process 4711)";
    EXPECT_NE(judge_ports(ports, wish)[0].found.find(block), std::string::npos) << judge_ports(ports, wish)[0].found;
    wish.base = held + size - 1;
    const Findings findings = judge_ports(ports, wish);
    EXPECT_EQ(exit_code(findings), kExitCheckFailed);
    EXPECT_NE(findings[0].found.find("4711"), std::string::npos);
    wish.base = held + size;
    EXPECT_EQ(exit_code(judge_ports(ports, wish)), kExitDone);
  }
}

TEST(NetworkJudges, PortsOfOtherProgramsAndThoseForClientsGiveWarnings) {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const BlockWish wish{.base = 1 + static_cast<int>(random() % 90), .size = 7};
    PortFacts ports;
    EXPECT_EQ(count(judge_ports(ports, wish), Verdict::ok), 3u);
    const int domain = *wish.base + static_cast<int>(random() % 7);
    const DomainPorts range = ports_of(domain, wish.participants);
    ports.taken = {range.first + static_cast<int>(random()) % 2, range.last};
    EXPECT_EQ(judge_ports(ports, wish)[1].verdict, Verdict::warn);
    ports.held[domain] = std::nullopt;  // a fleet holds the domain, so the ports are its own
    EXPECT_EQ(judge_ports(ports, wish)[1].verdict, Verdict::ok);
    ports = {};
    ports.taken = {ports_of(*wish.base, 1).first - 1, ports_of(*wish.base + 7, 1).first};
    EXPECT_EQ(judge_ports(ports, wish)[1].verdict, Verdict::ok);
  }
  // Domain 101 is the last whose ports are below 32768.
  EXPECT_EQ(judge_ports({}, {.base = 95, .size = 7})[2].verdict, Verdict::ok);
  EXPECT_EQ(judge_ports({}, {.base = 96, .size = 7})[2].verdict, Verdict::warn);
}

TEST(NetworkFacts, PortsAndLocksOfThisHostAreRead) {
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  ASSERT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
  socklen_t size = sizeof own;
  ::getsockname(fd, reinterpret_cast<sockaddr*>(&own), &size);
  EXPECT_TRUE(read_ports().taken.contains(ntohs(own.sin_port)));
  ::close(fd);
  for (int domain = kLastDomain; domain > kFirstDomain; --domain) {
    const auto lock = HostLock::try_take(domain_lock_name(domain));
    if (!lock) continue;
    const PortFacts facts = read_ports();
    ASSERT_TRUE(facts.held.contains(domain));
    EXPECT_EQ(facts.held.at(domain), ::getpid());
    return;
  }
}

}  // namespace
}  // namespace skein::doctor
