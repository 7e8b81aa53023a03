// Fewer datagrams: what one thread writes in a row to one destination leaves as one RTPS message.
// Cyclone DDS 0.10 packs the samples of one writer only, and in lock-step each writer has one sample a step; sending,
// receiving and waking the receiver's thread for each of them is what a step costs most. RTPS lets any submessages of
// one participant share a message, so every vendor can read the result.
#pragma once

// Before all other headers of Cyclone, see there.
#include "bus/cyclonedds/raw_sertype.hpp"

#include <dds/ddsi/ddsi_locator.h>
#include <dds/ddsi/ddsi_tran.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace skein::bus::cyclonedds {

/// Of one participant. Stands between Cyclone and the sockets of its domain.
class Packing {
 public:
  /// @param largest  datagram, in bytes
  explicit Packing(std::size_t largest) : largest_(largest) {}
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
  struct Datagram {
    ddsi_tran_conn* connection;
    ddsi_locator_t destination;
    std::vector<std::uint8_t> bytes;
  };

  static ssize_t write(ddsi_tran_conn_t connection, const ddsi_locator_t* destination, std::size_t parts,
                       const ddsrt_iovec_t* vectors, std::uint32_t flags);
  void add(ddsi_tran_conn_t connection, const ddsi_locator_t& destination, std::size_t parts,
           const ddsrt_iovec_t* vectors, std::size_t size);
  static void send(Datagram& datagram);

  const std::size_t largest_;
  const ddsi_domaingv* domain_ = nullptr;
  bool holding_ = false;
  std::vector<Datagram> datagrams_;  ///< emptied, not erased: destinations are few and stay
};

}  // namespace skein::bus::cyclonedds
