// A Fast DDS type whose samples are already serialised (CDR, XCDR1 encoding). Fast DDS transports these bytes and never
// interprets them, so a program can carry message types that it was not compiled with. The type has no key.
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace skein::bus::fastdds {

/// One serialised sample, including the encapsulation header. `void* sample` below points to such an object.
using RawSample = std::vector<std::uint8_t>;

class RawType : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit RawType(const std::string& name);

  bool serialize(void* sample, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* sample) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* sample) override;
  void* createData() override;
  void deleteData(void* sample) override;
  bool getKey(void* sample, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override;
};

}  // namespace skein::bus::fastdds
