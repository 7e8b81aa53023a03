#include "bus/fastdds/security.hpp"

#include <fastdds/dds/log/Log.hpp>

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>

#include "bus/vendor_log.hpp"
#include "process/files/security_files.hpp"

namespace skein::bus::fastdds {

namespace {

using eprosima::fastdds::dds::Log;

class RefusalLog : public eprosima::fastdds::dds::LogConsumer {
 public:
  void Consume(const Log::Entry& entry) override {
    const std::string_view category = entry.context.category != nullptr ? entry.context.category : "";
    // A message that arrives before its key is dropped and sent again: no refusal. Nor are other categories' warnings.
    const bool is_noise = entry.kind != Log::Error && category.find("SECURITY") == std::string_view::npos;
    if (is_noise || entry.message.starts_with("No key material yet")) return;
    log_refusal("fastdds", entry.message);
  }
};

}  // namespace

eprosima::fastrtps::rtps::PropertyPolicy security_properties(const std::filesystem::path& folder) {
  const std::string authentication = "dds.sec.auth.builtin.PKI-DH.",
                    access = "dds.sec.access.builtin.Access-Permissions.";
  const auto file = [&](const char* name) { return "file://" + std::filesystem::absolute(folder / name).string(); };
  eprosima::fastrtps::rtps::PropertyPolicy policy;
  for (const auto& [name, value] : {std::pair<std::string, std::string>{"dds.sec.auth.plugin", "builtin.PKI-DH"},
                                    {authentication + "identity_ca", file(security_files::kIdentityCa)},
                                    {authentication + "identity_certificate", file(security_files::kCertificate)},
                                    {authentication + "private_key", file(security_files::kKey)},
                                    {"dds.sec.access.plugin", "builtin.Access-Permissions"},
                                    {access + "permissions_ca", file(security_files::kPermissionsCa)},
                                    {access + "governance", file(security_files::kGovernance)},
                                    {access + "permissions", file(security_files::kPermissions)},
                                    {"dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC"}}) {
    policy.properties().emplace_back(name, value);
  }
  return policy;
}

void log_refusals() {
  static std::once_flag once;
  std::call_once(once, [] {
    Log::ClearConsumers();
    Log::RegisterConsumer(std::make_unique<RefusalLog>());
    Log::SetVerbosity(Log::Warning);
  });
}

void StrangerWatch::on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                             eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) {
  using eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
  if (info.status != ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT || !info.info.identity_token_.class_id().empty())
    return;
  std::ostringstream text;
  text << "participant " << info.info.m_guid.guidPrefix << " has no certificate and is ignored";
  log_refusal("fastdds", text.str());
}

}  // namespace skein::bus::fastdds
