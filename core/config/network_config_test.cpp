#include "core/config/network_config.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/types.hpp"

namespace skein {
namespace {

std::string network_refusal(const std::string& text, const std::vector<std::string>& known = {"world", "jurong"}) {
  try {
    read_network(text).check_names(known);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(NetworkConfig, AWordIsTheInterfaceOfAllDomains) {
  for (const char* text : {"all", "eth0", "10.1.2.3", "10.1.2.0/24"}) {
    const NetworkConfig network = read_network(text);
    EXPECT_EQ(network.of("world").interface, text);
    EXPECT_EQ(network.of("jurong"), network.of("world"));
    EXPECT_FALSE(network.of("world").host_only());
  }
  EXPECT_TRUE(NetworkConfig().of("world").host_only());
  EXPECT_TRUE(read_network("host").of("world").host_only());
}

TEST(NetworkConfig, DomainsMayHaveSettingsOfTheirOwnAndOthersHaveTheDefault) {
  const std::string text = "{usual: eth9, world: {peers: [a, 10.0.0.7]}, jurong: {interface: eth1, peers: [b]}}";
  const auto file = std::filesystem::temp_directory_path() / ("network_" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(file) << "usual: eth9\nworld:\n  peers: [a, 10.0.0.7]\njurong: {interface: eth1, peers: [b]}\n";
  const NetworkConfig network = read_network(text);
  EXPECT_EQ(read_network(file), network);
  std::filesystem::remove(file);
  EXPECT_EQ(network.of("world"), (DomainNetwork{"", {"a", "10.0.0.7"}}));
  EXPECT_EQ(network.of("jurong"), (DomainNetwork{"eth1", {"b"}}));
  EXPECT_EQ(network.of("raffles"), (DomainNetwork{"eth9", {}}));
  EXPECT_FALSE(network.of("world").host_only()) << "a domain with peers reaches other hosts";
}

TEST(NetworkConfig, ErrorsNameTheMistake) {
  EXPECT_EQ(network_refusal("{jurong: {peers: [a]}}"), "");
  EXPECT_NE(network_refusal("{jurnog: eth0}").find("did you mean 'jurong'"), std::string::npos)
      << network_refusal("{jurnog: eth0}");
  EXPECT_NE(network_refusal("{world: {peer: [a]}}").find("peer"), std::string::npos);
  EXPECT_NE(network_refusal("{world: {peers: a}}").find("world.peers"), std::string::npos);
  EXPECT_NE(network_refusal("{world: {peers: ['']}}").find("names or IPv4 addresses"), std::string::npos);
  for (const char* peer : {"10.0.0.7:7400", "10.0.0.0/24", "10.0.0.300", "10.0.0", "::1", "a b", "-a", "<a>"}) {
    const std::string refusal = network_refusal("{world: {peers: [b, '" + std::string(peer) + "']}}");
    EXPECT_NE(refusal.find("without a port, not '" + std::string(peer) + "'"), std::string::npos) << peer << refusal;
  }
  for (const char* peer : {"10.0.0.7", "a-b.example", "7up", "h_1", "localhost."}) {
    EXPECT_EQ(network_refusal("{world: {peers: ['" + std::string(peer) + "']}}"), "") << peer;
  }
  EXPECT_NE(network_refusal("{world: {interface: host, peers: [a]}}").find("nothing leaves the host"),
            std::string::npos);
  EXPECT_NE(network_refusal("{world: [").find("--network"), std::string::npos);
  EXPECT_NE(network_refusal("/nowhere/net.yaml").find("/nowhere/net.yaml"), std::string::npos);
}

}  // namespace
}  // namespace skein
