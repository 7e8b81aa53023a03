// `skein doctor net` on three hosts: a server and a router on two networks, a UAV on one of these.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "child_process.hpp"
#include "hosts.hpp"
#include "tests/free_domain.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

using nlohmann::json;

class DoctorNet : public testing::Test {
 protected:
  void SetUp() override {
    if (!hosts_.there()) GTEST_SKIP() << "network namespaces need root, and a kernel and an `ip` that have them";
    try {
      hosts_.connect(0, {"server", "router"});
      hosts_.connect(1, {"server", "router", "a"});
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << "no bridges between network namespaces here: " << error.what();
    }
    std::string pattern = (std::filesystem::temp_directory_path() / "skein-doctor-test-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    std::ofstream(scenario()) << "name: one\ndesired_mm_per_pixel: 2.0\nscene: {family: towers}\n"
                                 "fleet: [{name: a, vehicle: photographer}]\n";
  }
  ~DoctorNet() override {
    doctors_.clear();
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  std::string scenario() const { return folder_ / "one.yaml"; }
  /// Configuration of the networks: in each domain, all hosts of its network are peers.
  std::string network(const std::string& host) const {
    std::string text = "{a: {peers: [" + hosts_.address(1, "server") + ", " + hosts_.address(1, "router") + ", " +
                       hosts_.address(1, "a") + "]}";
    if (host != "a")
      text += ", world: {peers: [" + hosts_.address(0, "server") + ", " + hosts_.address(0, "router") + "]}";
    return text + "}";
  }

  void start(const std::string& host, const Arguments& more = {}) {
    Arguments command = {build_path("bin/skein"), "doctor", "net", "--json", "--as", host, "--scenario", scenario()};
    command.insert(command.end(), more.begin(), more.end());
    const auto unless_given = [&](const std::string& option, const std::string& value) {
      if (std::ranges::find(more, option) == more.end()) command.insert(command.end(), {option, value});
    };
    unless_given("--network", network(host));
    unless_given("--domain", std::to_string(domains_.base()));
    unless_given("--seconds", "10");
    const std::string file = folder_ / host;
    doctors_[host] =
        std::make_unique<ChildProcess>(hosts_.on(host, command), Environment{}, file + ".out", file + ".err");
  }
  void start_all(const Arguments& more = {}) {
    for (const char* host : {"server", "router", "a"}) start(host, more);
  }
  int code(const std::string& host) { return doctors_.at(host)->wait().code; }

  /// A host's report about another host in a domain; null: there is none.
  json said(const std::string& host, const std::string& domain, const std::string& other) {
    code(host);
    const json report = json::parse(doctors_.at(host)->out(), nullptr, false);
    if (!report.is_object()) return {};
    const std::string address = hosts_.address(domain == "world" ? 0 : 1, other);
    for (const json& entry : report["domains"]) {
      for (const json& peer : entry["peers"]) {
        if (entry["domain"] == domain && peer["address"] == address) return peer;
      }
    }
    return {};
  }
  std::string hint(const std::string& host, const std::string& domain, const std::string& other) {
    return said(host, domain, other).value("hint", "");
  }
  std::string all_said() {
    std::string text;
    for (const auto& [host, doctor] : doctors_) text += host + ": " + doctor->out() + doctor->err();
    return text;
  }
  void expect_heard(const std::string& host, const std::string& domain, const std::string& other,
                    const std::vector<std::string>& vendors) {
    const json peer = said(host, domain, other);
    ASSERT_TRUE(peer.is_object()) << host << " of " << other << " in " << domain << '\n' << all_said();
    EXPECT_EQ(peer["verdict"], "ok") << peer;
    EXPECT_EQ(peer["name"], other);
    EXPECT_EQ(peer["dds"], vendors);
    EXPECT_TRUE(peer["udp"] && peer["udp_large"] && peer["hears_us"]) << peer;
  }

  Hosts hosts_{{"server", "router", "a"}};
  const FreeDomains domains_{3};
  std::filesystem::path folder_;
  std::map<std::string, std::unique_ptr<ChildProcess>> doctors_;
};

TEST_F(DoctorNet, EachHostHearsTheHostsThatShareADomainWithIt) {
  start_all({"--dds", "mixed"});
  const std::vector<std::string> both = {"cyclonedds", "fastdds"};
  for (const auto& [host, other] : {std::pair("server", "router"), {"router", "server"}}) {
    expect_heard(host, "world", other, both);
    expect_heard(host, "a", other, both);
    expect_heard(host, "a", "a", both);
    expect_heard("a", "a", host, both);
    EXPECT_TRUE(said(host, "world", "a").is_null());
  }
  for (const char* host : {"server", "router", "a"}) EXPECT_EQ(code(host), 0) << all_said();
}

TEST_F(DoctorNet, AFirewallThatDropsDdsIsDistinguishedFromSilence) {
  const int first = 7400 + 250 * (domains_.base() + 2);
  const std::string ports = std::to_string(first) + ":" + std::to_string(first + 249);
  if (!hosts_.run("a", "iptables -A INPUT -p udp --dport " + ports + " -j DROP")) GTEST_SKIP() << "no iptables";
  start_all();
  for (const char* host : {"server", "router"}) {
    EXPECT_EQ(code("a"), 1);
    const json peer = said("a", "a", host);
    EXPECT_TRUE(peer.is_object() && peer["udp"] && peer["udp_large"] && peer["dds"].empty()) << all_said();
    EXPECT_EQ(peer.value("verdict", ""), "FAIL");
    EXPECT_NE(hint("a", "a", host).find("UDP ports " + std::to_string(first) + ".."), std::string::npos) << peer;
  }
  expect_heard("server", "world", "router", {"cyclonedds"});
}

TEST_F(DoctorNet, AHostWhoseInterfaceIsDownIsNamed) {
  ASSERT_TRUE(hosts_.run("a", "ip link set eth1 down"));
  start("server");
  start("router");
  for (const char* host : {"server", "router"}) {
    EXPECT_EQ(code(host), 1);
    EXPECT_EQ(said(host, "a", "a").value("verdict", ""), "FAIL") << all_said();
    expect_heard(host, "a", host == std::string("server") ? "router" : "server", {"cyclonedds"});
  }
}

TEST_F(DoctorNet, AHostWithoutADoctorIsReported) {
  start("server");
  start("a");
  EXPECT_EQ(code("server"), 1);
  EXPECT_NE(hint("server", "world", "router").find("start `skein doctor net` there"), std::string::npos) << all_said();
  expect_heard("server", "a", "a", {"cyclonedds"});
}

TEST_F(DoctorNet, ASmallerMtuIsReported) {
  ASSERT_TRUE(hosts_.run("a", "ip link set eth1 mtu 1300"));
  start_all();
  EXPECT_EQ(code("a"), 1);
  const json peer = said("a", "a", "server");
  EXPECT_TRUE(peer.is_object() && peer["udp"] && !peer["udp_large"]) << all_said();
  EXPECT_NE(hint("a", "a", "server").find("MTU"), std::string::npos) << peer;
}

TEST_F(DoctorNet, AnotherBaseDomainIsReported) {
  start("server", {"--only", "a"});
  start("a", {"--domain", std::to_string(domains_.base() > 100 ? 10 : 110)});
  EXPECT_EQ(code("server"), 1);
  EXPECT_NE(hint("server", "a", "a").find("--domain"), std::string::npos) << all_said();
}

TEST_F(DoctorNet, WithoutPeersTheDoctorTriesMulticast) {
  for (const char* host : {"server", "a"}) start(host, {"--network", "{a: 10.77.1.0/24}"});
  expect_heard("server", "a", "a", {"cyclonedds"});
  expect_heard("a", "a", "server", {"cyclonedds"});
  EXPECT_EQ(code("a"), 0) << all_said();
}

TEST_F(DoctorNet, WrongInputEndsWithExitCodeTwo) {
  for (const Arguments& wrong : {Arguments{"--only", "b"},
                                 {"--network", "eth9"},
                                 {"--network", "{c: all}"},
                                 {"--network", "host"},
                                 {"--scenario", "nowhere.yaml"}}) {
    start("server", wrong);
    EXPECT_EQ(code("server"), 2) << all_said();
    EXPECT_FALSE(doctors_["server"]->err().empty());
  }
}

}  // namespace
}  // namespace skein::test
