// Must precede all other headers of Cyclone DDS; raw_sertype.hpp says why.
#include "bus/cyclonedds/raw_sertype.hpp"

#include <dds/dds.h>

#include "bus/cyclonedds/domain.hpp"
#include "impostor.hpp"

namespace skein::test {

using bus::cyclonedds::check;

Count join_cyclonedds(const Disguise& disguise) {
  std::string xml = bus::cyclonedds::domain_configuration(disguise.config, bus::Reach());
  const std::string discovery = "<Discovery>";
  xml.insert(xml.find(discovery) + discovery.size(),
             "<ExternalDomainId>" + std::to_string(disguise.other) + "</ExternalDomainId>");
  const auto domain = static_cast<dds_domainid_t>(disguise.own);
  check(dds_create_domain(domain, xml.c_str()), "domain");
  const dds_entity_t participant = check(dds_create_participant(domain, nullptr, nullptr), "participant");
  ddsi_sertype* type = bus::cyclonedds::make_raw_sertype(disguise.type);
  const dds_entity_t topic =
      check(dds_create_topic_sertype(participant, disguise.topic.c_str(), &type, nullptr, nullptr, nullptr), "topic");
  const dds_entity_t reader = check(dds_create_reader(participant, topic, nullptr, nullptr), "reader");
  return [reader] { return static_cast<int>(dds_get_matched_publications(reader, nullptr, 0)); };
}

}  // namespace skein::test
