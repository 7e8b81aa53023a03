#include "core/config/network_config.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <variant>

#include "core/config/config_reader.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/text/whole_number.hpp"

namespace skein {
namespace {

constexpr const char* kUsual = "usual";

/// Whether a text may be the name of a host, or is a complete IPv4 address. Skein looks up unknown names again and
/// again. So for an address with a port or a prefix length, it would wait for ever without an error message.
bool may_be_host(const std::string& text) {
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
  };
  if (text.empty() || text[0] == '-' || !std::ranges::all_of(text, fits)) return false;
  if (text.find_first_not_of("0123456789.") != std::string::npos) return true;
  const std::vector<std::string> numbers = split(text, '.');
  const auto is_byte = [](const std::string& number) {
    const auto value = parse_whole(number);
    return value && *value <= 255;
  };
  return numbers.size() == 4 && std::ranges::all_of(numbers, is_byte);
}

bool is_file(const std::string& text) { return text.ends_with(".yaml") || text.ends_with(".yml"); }

ConfigDocument document_of(const std::string& text) {
  return is_file(text) ? read_config_document(text) : parse_config_document(text, "--network");
}

}  // namespace

void describe(auto& r, DomainNetwork& network) {
  r.field("interface", network.interface);
  r.field("peers", network.peers);
  for (const std::string& peer : network.peers) {
    r.check(may_be_host(peer), "peers", "must be names or IPv4 addresses of hosts, without a port, not '" + peer + "'");
  }
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
