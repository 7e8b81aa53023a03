// Several hosts on one machine, for tests: network namespaces, and bridges that connect some of them.
#pragma once

#include <string>
#include <vector>

namespace skein::test {

/// What it made is gone when it is. Needs to be root, in a kernel that allows it.
class Hosts {
 public:
  /// @param names  of the hosts, a few letters each
  explicit Hosts(const std::vector<std::string>& names);
  ~Hosts();
  Hosts(const Hosts&) = delete;
  Hosts& operator=(const Hosts&) = delete;

  /// Whether there are any: else nothing else may be asked for.
  bool there() const { return there_; }
  /// A network of its own among these hosts; `number`, from 0 on, makes its addresses.
  void connect(int number, const std::vector<std::string>& names);
  /// Of a host (by its place in the list of all) in a network.
  static std::string address(int network, std::size_t host);
  std::string address(int network, const std::string& name) const;
  /// What is looked up on this host is known there from now on, for programs that start later.
  void tell(const std::string& name, const std::string& alias, const std::string& address) const;
  /// The command line of a program on a host.
  std::vector<std::string> on(const std::string& name, std::vector<std::string> command) const;
  /// Runs a shell's command on a host. @returns whether it succeeded.
  bool run(const std::string& name, const std::string& command) const;
  /// What a counter of the host's IP layer says, "FragCreates" for one.
  long ip_counter(const std::string& name, const std::string& counter) const;

 private:
  std::string space(const std::string& name) const { return prefix_ + name; }

  const std::string prefix_;  ///< another for each process
  const std::vector<std::string> names_;
  bool there_ = false;
};

}  // namespace skein::test
