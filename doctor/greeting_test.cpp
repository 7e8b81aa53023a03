#include "doctor/greeting.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein::doctor {
namespace {

using Random = std::mt19937_64;

std::string drawn_text(Random& random) {
  std::string text(random() % 40, ' ');
  for (char& c : text) c = static_cast<char>(' ' + random() % 95);
  return text;
}

Greeting drawn_greeting(Random& random) {
  Greeting greeting{.id = static_cast<std::uint32_t>(random() | 1), .name = drawn_text(random)};
  greeting.domain = drawn_text(random);
  greeting.base = static_cast<int>(random() % 200);
  greeting.address = drawn_text(random);
  for (std::size_t i = random() % 3; i > 0; --i) greeting.vendors.push_back(drawn_text(random));
  greeting.by = drawn_text(random);
  greeting.sent_s = static_cast<double>(random() % 4'000'000'000);
  for (std::size_t i = random() % 9; i > 0; --i) greeting.heard_udp.push_back(static_cast<std::uint32_t>(random()));
  for (std::size_t i = random() % 9; i > 0; --i) greeting.heard_dds.push_back(static_cast<std::uint32_t>(random()));
  return greeting;
}

TEST(Greetings, ReadBackUnchangedFromDatagramsOfAnySize) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Greeting sent = drawn_greeting(random);
    const std::size_t size = random() % 3 == 0 ? 0 : random() % 10'000;
    const std::vector<std::uint8_t> bytes = bytes_of(sent, size);
    EXPECT_GE(bytes.size(), size);
    const auto read = read_greeting(bytes);
    ASSERT_TRUE(read) << i;
    EXPECT_EQ(read->size, size);
    EXPECT_EQ(std::tie(read->id, read->name, read->domain, read->base, read->address, read->vendors, read->by),
              std::tie(sent.id, sent.name, sent.domain, sent.base, sent.address, sent.vendors, sent.by));
    EXPECT_EQ(std::tie(read->sent_s, read->heard_udp, read->heard_dds),
              std::tie(sent.sent_s, sent.heard_udp, sent.heard_dds));
  }
}

TEST(Greetings, ArbitraryDataOnThePortDoNoHarm) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes = bytes_of(drawn_greeting(random), random() % 500);
    for (std::size_t k = random() % 8; k > 0; --k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes.resize(random() % (bytes.size() + 1));
    if (const auto read = read_greeting(bytes)) {
      EXPECT_NE(read->id, 0u);
    }
  }
  EXPECT_FALSE(read_greeting({}));
}

}  // namespace
}  // namespace skein::doctor
