// How a program finds its own address from the names of its peers. No host has a name that ends in .invalid (RFC 6761).
#include "bus/reach.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <netdb.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <random>
#include <set>
#include <sstream>

#include "bus/own_host.hpp"
#include "core/types.hpp"
#include "process/host/address_text.hpp"

namespace {

/// Replaces the system's resolver for unknown names: each look-up waits until `awaited` look-ups have begun.
struct Resolver {
  std::mutex mutex;
  std::condition_variable asked_more;
  int asked = 0;  ///< look-ups of unknown names that have begun
  int awaited = 0;
  int alone = 0;  ///< look-ups that waited in vain

  bool wait_for_all() {
    std::unique_lock lock(mutex);
    ++asked;
    asked_more.notify_all();
    if (asked_more.wait_for(lock, std::chrono::seconds(10), [&] { return asked >= awaited; })) return true;
    ++alone;
    return false;
  }
} resolver;

}  // namespace

extern "C" int getaddrinfo(const char* node, const char* service, const addrinfo* hints, addrinfo** found) {
  if (std::string_view(node).ends_with(".invalid")) return resolver.wait_for_all() ? EAI_NONAME : EAI_FAIL;
  static const auto systems = reinterpret_cast<decltype(&::getaddrinfo)>(::dlsym(RTLD_NEXT, "getaddrinfo"));
  return systems(node, service, hints, found);
}

namespace skein::bus {
namespace {

using std::chrono::milliseconds;

/// An address that no host has (it is reserved for examples): packets to it take the default route.
constexpr const char* kAnothers = "192.0.2.77";

in_addr address_of(const std::string& text) { return look_up(text).value(); }

class ReachTest : public testing::Test {
 protected:
  ReachTest() : before_(spdlog::default_logger()) {
    resolver.asked = resolver.awaited = resolver.alone = 0;
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(log_)));
  }
  ~ReachTest() override { spdlog::set_default_logger(before_); }

  /// The first own address that is not the loopback's.
  static std::optional<in_addr> own_address() {
    for (const OwnInterface& own : own_interfaces()) {
      if ((ntohl(own.address.s_addr) >> 24) != 127) return own.address;
    }
    return std::nullopt;
  }

  std::ostringstream log_;

 private:
  const std::shared_ptr<spdlog::logger> before_;
};

TEST_F(ReachTest, AKnownPeerIsUsedAndAnUnknownOneIsNamed) {
  const auto own = own_address();
  if (!own) GTEST_SKIP() << "this host has no address but the loopback's";
  std::mt19937 random{1};  // fixed, so that a failure can be repeated
  for (int round = 0; round < 20; ++round) {
    DomainNetwork network;
    Addresses asked;
    std::set<std::string> unknown, known;
    const int unknown_count = std::uniform_int_distribution(0, 5)(random);
    for (int i = 0; i < unknown_count; ++i) unknown.insert("nobody" + std::to_string(i) + ".invalid");
    known = {"me.invalid"};
    asked["me.invalid"] = *own;
    network.peers = {"me.invalid"};
    network.peers.insert(network.peers.end(), unknown.begin(), unknown.end());
    std::ranges::shuffle(network.peers, random);
    log_.str("");
    const Reach reach = find_reach(network, "world", milliseconds(0), asked);  // leaves no time to ask the resolver
    EXPECT_EQ(reach.address, address_text(*own));
    EXPECT_EQ(reach.peers, std::vector<std::string>{address_text(*own)});
    EXPECT_FALSE(reach.host_only);
    for (const std::string& name : unknown) EXPECT_NE(log_.str().find(name), std::string::npos) << log_.str();
    EXPECT_EQ(log_.str().empty(), unknown.empty()) << log_.str();
    EXPECT_EQ(log_.str().find("me.invalid"), std::string::npos) << log_.str();
    EXPECT_EQ(resolver.asked, 0) << "the names that were looked up before are looked up again";
  }
}

// The earlier answer differs from the one that the resolver would give, so a second look-up would change the result.
TEST_F(ReachTest, AnAddressThatWasLookedUpBeforeIsNotLookedUpAgain) {
  const Addresses asked = {{"localhost", address_of(kAnothers)}};
  const auto source = source_towards(address_of(kAnothers));
  if (!source) GTEST_SKIP() << "this host has no way to other networks";
  const Reach reach = find_reach({.interface = "", .peers = {"localhost"}}, "world", milliseconds(0), asked);
  EXPECT_EQ(reach.peers, std::vector<std::string>{kAnothers});
  EXPECT_EQ(reach.address, address_text(*source)) << "the address from which packets to that peer leave";
}

TEST_F(ReachTest, ADatagramOverTheLoopbackInterfaceIsNotLargerThanUdpAllows) {
  const Reach reach = find_reach({.interface = "lo", .peers = {}}, "world", milliseconds(0), Addresses{});
  EXPECT_GT(reach.largest_datagram, 0U);
  EXPECT_LE(reach.largest_datagram, 65507U);
}

TEST_F(ReachTest, WithoutAKnownPeerTheOwnAddressIsUnknown) {
  const DomainNetwork network{.interface = "", .peers = {"a.invalid", "b.invalid"}};
  try {
    find_reach(network, "jurong", milliseconds(0), Addresses{});
    FAIL() << "nothing tells the own address";
  } catch (const std::runtime_error& error) {
    for (const char* word : {"jurong", "a.invalid", "b.invalid", "interface"}) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

TEST_F(ReachTest, AnInterfaceTellsTheOwnAddressWithoutPeers) {
  const auto own = own_address();
  if (!own) GTEST_SKIP() << "this host has no address but the loopback's";
  const DomainNetwork network{.interface = address_text(*own), .peers = {"a.invalid"}};
  const Reach reach = find_reach(network, "world", milliseconds(0), Addresses{});
  EXPECT_EQ(reach.address, address_text(*own));
  EXPECT_TRUE(reach.by_peers()) << "with peers, there is still no multicast";
  EXPECT_THROW(check_interface({.interface = "no_such0", .peers = {}}, "world"), InputError);
}

// If the names were looked up one after the other, each look-up would wait for those that have not begun.
TEST_F(ReachTest, NamesAreLookedUpInParallelAndEachOnce) {
  std::vector<std::string> hosts = {"127.0.0.1", "127.0.0.1", "10.1.2.3"};
  resolver.awaited = 4;
  for (int i = 0; i < 2 * resolver.awaited; ++i) {
    hosts.push_back("nobody" + std::to_string(i % resolver.awaited) + ".invalid");
  }
  const Addresses addresses = look_up_all(hosts);
  EXPECT_EQ(resolver.asked, resolver.awaited);
  EXPECT_EQ(resolver.alone, 0) << "a look-up waited in vain for the others";
  ASSERT_EQ(addresses.size(), 2u);
  for (const auto& [host, address] : addresses) EXPECT_EQ(address_text(address), host);
}

}  // namespace
}  // namespace skein::bus
