// DDS Security in Cyclone DDS.
#pragma once

#include <dds/dds.h>

#include <filesystem>
#include <pugixml.hpp>

namespace skein::bus::cyclonedds {

/// Adds <Security> to a domain's configuration.
/// @param folder  folder with the files of process/files/security_files.hpp
/// @throws InputError when Cyclone's plugins are not installed; it names the Debian package.
void add_security(pugi::xml_node domain, const std::filesystem::path& folder);

/// From now on, log_refusal() logs Cyclone's warnings and errors of all domains of this process.
void log_refusals();

/// Logs a message when a participant without a certificate appears in the domain; Cyclone itself ignores it silently.
/// @param participant  of this process in `domain`; the watch ends when it is deleted
void watch_strangers(int domain, dds_entity_t participant);

}  // namespace skein::bus::cyclonedds
