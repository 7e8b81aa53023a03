// A Cyclone DDS type whose samples are already serialised (CDR, XCDR1 encoding). Cyclone transports these bytes and
// never interprets them, so a program can carry message types that it was not compiled with. The type has no key.
#pragma once

// dds.h comes first: it defines what the structs of the other headers depend on.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <cstdint>
#include <span>
#include <string>

namespace skein::bus::cyclonedds {

/// @returns a new type with one reference, of which dds_create_topic_sertype takes ownership if it succeeds.
ddsi_sertype* make_raw_sertype(const std::string& type_name);

/// Creates a sample to write, with one reference, of which dds_writecdr takes ownership.
/// @param payload with encapsulation header; padded with zeros to a multiple of four bytes
ddsi_serdata* make_raw_sample(const ddsi_sertype* type, std::span<const std::uint8_t> payload);

/// The payload of a sample of a raw type; valid as long as the sample.
std::span<const std::uint8_t> payload_of(const ddsi_serdata* sample);

}  // namespace skein::bus::cyclonedds
