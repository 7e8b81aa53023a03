// RTPS messages of one participant put behind each other, so that what goes to one destination leaves as one datagram.
// RTPS lets any submessages of one participant share a message: those that follow go without their header.
// Sizes in bytes.   Threads: one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace skein::bus::cyclonedds {

/// @tparam Destination  compared by ==.
template <class Destination>
class PackedMessages {
 public:
  static constexpr std::size_t kHeaderSize = 20;  ///< protocol, version, vendor, GUID prefix
  /// What a message said about its destination must not hold for the one that is put behind it: INFO_DST, to nobody in
  /// particular.
  static constexpr std::array<std::uint8_t, 16> kToAnybody = {0x0e, 0x01, 12, 0};

  /// @param largest  datagram. A message that is larger goes alone.
  explicit PackedMessages(std::size_t largest) : largest_(largest) {}

  /// Sends what waits for the destination if this does not fit behind it: too much, or of another participant.
  /// @param parts  of the message, iov_base and iov_len; the first holds its header.
  /// @param send  is called as send(destination, bytes).
  template <class Part, class Send>
  void add(const Destination& destination, std::span<const Part> parts, const Send& send) {
    auto found =
        std::ranges::find_if(datagrams_, [&](const Datagram& datagram) { return datagram.destination == destination; });
    if (found == datagrams_.end()) found = datagrams_.insert(found, {destination, {}});
    std::size_t size = 0;
    for (const Part& part : parts) size += part.iov_len;
    std::vector<std::uint8_t>& bytes = found->bytes;
    if (!bytes.empty() && !fits(bytes, parts.front(), size)) put_out(*found, send);
    std::size_t skip = bytes.empty() ? 0 : kHeaderSize;
    if (!bytes.empty()) bytes.insert(bytes.end(), kToAnybody.begin(), kToAnybody.end());
    for (const Part& part : parts) {
      const auto* data = static_cast<const std::uint8_t*>(part.iov_base);
      const std::size_t skipped = std::min<std::size_t>(skip, part.iov_len);
      bytes.insert(bytes.end(), data + skipped, data + part.iov_len);
      skip -= skipped;
    }
  }

  template <class Send>
  void release(const Send& send) {
    for (Datagram& datagram : datagrams_) {
      if (!datagram.bytes.empty()) put_out(datagram, send);
    }
  }

 private:
  struct Datagram {
    Destination destination;
    std::vector<std::uint8_t> bytes;
  };

  template <class Part>
  bool fits(const std::vector<std::uint8_t>& bytes, const Part& first, std::size_t size) const {
    // Another participant of this process in the same domain has another header.
    return bytes.size() + kToAnybody.size() + size - kHeaderSize <= largest_ && first.iov_len >= kHeaderSize &&
           std::equal(bytes.begin(), bytes.begin() + kHeaderSize, static_cast<const std::uint8_t*>(first.iov_base));
  }
  template <class Send>
  static void put_out(Datagram& datagram, const Send& send) {
    send(datagram.destination, datagram.bytes);
    datagram.bytes.clear();
  }

  const std::size_t largest_;
  std::vector<Datagram> datagrams_;  ///< emptied, not erased: destinations are few and stay
};

}  // namespace skein::bus::cyclonedds
