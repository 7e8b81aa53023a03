// Transports for Fast DDS that change the behaviour of its UDP transport where Skein needs it.
#pragma once

#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <cstddef>
#include <memory>

namespace skein::bus::fastdds {

/// On the loopback interface, Fast DDS's UDP transport sends to no address of this host but 127.0.0.1, although nodes
/// with default settings announce the host's other addresses and listen on all of them. This transport sends to
/// 127.0.0.1 for each address of this host, and rejects addresses of other hosts.
/// @param udp  UDP transport restricted to 127.0.0.1.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> own_host_transport(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp);

/// A transport that sends datagrams of at most `largest` bytes. The limit of the UDP transport itself would also apply
/// to received datagrams, which may be larger, because their senders may have other settings.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> packet_transport(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp, std::size_t largest);

}  // namespace skein::bus::fastdds
