// Several hosts on one machine, for tests: network namespaces, and bridges that connect some of them.
#pragma once

#include <string>
#include <vector>

namespace skein::test {

/// Creates the hosts; destruction removes them. Needs root, and a kernel that allows network namespaces.
class Hosts {
 public:
  /// @param names  names of the hosts, a few letters each
  explicit Hosts(const std::vector<std::string>& names);
  ~Hosts();
  Hosts(const Hosts&) = delete;
  Hosts& operator=(const Hosts&) = delete;

  /// Whether the hosts could be created; if not, no other function may be called.
  bool there() const { return there_; }
  /// Connects these hosts by a network of their own; `number`, from 0, determines its addresses.
  void connect(int number, const std::vector<std::string>& names);
  /// Address of a host (by its index in the list of all hosts) in a network.
  static std::string address(int network, std::size_t host);
  std::string address(int network, const std::string& name) const;
  /// Adds an alias of an address to the host's name lookup, for programs that start later.
  void tell(const std::string& name, const std::string& alias, const std::string& address) const;
  /// The command line of a program on a host.
  std::vector<std::string> on(const std::string& name, std::vector<std::string> command) const;
  /// Runs a shell's command on a host. @returns whether it succeeded.
  bool run(const std::string& name, const std::string& command) const;
  /// Value of a counter of the host's IP layer, "FragCreates" for example.
  long ip_counter(const std::string& name, const std::string& counter) const;

 private:
  std::string space(const std::string& name) const { return prefix_ + name; }

  const std::string prefix_;  ///< of the namespaces' names; differs between processes
  const std::vector<std::string> names_;
  bool there_ = false;
};

}  // namespace skein::test
