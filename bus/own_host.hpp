// What of the network is this very host: a fleet keeps to it unless it is told otherwise, and still meets the nodes
// beside it that do not, such as ROS 2 nodes with default settings. These announce the addresses of their interfaces
// and listen to multicast on all of them; on Linux that includes what is sent to a group on the loopback interface.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace skein::bus {

/// True for 127.0.0.0/8 and for the addresses of this host's interfaces, as they are now. What is sent to them never
/// leaves the host, whatever socket sends it. @param ipv4 as on the wire. Any thread.
bool is_own_address(std::span<const std::uint8_t, 4> ipv4);

/// The first IPv4 address of a network interface, as text; nullopt when there is none of that name, or none with one.
std::optional<std::string> address_of(const std::string& interface);

/// True when a multicast group can be joined on the loopback interface; some sandboxes have none. Any thread.
bool multicast_on_loopback();

}  // namespace skein::bus
