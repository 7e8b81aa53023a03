// Simulates hosts with login by ssh: network namespaces, each with a real sshd on its own address and keys made for the
// test. The first host is that of the launcher and has no sshd. set_time_of_day() can give a host a wrong clock.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "child_process.hpp"
#include "hosts.hpp"

namespace skein::test {

class LoginHosts {
 public:
  /// @param names  names of the hosts; the launcher runs on the first
  explicit LoginHosts(const std::vector<std::string>& names) : names_(names), hosts_(names) {}

  /// Shifts the time of day that programs on that host see, by "+5h" or "-30d" for example (Debian's libfaketime).
  /// Call it before set_up(). @returns false without that library.
  bool set_time_of_day(const std::string& name, const std::string& off);
  /// Starts the hosts and waits until login works. @returns why it does not work here; empty: it works.
  std::string set_up(const std::filesystem::path& folder);

  const Hosts& hosts() const { return hosts_; }
  /// The command that logs in on the hosts, with its options, for --ssh.
  std::string ssh() const { return "ssh -F " + (folder_ / "ssh_config").string(); }
  /// Where programs on that host put their temporary files.
  std::filesystem::path temporary(const std::string& name) const { return folder_ / (name + ".tmp"); }
  /// Command lines of all processes, without sshd, that name that host's temporary folder in command line or TMPDIR.
  std::vector<std::string> processes_on(const std::string& name) const;
  /// Waits until neither processes nor files of a fleet are left there. @returns false after a timeout.
  bool is_clean(const std::string& name) const;
  /// Names of all temporary files there.
  std::vector<std::string> files_on(const std::string& name) const;
  /// Cuts the network between that host and the others.
  void cut(const std::string& name) const;
  /// Ends cut().
  void mend(const std::string& name) const;
  /// What that host's sshd has logged.
  std::string log(const std::string& name) const { return text_of(folder_ / (name + ".sshd")); }

 private:
  void start_sshd(const std::string& name);

  const std::vector<std::string> names_;
  Hosts hosts_;
  std::filesystem::path folder_;
  std::map<std::string, std::string> variables_;  ///< by host: environment variables of programs that start there
  std::map<std::string, std::unique_ptr<ChildProcess>> daemons_;
};

}  // namespace skein::test
