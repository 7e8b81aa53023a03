// DDS Security in Fast DDS.
#pragma once

#include <fastdds/rtps/attributes/PropertyPolicy.h>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <filesystem>

namespace skein::bus::fastdds {

/// Of a participant. @param folder  of process/files/security_files.hpp
eprosima::fastrtps::rtps::PropertyPolicy security_properties(const std::filesystem::path& folder);

/// From now on Fast DDS's warnings and errors go through log_refusal(), those of all participants of this process.
void log_refusals();

/// Says so in the program's log when somebody without a certificate comes to the domain, whom Fast DDS ignores in
/// silence. Of one participant, which it must outlive.
class StrangerWatch : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
};

}  // namespace skein::bus::fastdds
