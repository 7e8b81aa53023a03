// Programs with the vendors' default settings, such as ROS 2 nodes, match a fleet on the same host, although the fleet
// sends nothing to other hosts.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "bus/own_host.hpp"
#include "bus_fixture.hpp"
#include "tests/free_domain.hpp"

namespace skein::test {
namespace {

class OwnHost : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(OwnHost, MatchesParticipantsWithDefaultSettings) {
  const auto& [fleet_vendor, other_vendor] = GetParam();
  const FreeDomains domains(1);
  const auto fleet_bus = bus::make_bus({.vendor = fleet_vendor});
  bus::BusConfig by_default{.vendor = other_vendor};
  by_default.networks[bus::kEveryDomain].interface = DomainNetwork::kAll;
  const auto other_bus = bus::make_bus(by_default);
  const bool fleet_first = other_vendor == "fastdds";  // the participant that joins second discovers the first one
  std::unique_ptr<bus::Participant> fleet, other;
  if (fleet_first) fleet = fleet_bus->join(domains.base());
  other = other_bus->join(domains.base());
  if (!fleet_first) fleet = fleet_bus->join(domains.base());

  Collector at_other, at_fleet;
  const auto there = fleet->create_writer(topic("there")), back = other->create_writer(topic("back"));
  const auto heard_there = other->create_reader(topic("there"), at_other.callback());
  const auto heard_back = fleet->create_reader(topic("back"), at_fleet.callback());
  ASSERT_TRUE(eventually([&] {
    return !there->matched().empty() && !back->matched().empty() && !heard_there->matched().empty() &&
           !heard_back->matched().empty();
  }));
  for (std::uint64_t i = 0; i < 50; ++i) {
    there->write(numbered(i, 20'000));
    back->write(numbered(100 + i));
  }
  const std::vector<std::uint64_t> numbers_there = at_other.numbers(50), numbers_back = at_fleet.numbers(50);
  ASSERT_EQ(numbers_there.size(), 50U);
  ASSERT_EQ(numbers_back.size(), 50U);
  EXPECT_EQ(numbers_there.back(), 49U);
  EXPECT_EQ(numbers_back.back(), 149U);
}

// A process cannot have two participants of Cyclone DDS with different settings in one domain: tests/ros2 tests this
// pair.
INSTANTIATE_TEST_SUITE_P(Vendors, OwnHost,
                         testing::Values(std::pair("cyclonedds", "fastdds"), std::pair("fastdds", "cyclonedds"),
                                         std::pair("fastdds", "fastdds")),
                         [](const auto& pair) { return pair.param.first + "_and_default_" + pair.param.second; });

TEST(OwnAddress, IsTheLoopbackOrTheAddressOfAnInterface) {
  const auto own = [](std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
    const std::array<std::uint8_t, 4> address{a, b, c, d};
    return bus::is_own_address(address);
  };
  EXPECT_TRUE(own(127, 0, 0, 1));
  EXPECT_TRUE(own(127, 8, 8, 8));
  EXPECT_FALSE(own(203, 0, 113, 77)) << "this address is reserved for documentation";
  EXPECT_FALSE(own(239, 255, 0, 1)) << "a multicast group is not an address of this host";
}

}  // namespace
}  // namespace skein::test
