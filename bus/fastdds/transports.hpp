// What Fast DDS's UDP does otherwise where Skein needs it to.
#pragma once

#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <cstddef>
#include <memory>

namespace skein::bus::fastdds {

/// On the loopback interface it takes no address of this host but 127.0.0.1, though nodes with default settings
/// announce the others and listen on all of them. This one reaches them, and nobody on other hosts.
/// @param udp  that keeps to 127.0.0.1.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> own_host_transport(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp);

/// UDP that sends datagrams of at most `largest` bytes. Its own limit would hold for what it receives, too, which may
/// come from somebody with other settings.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> packet_transport(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp, std::size_t largest);

}  // namespace skein::bus::fastdds
