#include "bus/fastdds/raw_type.hpp"

#include <cstring>

namespace skein::bus::fastdds {

using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

namespace {
const RawSample& raw(void* sample) { return *static_cast<RawSample*>(sample); }
}  // namespace

RawType::RawType(const std::string& name) {
  setName(name.c_str());
  // Only the initial allocation: histories grow with their samples.
  m_typeSize = 256;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool RawType::serialize(void* sample, SerializedPayload_t* payload) {
  const RawSample& bytes = raw(sample);
  if (payload->max_size < bytes.size()) return false;
  std::memcpy(payload->data, bytes.data(), bytes.size());
  payload->length = static_cast<std::uint32_t>(bytes.size());
  payload->encapsulation = bytes.size() > 1 && bytes[1] == 0 ? CDR_BE : CDR_LE;
  return true;
}

bool RawType::deserialize(SerializedPayload_t* payload, void* sample) {
  static_cast<RawSample*>(sample)->assign(payload->data, payload->data + payload->length);
  return true;
}

std::function<std::uint32_t()> RawType::getSerializedSizeProvider(void* sample) {
  return [sample] { return static_cast<std::uint32_t>(raw(sample).size()); };
}

void* RawType::createData() { return new RawSample; }

void RawType::deleteData(void* sample) { delete static_cast<RawSample*>(sample); }

bool RawType::getKey(void*, InstanceHandle_t*, bool) { return false; }

}  // namespace skein::bus::fastdds
