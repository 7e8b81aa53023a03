// Skein's QoS settings for Fast DDS.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "bus/bus.hpp"
#include "bus/reach.hpp"

namespace skein::bus::fastdds {

eprosima::fastdds::dds::DomainParticipantQos participant_qos(int domain, const BusConfig& config, const Reach& reach);
/// @param one_host  all readers and writers are on this host
eprosima::fastdds::dds::DataWriterQos writer_qos(const Qos& qos, bool one_host);
eprosima::fastdds::dds::DataReaderQos reader_qos(const Qos& qos);

}  // namespace skein::bus::fastdds
