// Hosts on which one can log in: network namespaces, each with a real sshd of its own on its address, throwaway keys,
// and clocks that differ. The first is the launcher's and has none.
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
  /// @param names  the first is the launcher's
  explicit LoginHosts(const std::vector<std::string>& names) : names_(names), hosts_(names) {}

  /// What is started on that host sees a time of day that is so far off: "+5h", "-30d" (Debian's libfaketime).
  /// Before set_up(). @returns false without that library.
  bool set_time_of_day(const std::string& name, const std::string& off);
  /// Starts what is needed. @returns why that cannot be here; empty: it stands.
  std::string set_up(const std::filesystem::path& folder);

  const Hosts& hosts() const { return hosts_; }
  /// What logs in on them, with its options, for --ssh.
  std::string ssh() const { return "ssh -F " + (folder_ / "ssh_config").string(); }
  /// Where programs on that host put their temporary files.
  std::filesystem::path temporary(const std::string& name) const { return folder_ / (name + ".tmp"); }
  /// Command lines of all processes that have to do with that host's temporary files.
  std::vector<std::string> processes_on(const std::string& name) const;
  /// Neither processes nor files of a fleet are left there, after a while.
  bool is_clean(const std::string& name) const;
  /// Names of all files of a fleet there.
  std::vector<std::string> files_on(const std::string& name) const;
  void cut(const std::string& name) const;
  void mend(const std::string& name) const;
  std::string log(const std::string& name) const { return text_of(folder_ / (name + ".sshd")); }

 private:
  void start_sshd(const std::string& name);

  const std::vector<std::string> names_;
  Hosts hosts_;
  std::filesystem::path folder_;
  std::map<std::string, std::string> variables_;  ///< by host, of what is started there
  std::map<std::string, std::unique_ptr<ChildProcess>> daemons_;
};

}  // namespace skein::test
