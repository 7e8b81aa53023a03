#include "sim_server/flight/contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

namespace skein::sim {
namespace {

BodyId uav(std::size_t i) { return {BodyId::Kind::uav, UavIndex{i}}; }

TEST(Contacts, TheUavComesFirstAndOfTwoUavsTheOneWithTheLowerIndex) {
  const BodyId ground{BodyId::Kind::ground, {}}, structure{BodyId::Kind::structure, {}};
  const Vector3d p_W(1, 2, 3);
  for (const auto& [a, b] : {std::pair(uav(4), ground), std::pair(uav(0), structure), std::pair(uav(2), uav(7))}) {
    for (const Contact& contact : {contact_between(a, b, p_W), contact_between(b, a, p_W)}) {
      EXPECT_EQ(contact.uav, a.uav);
      EXPECT_EQ(contact.other, b);
      EXPECT_EQ(contact.p_W, p_W);
    }
  }
}

TEST(Contacts, TheDeepestPointOfEachPairRemainsInAnyOrderOfPoints) {
  std::mt19937_64 random(3);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (int round = 0; round < 200; ++round) {
    using Pair = std::tuple<UavIndex, BodyId::Kind, UavIndex>;
    std::map<Pair, double> deepest;
    std::vector<ContactPoint> points;
    const std::size_t count = below(40);
    for (std::size_t i = 0; i < count; ++i) {
      const BodyId others[] = {{BodyId::Kind::ground, {}}, {BodyId::Kind::structure, {}}, uav(4 + below(3))};
      const double distance = -1.0 - static_cast<double>(i) * 0.01 * static_cast<double>(1 + below(5));
      const Contact contact = contact_between(uav(below(4)), others[below(3)], {distance, 0, 0});
      points.push_back({contact, distance});
      auto& least = deepest.try_emplace({contact.uav, contact.other.kind, contact.other.uav}, distance).first->second;
      least = std::min(least, distance);
    }
    std::ranges::shuffle(points, random);
    const std::vector<Contact> contacts = one_for_each_pair(points);
    ASSERT_EQ(contacts.size(), deepest.size());
    auto expected = deepest.begin();  // in the order that the header promises
    for (const Contact& contact : contacts) {
      EXPECT_EQ(Pair(contact.uav, contact.other.kind, contact.other.uav), expected->first);
      EXPECT_EQ(contact.p_W.x(), expected->second);
      ++expected;
    }
  }
}

}  // namespace
}  // namespace skein::sim
