// DDS Security in Fast DDS.
#pragma once

#include <fastdds/rtps/attributes/PropertyPolicy.h>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <filesystem>

namespace skein::bus::fastdds {

/// Security properties of a participant. @param folder  folder with the files of process/files/security_files.hpp
eprosima::fastrtps::rtps::PropertyPolicy security_properties(const std::filesystem::path& folder);

/// From now on, log_refusal() logs Fast DDS's warnings and errors of all participants of this process.
void log_refusals();

/// Listener of one participant, which it must outlive. Logs a message when a participant without a certificate appears
/// in the domain; Fast DDS itself ignores it silently.
class StrangerWatch : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
};

}  // namespace skein::bus::fastdds
