#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>

#include "bus/fastdds/raw_type.hpp"
#include "bus/fastdds/settings.hpp"
#include "impostor.hpp"

namespace skein::test {

namespace dds = eprosima::fastdds::dds;

Count join_fastdds(const Disguise& disguise) {
  dds::DomainParticipantQos qos = bus::fastdds::participant_qos(disguise.other, disguise.config, bus::Reach());
  auto& ports = qos.wire_protocol().port;
  ports.portBase = static_cast<std::uint16_t>(ports.portBase + ports.domainIDGain * (disguise.other - disguise.own));
  dds::DomainParticipant* participant =
      dds::DomainParticipantFactory::get_instance()->create_participant(static_cast<std::uint32_t>(disguise.own), qos);
  if (participant == nullptr) throw std::runtime_error("Fast DDS: no participant");
  dds::TypeSupport(new bus::fastdds::RawType(disguise.type)).register_type(participant);
  dds::Topic* topic = participant->create_topic(disguise.topic, disguise.type, dds::TOPIC_QOS_DEFAULT);
  dds::Subscriber* subscriber = participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  dds::DataReader* reader = subscriber->create_datareader(topic, dds::DATAREADER_QOS_DEFAULT);
  return [reader] {
    dds::SubscriptionMatchedStatus status;
    reader->get_subscription_matched_status(status);
    return status.current_count;
  };
}

}  // namespace skein::test
