// Reduces the number of datagrams: samples that one thread writes in succession to one destination leave as one RTPS
// message. Cyclone DDS 0.10 packs only samples of the same writer, and in lock-step each writer has about one sample
// per step. Most of the cost of a step is sending and receiving each datagram and waking the receiver's thread for it.
// All vendors can read the combined messages.
#pragma once

// Before all other headers of Cyclone: see raw_sertype.hpp.
#include "bus/cyclonedds/raw_sertype.hpp"

#include <dds/ddsi/ddsi_locator.h>
#include <dds/ddsi/ddsi_tran.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "bus/cyclonedds/packed_messages.hpp"

namespace skein::bus::cyclonedds {

/// Packs the messages of one participant. Intercepts Cyclone's writes to the sockets of the participant's domain.
class Packing {
 public:
  /// @param largest  largest datagram, in bytes
  explicit Packing(std::size_t largest) : messages_(largest) {}
  ~Packing() { release(); }
  Packing(const Packing&) = delete;
  Packing& operator=(const Packing&) = delete;

  /// Replaces the write function of the domain's UDP sockets. Call it before the first hold().
  /// @param type  a type that is registered in the participant's domain
  void install(const ddsi_sertype* type);
  /// From now on, messages that this thread writes to the domain wait for release().
  void hold();
  /// Sends the waiting messages. Call it on the thread that called hold(). Without hold() it does nothing.
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
