// Concatenates RTPS messages of one participant, so that messages to the same destination leave in one datagram.
// RTPS permits any submessages of one participant in one message: appended messages lose their RTPS header.
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
  /// INFO_DST submessage without a particular destination: ends the effect that an INFO_DST in the previous message
  /// would have on the appended one.
  static constexpr std::array<std::uint8_t, 16> kToAnybody = {0x0e, 0x01, 12, 0};

  /// @param largest  largest datagram. A larger message is sent alone.
  explicit PackedMessages(std::size_t largest) : largest_(largest) {}

  /// Appends a message to those that wait for the destination. Sends these first if the message does not fit (the
  /// datagram would be too large, or they are of another participant).
  /// @param parts  parts of the message (iov_base, iov_len); the first contains the RTPS header.
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

  void release(const auto& send) {
    for (Datagram& datagram : datagrams_) {
      if (!datagram.bytes.empty()) put_out(datagram, send);
    }
  }

 private:
  struct Datagram {
    Destination destination;
    std::vector<std::uint8_t> bytes;
  };

  bool fits(const std::vector<std::uint8_t>& bytes, const auto& first, std::size_t size) const {
    // Messages of another participant of this process in the same domain have another RTPS header.
    return bytes.size() + kToAnybody.size() + size - kHeaderSize <= largest_ && first.iov_len >= kHeaderSize &&
           std::equal(bytes.begin(), bytes.begin() + kHeaderSize, static_cast<const std::uint8_t*>(first.iov_base));
  }
  static void put_out(Datagram& datagram, const auto& send) {
    send(datagram.destination, datagram.bytes);
    datagram.bytes.clear();
  }

  const std::size_t largest_;
  std::vector<Datagram> datagrams_;  ///< by destination; emptied, not erased, since destinations are few and recur
};

}  // namespace skein::bus::cyclonedds
