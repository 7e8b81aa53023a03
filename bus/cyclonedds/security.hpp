// DDS Security in Cyclone DDS.
#pragma once

#include <dds/dds.h>

#include <filesystem>
#include <pugixml.hpp>

namespace skein::bus::cyclonedds {

/// Adds <Security> to a domain's configuration.
/// @param folder  of process/files/security_files.hpp
/// @throws InputError when Cyclone's plugins are not installed; it names the Debian package.
void add_security(pugi::xml_node domain, const std::filesystem::path& folder);

/// From now on Cyclone's warnings and errors go through log_refusal(), those of all domains of this process.
void log_refusals();

/// Says so in the program's log when somebody without a certificate comes to the domain, whom Cyclone ignores in
/// silence.
/// @param participant  of this process in `domain`; its end is the end of it
void watch_strangers(int domain, dds_entity_t participant);

}  // namespace skein::bus::cyclonedds
