// Fewer datagrams: what one thread writes in a row to one destination leaves as one RTPS message.
// Cyclone DDS 0.10 packs the samples of one writer only, and in lock-step each writer has one sample a step; sending,
// receiving and waking the receiver's thread for each of them is what a step costs most. Every vendor can read the
// result.
#pragma once

// Before all other headers of Cyclone, see there.
#include "bus/cyclonedds/raw_sertype.hpp"

#include <dds/ddsi/ddsi_locator.h>
#include <dds/ddsi/ddsi_tran.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "bus/cyclonedds/packed_messages.hpp"

namespace skein::bus::cyclonedds {

/// Of one participant. Stands between Cyclone and the sockets of its domain.
class Packing {
 public:
  /// @param largest  datagram, in bytes
  explicit Packing(std::size_t largest) : messages_(largest) {}
  ~Packing() { release(); }
  Packing(const Packing&) = delete;
  Packing& operator=(const Packing&) = delete;

  /// Before the first hold().
  /// @param type  registered in the participant's domain; all domains of a process may be given.
  void install(const ddsi_sertype* type);
  /// From now on, what this thread writes to the domain waits for release().
  void hold();
  /// Sends what waits; on the thread that called hold(). Without hold() it does nothing.
  void release();

 private:
  struct Target {
    ddsi_tran_conn* connection = nullptr;
    ddsi_locator_t locator = {};

    bool operator==(const Target& other) const {
      return connection == other.connection && std::memcmp(&locator, &other.locator, sizeof locator) == 0;
    }
  };

  static ssize_t write(ddsi_tran_conn_t connection, const ddsi_locator_t* destination, std::size_t parts,
                       const ddsrt_iovec_t* vectors, std::uint32_t flags);
  static void send(const Target& target, std::vector<std::uint8_t>& bytes);

  const ddsi_domaingv* domain_ = nullptr;
  bool holding_ = false;
  PackedMessages<Target> messages_;
};

}  // namespace skein::bus::cyclonedds
