#include "bus/cyclonedds/raw_sertype.hpp"

#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "bus/wire.hpp"

namespace skein::bus::cyclonedds {

namespace {

struct RawSample : ddsi_serdata {
  std::vector<std::uint8_t> bytes;  // their number is a multiple of four, because Cyclone sends that many
};

struct RawType : ddsi_sertype {};

RawSample* raw(ddsi_serdata* sample) { return static_cast<RawSample*>(sample); }
const RawSample* raw(const ddsi_serdata* sample) { return static_cast<const RawSample*>(sample); }

RawSample* make_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size) {
  auto* sample = new RawSample{};
  ddsi_serdata_init(sample, type, kind);
  sample->hash = type->serdata_basehash;  // one instance, hence one hash
  sample->bytes.resize((size + 3) / 4 * 4);
  return sample;
}

// ---- operations on samples -------------------------------------------------------------------------------------

bool same_key(const ddsi_serdata*, const ddsi_serdata*) { return true; }

std::uint32_t size_of(const ddsi_serdata* sample) { return static_cast<std::uint32_t>(raw(sample)->bytes.size()); }

/// Builds a sample from received fragments. They may overlap; they are in ascending order of their offsets.
ddsi_serdata* from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                             std::size_t size) {
  RawSample* sample = make_sample(type, kind, size);
  std::uint32_t filled = 0;
  for (; fragment != nullptr; fragment = fragment->nextfrag) {
    const std::uint32_t end = std::min<std::uint32_t>(fragment->maxp1, static_cast<std::uint32_t>(size));
    if (end <= filled) continue;
    const unsigned char* data = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    std::memcpy(sample->bytes.data() + filled, data + (filled - fragment->min), end - filled);
    filled = end;
  }
  return sample;
}

ddsi_serdata* from_vectors(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                           const ddsrt_iovec_t* vectors, std::size_t size) {
  RawSample* sample = make_sample(type, kind, size);
  std::size_t filled = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count) && filled < size; ++i) {
    const std::size_t part = std::min<std::size_t>(vectors[i].iov_len, size - filled);
    std::memcpy(sample->bytes.data() + filled, vectors[i].iov_base, part);
    filled += part;
  }
  return sample;
}

ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash*) { return make_sample(type, SDK_KEY, 4); }

ddsi_serdata* from_struct(const ddsi_sertype*, ddsi_serdata_kind, const void*) { return nullptr; }

void copy_out(const ddsi_serdata* sample, std::size_t offset, std::size_t size, void* buffer) {
  std::memcpy(buffer, raw(sample)->bytes.data() + offset, size);
}

ddsi_serdata* lend(const ddsi_serdata* sample, std::size_t offset, std::size_t size, ddsrt_iovec_t* vector) {
  vector->iov_base = const_cast<std::uint8_t*>(raw(sample)->bytes.data()) + offset;
  vector->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(sample);
}

void give_back(ddsi_serdata* sample, const ddsrt_iovec_t*) { ddsi_serdata_unref(sample); }

bool to_struct(const ddsi_serdata*, void*, void**, void*) { return false; }

ddsi_serdata* without_type(const ddsi_serdata* sample) {
  RawSample* key = make_sample(sample->type, SDK_KEY, 4);
  key->type = nullptr;
  return key;
}

bool key_to_struct(const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return true; }

void free_sample(ddsi_serdata* sample) { delete raw(sample); }

std::size_t print(const ddsi_sertype*, const ddsi_serdata*, char* buffer, std::size_t size) {
  if (size > 0) buffer[0] = '\0';
  return 0;
}

void keyhash(const ddsi_serdata*, ddsi_keyhash* hash, bool) { std::memset(hash->value, 0, sizeof hash->value); }

ddsi_serdata_ops make_sample_operations() {
  ddsi_serdata_ops ops{};
  ops.eqkey = same_key;
  ops.get_size = size_of;
  ops.from_ser = from_fragments;
  ops.from_ser_iov = from_vectors;
  ops.from_keyhash = from_keyhash;
  ops.from_sample = from_struct;
  ops.to_ser = copy_out;
  ops.to_ser_ref = lend;
  ops.to_ser_unref = give_back;
  ops.to_sample = to_struct;
  ops.to_untyped = without_type;
  ops.untyped_to_sample = key_to_struct;
  ops.free = free_sample;
  ops.print = print;
  ops.get_keyhash = keyhash;
  return ops;
}

// ---- operations on types ---------------------------------------------------------------------------------------

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete static_cast<RawType*>(type);
}

void zero_structs(const ddsi_sertype*, void*, std::size_t) {}

void resize_structs(void** pointers, const ddsi_sertype*, void*, std::size_t, std::size_t count) {
  std::fill_n(pointers, count, nullptr);
}

void free_structs(const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {}

// Cyclone has already compared names and operations; a raw type has nothing else.
bool same_type(const ddsi_sertype*, const ddsi_sertype*) { return true; }

std::uint32_t type_hash(const ddsi_sertype*) { return 0; }

ddsi_sertype_ops make_type_operations() {
  ddsi_sertype_ops ops{};
  ops.version = ddsi_sertype_v0;
  ops.free = free_type;
  ops.zero_samples = zero_structs;
  ops.realloc_samples = resize_structs;
  ops.free_samples = free_structs;
  ops.equal = same_type;
  ops.hash = type_hash;
  return ops;
}

}  // namespace

ddsi_sertype* make_raw_sertype(const std::string& type_name) {
  static const ddsi_serdata_ops sample_operations = make_sample_operations();
  static const ddsi_sertype_ops type_operations = make_type_operations();
  auto* type = new RawType{};
  ddsi_sertype_init_flags(type, type_name.c_str(), &type_operations, &sample_operations,
                          DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type;
}

ddsi_serdata* make_raw_sample(const ddsi_sertype* type, std::span<const std::uint8_t> payload) {
  RawSample* sample = make_sample(type, SDK_DATA, 0);
  sample->bytes = padded(payload);
  return sample;
}

std::span<const std::uint8_t> payload_of(const ddsi_serdata* sample) { return raw(sample)->bytes; }

}  // namespace skein::bus::cyclonedds
