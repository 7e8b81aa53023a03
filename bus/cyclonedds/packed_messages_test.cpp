// Packs messages, and unpacks them again as the receiver does.
#include "bus/cyclonedds/packed_messages.hpp"

#include <gtest/gtest.h>
#include <sys/uio.h>

#include <map>
#include <string>

#include "core/math/random_stream.hpp"

namespace skein::bus::cyclonedds {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Packed = PackedMessages<int>;
constexpr std::size_t kHeader = Packed::kHeaderSize, kBetween = Packed::kToAnybody.size();

/// A message: the header of `participant`, and `size` bytes of the value `number`, which no other message has.
Bytes message(std::uint8_t participant, std::uint8_t number, std::size_t size) {
  Bytes bytes(kHeader, participant);
  bytes.insert(bytes.end(), size, number);
  return bytes;
}

/// Adds a message in parts of random sizes, as DDS passes them; the first part contains the whole header.
template <class Send>
void add(Packed& packed, int to, const Bytes& bytes, RandomStream& random, const Send& send) {
  std::vector<iovec> parts;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t least = at == 0 ? kHeader : 1, left = bytes.size() - at;
    const auto size = std::min(left, least + static_cast<std::size_t>(random.uniform(0.0, 60.0)));
    parts.push_back({const_cast<std::uint8_t*>(bytes.data()) + at, size});
    at += size;
  }
  packed.add(to, std::span<const iovec>(parts), send);
}

TEST(PackedMessages, AllMessagesArriveOnceInOrderAndInAsFewDatagramsAsPossible) {
  for (std::uint64_t world = 0; world < 60; ++world) {
    RandomStream random(world, "packed", 0);
    const std::size_t largest = 300;
    Packed packed(largest);
    std::map<int, std::vector<Bytes>> sent, arrived;
    std::map<int, std::size_t> room;       // bytes of the datagram that is being filled
    std::size_t datagrams = 0, least = 0;  // number of sent datagrams, and the smallest possible number
    std::map<int, std::uint8_t> former;    // participant of the last message to each destination
    const auto send = [&](int to, const Bytes& bytes) {
      ++datagrams;
      if (bytes.size() > largest) {
        EXPECT_TRUE(std::ranges::count(bytes, bytes[kHeader]) == static_cast<long>(bytes.size() - kHeader))
            << "a message larger than a datagram must travel alone";
      }
      const Bytes header(bytes.begin(), bytes.begin() + kHeader);
      for (std::size_t at = kHeader; at < bytes.size();) {
        Bytes one = header;
        const std::uint8_t number = bytes[at];
        while (at < bytes.size() && bytes[at] == number) one.push_back(bytes[at++]);
        arrived[to].push_back(one);
        if (at == bytes.size()) break;
        EXPECT_TRUE(std::equal(Packed::kToAnybody.begin(), Packed::kToAnybody.end(), bytes.begin() + long(at)));
        at += kBetween;
      }
    };
    for (int i = 0; i < 100; ++i) {
      const int to = static_cast<int>(random.uniform(0.0, 3.0));
      const auto participant = static_cast<std::uint8_t>(random.uniform() < 0.9 ? 200 : 201);
      const Bytes one = message(participant, static_cast<std::uint8_t>(20 + i),
                                static_cast<std::size_t>(random.uniform(1.0, random.uniform() < 0.1 ? 400.0 : 120.0)));
      sent[to].push_back(one);
      const bool more =
          room[to] > 0 && former[to] == participant && room[to] + kBetween + one.size() - kHeader <= largest;
      least += more ? 0 : 1;
      room[to] = more ? room[to] + kBetween + one.size() - kHeader : one.size();
      former[to] = participant;
      add(packed, to, one, random, send);
    }
    packed.release(send);
    EXPECT_EQ(arrived, sent) << world;
    EXPECT_EQ(datagrams, least) << world;
    packed.release(send);
    EXPECT_EQ(datagrams, least) << "nothing is sent twice";
  }
}

}  // namespace
}  // namespace skein::bus::cyclonedds
