// A Fast DDS type whose samples are opaque CDR: Fast DDS moves the bytes and never looks at them, so that one binary
// carries types that it was not compiled for. Keyless, XCDR1.
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace skein::bus::fastdds {

/// What Fast DDS writes from and reads into: a payload with encapsulation header.
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
