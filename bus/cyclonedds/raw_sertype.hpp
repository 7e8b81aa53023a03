// A Cyclone DDS type whose samples are opaque CDR: Cyclone moves the bytes and never looks at them, so that one
// binary carries types that it was not compiled for. Keyless, XCDR1.
#pragma once

// dds.h comes first: it defines what the structs of the other headers depend on.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <cstdint>
#include <span>
#include <string>

namespace skein::bus::cyclonedds {

/// @returns a new type with one reference, which dds_create_topic_sertype takes over when it succeeds.
ddsi_sertype* make_raw_sertype(const std::string& type_name);

/// A sample to write, with one reference, which dds_writecdr takes over.
/// @param payload with encapsulation header; padded with zeros to a multiple of four bytes
ddsi_serdata* make_raw_sample(const ddsi_sertype* type, std::span<const std::uint8_t> payload);

/// The payload of a sample of a raw type; valid as long as the sample.
std::span<const std::uint8_t> payload_of(const ddsi_serdata* sample);

}  // namespace skein::bus::cyclonedds
