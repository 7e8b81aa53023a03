// Each domain has its own network. Server and router are on all networks; two UAVs have no network in common.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

#include "child_process.hpp"
#include "hosts.hpp"
#include "tests/free_domain.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

constexpr std::size_t kSamples = 20;

/// DDS vendors of server, router, a and b.
using Vendors = std::array<std::string, 4>;

/// Value of a domain's key `interface`: none, its subnet, or "all".
enum class Interface { none, subnet, all };

class DomainNetworks : public testing::Test {
 protected:
  void SetUp() override {
    if (!hosts_.there()) GTEST_SKIP() << "network namespaces need root, and a kernel and an `ip` that have them";
    try {
      hosts_.connect(0, {"server", "router"});
      hosts_.connect(1, {"server", "router", "a"});
      hosts_.connect(2, {"server", "router", "b"});
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << "no bridges between network namespaces here: " << error.what();
    }
    std::string pattern = (std::filesystem::temp_directory_path() / "skein-network-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~DomainNetworks() override {
    peers_.clear();
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  /// "{world: {peers: [...]}, a: ...}": the peers on all networks of `host`.
  std::string network(const std::string& host, Interface interface = Interface::none) const {
    std::string text = "{";
    const auto domain = [&](const std::string& name, int number, const std::vector<std::string>& all) {
      if (std::ranges::find(all, host) == all.end()) return;
      text += text.size() > 1 ? ", " : "";
      text += name + ": {";
      if (interface == Interface::subnet) text += "interface: 10.77." + std::to_string(number) + ".0/24, ";
      if (interface == Interface::all) text += "interface: all, ";
      text += "peers: [";
      for (const std::string& other : all) text += hosts_.address(number, other) + ", ";
      text += "]}";
    };
    domain("world", 0, {"server", "router"});
    domain("a", 1, {"server", "router", "a"});
    domain("b", 2, {"server", "router", "b"});
    return text + "}";
  }

  void start(const std::string& host, const std::string& vendor, int id, const std::string& network, int bytes,
             const std::map<std::string, int>& others) {
    Arguments command = {
        helper_program("network_peer"), vendor, go(), network, std::to_string(id), std::to_string(kSamples),
        std::to_string(bytes)};
    for (const auto& [name, count] : others) {
      const int domain = domains_.base() + (name == "world" ? 0 : name == "a" ? 1 : 2);
      command.push_back(std::to_string(domain) + "=" + name + ":" + std::to_string(count));
    }
    const std::string file = folder_ / std::to_string(id);
    peers_[id] = std::make_unique<ChildProcess>(hosts_.on(host, command), Environment{}, file + ".out", file + ".err");
  }
  void start_all(const Vendors& vendors, Interface interface, int bytes) {
    start("server", vendors[0], 1, network("server", interface), bytes, {{"world", 1}, {"a", 2}, {"b", 2}});
    start("router", vendors[1], 2, network("router", interface), bytes, {{"world", 1}, {"a", 2}, {"b", 2}});
    start("a", vendors[2], 3, network("a", interface), bytes, {{"a", 2}});
    start("b", vendors[3], 4, network("b", interface), bytes, {{"b", 2}});
  }
  bool all_say(const std::string& word) {
    return eventually([&] {
      return std::ranges::all_of(peers_, [&](const auto& peer) {
        return peer.second->out().find(word) != std::string::npos || peer.second->ended();
      });
    });
  }
  std::string go() const { return folder_ / "go"; }
  std::string heard(int id, const std::string& domain) {
    const std::string mark = domain + ":";
    const auto line_of = [&] {
      const std::string text = "\n" + peers_.at(id)->out();
      const std::size_t at = text.find("\n" + mark);
      return at == std::string::npos
                 ? std::string()
                 : text.substr(at + 1 + mark.size(), text.find('\n', at + 1) - at - 1 - mark.size());
    };
    eventually([&] { return peers_.at(id)->out().find(mark) != std::string::npos || peers_.at(id)->ended(); });
    return line_of();
  }
  std::string errors() {
    std::string text;
    for (const auto& [id, peer] : peers_) text += std::to_string(id) + ": " + peer->out() + peer->err();
    return text;
  }

  Hosts hosts_{{"server", "router", "a", "b"}};
  const FreeDomains domains_{3};
  std::filesystem::path folder_;
  std::map<int, std::unique_ptr<ChildProcess>> peers_;
};

class VendorsOnNetworks : public DomainNetworks, public testing::WithParamInterface<std::pair<Vendors, Interface>> {};

TEST_P(VendorsOnNetworks, HearOnlyPeersThatShareADomainWithThem) {
  const auto& [vendors, interface] = GetParam();
  start_all(vendors, interface, 60'000);
  ASSERT_TRUE(all_say("met")) << errors();
  std::ofstream(go()) << "go";
  for (const int id : {1, 2}) {
    const std::string other = id == 1 ? " 2 x 20" : " 1 x 20";
    EXPECT_EQ(heard(id, "world"), other) << errors();
    EXPECT_EQ(heard(id, "a"), other + " 3 x 20");
    EXPECT_EQ(heard(id, "b"), other + " 4 x 20");
  }
  EXPECT_EQ(heard(3, "a"), " 1 x 20 2 x 20");
  EXPECT_EQ(heard(4, "b"), " 1 x 20 2 x 20");
  for (const char* host : {"server", "router", "a", "b"}) {
    EXPECT_EQ(hosts_.ip_counter(host, "FragCreates"), 0) << host << ": IP had to fragment datagrams";
    EXPECT_EQ(hosts_.ip_counter(host, "ForwDatagrams"), 0) << host;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Vendors, VendorsOnNetworks,
    testing::Values(std::pair(Vendors{"cyclonedds", "cyclonedds", "cyclonedds", "cyclonedds"}, Interface::all),
                    std::pair(Vendors{"fastdds", "fastdds", "fastdds", "fastdds"}, Interface::all),
                    std::pair(Vendors{"fastdds", "fastdds", "fastdds", "fastdds"}, Interface::none),
                    std::pair(Vendors{"cyclonedds", "fastdds", "fastdds", "cyclonedds"}, Interface::none),
                    std::pair(Vendors{"fastdds", "cyclonedds", "cyclonedds", "fastdds"}, Interface::subnet)),
    [](const auto& tested) {
      const Vendors& vendors = tested.param.first;
      return std::to_string(tested.index) + "_" + vendors[0] + "_" + vendors[3];
    });

TEST_F(DomainNetworks, AUavThatJoinsOtherDomainsHearsNothingThere) {
  start("server", "cyclonedds", 1, network("server"), 100, {{"world", 1}, {"a", 2}, {"b", 2}});
  start("router", "fastdds", 2, network("router"), 100, {{"world", 1}, {"a", 2}, {"b", 2}});
  start("b", "cyclonedds", 4, network("b"), 100, {{"b", 2}});
  // The UAV knows all addresses, and joins all domains.
  const std::string all = hosts_.address(0, "server") + ", " + hosts_.address(1, "server") + ", " +
                          hosts_.address(2, "server") + ", " + hosts_.address(2, "b") + ", " +
                          hosts_.address(0, "router");
  start("a", "fastdds", 3, "{usual: {interface: eth1, peers: [" + all + "]}}", 100, {{"world", 0}, {"a", 2}, {"b", 0}});
  ASSERT_TRUE(all_say("met")) << errors();
  std::ofstream(go()) << "go";
  EXPECT_EQ(heard(1, "a"), " 2 x 20 3 x 20") << errors();
  EXPECT_EQ(heard(1, "b"), " 2 x 20 4 x 20");
  EXPECT_EQ(heard(3, "a"), " 1 x 20 2 x 20");
  EXPECT_EQ(heard(3, "world"), "");
  EXPECT_EQ(heard(3, "b"), "");
}

// In containers, a name exists only while its container runs, so the first program can resolve only its own name.
TEST_F(DomainNetworks, AHostFindsItsAddressByItsOwnNameBeforeOtherNamesExist) {
  const std::string network = "{a: {peers: [sim.a, uav.a]}}";
  hosts_.tell("server", "sim.a", hosts_.address(1, "server"));
  hosts_.tell("a", "sim.a", hosts_.address(1, "server"));
  hosts_.tell("a", "uav.a", hosts_.address(1, "a"));
  for (const Vendors& vendors : {Vendors{"cyclonedds", "", "fastdds", ""}, Vendors{"fastdds", "", "cyclonedds", ""}}) {
    std::filesystem::remove(go());
    start("server", vendors[0], 1, network, 100, {{"a", 1}});
    EXPECT_TRUE(eventually([&] { return peers_.at(1)->out().find("uav.a cannot be found yet") != std::string::npos; }))
        << errors();
    start("a", vendors[2], 3, network, 100, {{"a", 1}});
    ASSERT_TRUE(all_say("met")) << errors();
    std::ofstream(go()) << "go";
    EXPECT_EQ(heard(1, "a"), " 3 x 20") << errors();
    EXPECT_EQ(heard(3, "a"), " 1 x 20");
    peers_.clear();
  }
}

}  // namespace
}  // namespace skein::test
