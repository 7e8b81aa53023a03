// Finds the addresses of this host. By default a fleet communicates only within the host, but must still reach other
// nodes on it, such as ROS 2 nodes with default settings. These announce the addresses of all interfaces and listen to
// multicast on all of them; on Linux they also receive multicast that is sent on the loopback interface.
#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace skein::bus {

struct OwnInterface {
  std::string name;
  in_addr address;
};
/// This host's current network interfaces with IPv4 addresses; one entry per address.
std::vector<OwnInterface> own_interfaces();

/// True for 127.0.0.0/8 and for the addresses of this host's interfaces, as they are now. What is sent to them never
/// leaves the host, whatever socket sends it. @param ipv4 as on the wire. Any thread.
bool is_own_address(std::span<const std::uint8_t, 4> ipv4);

/// True when a multicast group can be joined on the loopback interface; some sandboxes have none. Any thread.
bool multicast_on_loopback();

}  // namespace skein::bus
