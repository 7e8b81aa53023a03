#include "bus/cyclonedds/security.hpp"

#include <dds/dds.h>
#include <dds/ddsrt/log.h>
#include <dlfcn.h>
#include <spdlog/fmt/fmt.h>

#include <array>
#include <atomic>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "bus/cyclonedds/domain.hpp"
#include "bus/vendor_log.hpp"
#include "core/text/xml_text.hpp"
#include "core/types.hpp"
#include "process/files/security_files.hpp"

namespace skein::bus::cyclonedds {

namespace {

namespace fs = std::filesystem;

/// Path of a plugin, for Cyclone to load it. Debian installs plugins in a subfolder of the library's folder, other
/// systems in that folder itself. @throws InputError if it is in neither.
fs::path plugin(const std::string& name) {
  Dl_info library{};
  if (::dladdr(reinterpret_cast<const void*>(&dds_create_domain), &library) == 0 || library.dli_fname == nullptr) {
    throw InputError("--security: the library of Cyclone DDS cannot be found");
  }
  const fs::path folder = fs::canonical(library.dli_fname).parent_path();
  const std::string file = "lib" + name + ".so";
  for (const fs::path& candidate : {folder / "libddsc0debian" / file, folder / file}) {
    if (fs::exists(candidate)) return candidate;
  }
  throw InputError("--security: Cyclone DDS has no " + file + " in " + folder.string() +
                   "; on Debian it is in the package libddsc0debian");
}

/// Whether this process has a participant in a domain. Static, because Cyclone has one log for the whole process.
std::atomic<bool>& has_participant(std::uint32_t domain) {
  static std::array<std::atomic<bool>, kMaxDomain + 1> domains{};
  static std::atomic<bool> none = true;
  return domain < domains.size() ? domains[domain] : none;
}

/// Whether a message only reports that Cyclone refused a remote participant because this process's own participant did
/// not exist yet, although its domain did. The remote participant will try again.
bool is_premature(std::string_view text, std::uint32_t domain) {
  return text.starts_with("Remote secure participant ") && !has_participant(domain);
}

/// Whether a GUID is bound to a certificate: its first bit (DDS Security 1.1, 9.3.3).
bool is_bound(const dds_guid_t& guid) { return (guid.v[0] & 0x80) != 0; }

std::string text_of(const dds_guid_t& guid) {
  std::string text;
  for (const std::uint8_t byte : std::span(guid.v).first<12>()) text += fmt::format("{:02x}", byte);
  return text;
}

/// Cyclone calls this listener whenever a participant appears or disappears.
void look_at_newcomers(dds_entity_t reader, void*) {
  std::array<void*, 8> samples{};
  std::array<dds_sample_info_t, 8> infos;
  for (;;) {
    const dds_return_t count = dds_take(reader, samples.data(), infos.data(), samples.size(), samples.size());
    if (count <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto* newcomer = static_cast<const dds_builtintopic_participant_t*>(samples[i]);
      if (infos[i].valid_data && infos[i].instance_state == DDS_IST_ALIVE && !is_bound(newcomer->key)) {
        log_refusal("cyclonedds", "participant " + text_of(newcomer->key) + " has no certificate and is ignored");
      }
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

/// Adds the configuration element of a plugin: its path, then its files.
void add_plugin(pugi::xml_node security, const char* element, const std::string& library,
                const std::vector<std::pair<const char*, fs::path>>& files) {
  pugi::xml_node settings = security.append_child(element);
  settings.append_child("Library").append_attribute("path") = plugin(library).c_str();
  for (const auto& [name, file] : files) add_element(settings, name, "file:" + file.string());
}

}  // namespace

void add_security(pugi::xml_node domain, const fs::path& folder) {
  const fs::path absolute = fs::absolute(folder);
  pugi::xml_node security = domain.append_child("Security");
  add_plugin(security, "Authentication", "dds_security_auth",
             {{"IdentityCA", absolute / security_files::kIdentityCa},
              {"IdentityCertificate", absolute / security_files::kCertificate},
              {"PrivateKey", absolute / security_files::kKey}});
  add_plugin(security, "Cryptographic", "dds_security_crypto", {});
  add_plugin(security, "AccessControl", "dds_security_ac",
             {{"PermissionsCA", absolute / security_files::kPermissionsCa},
              {"Governance", absolute / security_files::kGovernance},
              {"Permissions", absolute / security_files::kPermissions}});
}

void log_refusals() {
  dds_set_log_sink(
      [](void*, const dds_log_data_t* entry) {
        if ((entry->priority & (DDS_LC_FATAL | DDS_LC_ERROR | DDS_LC_WARNING)) == 0) return;
        const std::string_view text(entry->message, entry->size);
        if (!is_premature(text, entry->domid)) log_refusal("cyclonedds", text);
      },
      nullptr);
}

void watch_strangers(int domain, dds_entity_t participant) {
  has_participant(static_cast<std::uint32_t>(domain)) = true;
  dds_listener_t* listener = dds_create_listener(nullptr);
  dds_lset_data_available(listener, look_at_newcomers);
  check(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, listener), "cannot see newcomers");
  dds_delete_listener(listener);
}

}  // namespace skein::bus::cyclonedds
