// UDP of Fast DDS on the loopback interface takes no address of this host but 127.0.0.1, though nodes with default
// settings announce the others and listen on all of them. This one reaches them, and nobody on other hosts.
#pragma once

#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <memory>

namespace skein::bus::fastdds {

/// @param udp  that keeps to 127.0.0.1.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> own_host_transport(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp);

}  // namespace skein::bus::fastdds
