#include "core/config/network_config.hpp"

#include <algorithm>
#include <filesystem>
#include <variant>

#include "core/config/config_reader.hpp"
#include "core/text/suggestion.hpp"

namespace skein {
namespace {

constexpr const char* kUsual = "usual";

bool is_file(const std::string& text) { return text.ends_with(".yaml") || text.ends_with(".yml"); }

ConfigDocument document_of(const std::string& text) {
  return is_file(text) ? read_config_document(text) : parse_config_document(text, "--network");
}

}  // namespace

void describe(auto& r, DomainNetwork& network) {
  r.field("interface", network.interface);
  r.field("peers", network.peers);
  const bool unnamed = std::ranges::any_of(network.peers, &std::string::empty);
  r.check(!unnamed, "peers", "must be names or IPv4 addresses of hosts");
  r.check(network.interface != DomainNetwork::kHost || network.peers.empty(), "peers",
          "must not be given where nothing leaves the host");
}

const DomainNetwork& NetworkConfig::of(std::string_view domain) const {
  const auto found = std::ranges::find(domains, domain, &std::pair<std::string, DomainNetwork>::first);
  return found == domains.end() ? usual : found->second;
}

void NetworkConfig::check_names(const std::vector<std::string>& known) const {
  for (const auto& [name, network] : domains) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw InputError("--network: there is no domain '" + name + "'; " + suggestion(name, known));
  }
}

NetworkConfig read_network(const std::string& text) {
  NetworkConfig network;
  if (!is_file(text) && !text.starts_with('{')) {
    network.usual.interface = text;
    return network;
  }
  for (auto& [name, entry] : read_config<Named<std::variant<std::string, DomainNetwork>>>(document_of(text))) {
    DomainNetwork domain;
    if (const auto* interface = std::get_if<std::string>(&entry)) {
      domain.interface = *interface;
    } else {
      domain = std::get<DomainNetwork>(std::move(entry));
    }
    if (name == kUsual) {
      network.usual = std::move(domain);
    } else {
      network.domains.emplace_back(name, std::move(domain));
    }
  }
  return network;
}

}  // namespace skein
