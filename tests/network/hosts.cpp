#include "hosts.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace skein::test {
namespace {

constexpr const char* kSwitch = "sw";  ///< the namespace that contains the bridges

bool succeeds(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

void must(const std::string& command) {
  if (!succeeds(command)) throw std::runtime_error("failed: " + command);
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, decltype(&::pclose)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string text;
  for (int c = pipe ? std::fgetc(pipe.get()) : EOF; c != EOF; c = std::fgetc(pipe.get())) {
    text.push_back(static_cast<char>(c));
  }
  return text;
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> all;
  for (std::string word; in >> word;) all.push_back(word);
  return all;
}

/// The folder whose files `ip netns exec` mounts over those in /etc.
std::filesystem::path etc_of(const std::string& space) { return std::filesystem::path("/etc/netns") / space; }

}  // namespace

Hosts::Hosts(const std::vector<std::string>& names) : prefix_("sk" + std::to_string(::getpid()) + "-"), names_(names) {
  if (!succeeds("ip netns add " + space(kSwitch))) return;
  there_ = true;
  for (const std::string& name : names_) {
    must("ip netns add " + space(name));
    must("ip -n " + space(name) + " link set lo up");
  }
}

Hosts::~Hosts() {
  for (const std::string& name : names_) {
    succeeds("ip netns del " + space(name));
    std::error_code ignored;
    std::filesystem::remove_all(etc_of(space(name)), ignored);
    std::filesystem::remove("/etc/netns", ignored);  // if it is empty
  }
  succeeds("ip netns del " + space(kSwitch));
}

void Hosts::connect(int number, const std::vector<std::string>& names) {
  const std::string bridge = "br" + std::to_string(number), in_switch = "ip -n " + space(kSwitch) + " link ";
  must(in_switch + "add " + bridge + " type bridge");
  must(in_switch + "set " + bridge + " up");
  for (const std::string& name : names) {
    const std::string eth = "eth" + std::to_string(number), port = name + std::to_string(number);
    must("ip -n " + space(name) + " link add " + eth + " type veth peer name " + port + " netns " + space(kSwitch));
    must(in_switch + "set " + port + " master " + bridge + " up");
    must("ip -n " + space(name) + " addr add " + address(number, name) + "/24 dev " + eth);
    must("ip -n " + space(name) + " link set " + eth + " up");
  }
}

std::string Hosts::address(int network, std::size_t host) {
  return "10.77." + std::to_string(network) + "." + std::to_string(host + 1);
}

std::string Hosts::address(int network, const std::string& name) const {
  return address(network, static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin()));
}

void Hosts::tell(const std::string& name, const std::string& alias, const std::string& address) const {
  std::filesystem::create_directories(etc_of(space(name)));
  std::ofstream(etc_of(space(name)) / "hosts", std::ios::app) << address << ' ' << alias << '\n';
}

std::vector<std::string> Hosts::on(const std::string& name, std::vector<std::string> command) const {
  const std::vector<std::string> there = {"/usr/bin/env", "ip", "netns", "exec", space(name)};
  command.insert(command.begin(), there.begin(), there.end());
  return command;
}

bool Hosts::run(const std::string& name, const std::string& command) const {
  return succeeds("ip netns exec " + space(name) + " " + command);
}

long Hosts::ip_counter(const std::string& name, const std::string& counter) const {
  std::istringstream lines(output_of("ip netns exec " + space(name) + " cat /proc/net/snmp"));
  std::string titles, values;
  std::getline(lines, titles);
  std::getline(lines, values);
  const std::vector<std::string> keys = words(titles), numbers = words(values);
  const auto found = std::ranges::find(keys, counter);
  if (found == keys.end()) throw std::runtime_error("there is no counter " + counter);
  return std::stol(numbers.at(static_cast<std::size_t>(found - keys.begin())));
}

}  // namespace skein::test
