#include "login_hosts.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace skein::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSshd = "/usr/sbin/sshd";

bool command_works(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

}  // namespace

bool LoginHosts::set_time_of_day(const std::string& name, const std::string& off) {
  std::error_code none;
  for (const fs::directory_entry& folder : fs::directory_iterator("/usr/lib", none)) {
    const fs::path library = folder.path() / "faketime/libfaketimeMT.so.1";
    if (!fs::exists(library, none)) continue;
    // Monotonic clocks are not shifted. If a program is killed, the library leaves shared memory behind.
    variables_[name] = " LD_PRELOAD=" + library.string() + " FAKETIME=" + off + " FAKETIME_DONT_FAKE_MONOTONIC=1";
    return true;
  }
  return false;
}

std::string LoginHosts::set_up(const fs::path& folder) {
  if (!hosts_.there()) return "network namespaces need root, and support by the kernel and by `ip`";
  if (!fs::exists(kSshd)) return "no sshd here (apt-get install openssh-server)";
  try {
    hosts_.connect(0, names_);
  } catch (const std::runtime_error& error) {
    return std::string("no bridges between network namespaces here: ") + error.what();
  }
  folder_ = folder / "login";
  fs::create_directories(folder_);
  for (const char* key : {"host_key", "user_key"}) {
    if (!command_works("ssh-keygen -q -t ed25519 -N '' -f " + (folder_ / key).string())) return "no ssh-keygen here";
  }
  std::ofstream config(folder_ / "ssh_config");
  for (std::size_t i = 1; i < names_.size(); ++i) {
    config << "Host " << names_[i] << "\n  HostName " << hosts_.address(0, names_[i]) << '\n';
  }
  config << "Host *\n  User root\n  IdentityFile " << (folder_ / "user_key").string()
         << "\n  IdentitiesOnly yes\n  UserKnownHostsFile /dev/null\n  StrictHostKeyChecking no\n  LogLevel ERROR\n";
  config.close();
  for (std::size_t i = 1; i < names_.size(); ++i) start_sshd(names_[i]);
  for (std::size_t i = 1; i < names_.size(); ++i) {
    const std::string login = ssh() + " -o BatchMode=yes " + names_[i] + " true";
    if (!eventually([&] { return hosts_.run(names_[0], login) || daemons_[names_[i]]->ended(); }) ||
        daemons_[names_[i]]->ended()) {
      return "no login on " + names_[i] + ": " + log(names_[i]);
    }
  }
  return {};
}

/// Starts sshd in the mount namespace that `ip netns exec` creates, with a /run of its own, so that none of its files
/// remain. Its monotonic clock is a day ahead if the kernel has time namespaces.
void LoginHosts::start_sshd(const std::string& name) {
  fs::create_directories(temporary(name));
  fs::permissions(temporary(name), fs::perms::all | fs::perms::sticky_bit);
  std::ofstream(folder_ / (name + ".sshd_config"))
      << "ListenAddress " << hosts_.address(0, name) << ":22\nHostKey " << (folder_ / "host_key").string()
      << "\nAuthorizedKeysFile " << (folder_ / "user_key.pub").string()
      << "\nUsePAM no\nStrictModes no\nPasswordAuthentication no\nPermitRootLogin yes\nPidFile none\nSetEnv TMPDIR="
      << temporary(name).string() << variables_[name] << '\n';
  const std::string clock =
      command_works("unshare --time --monotonic 86400 true") ? "unshare --time --monotonic 86400 " : "";
  const std::string memory = variables_.contains(name) ? "mount -t tmpfs none /dev/shm && " : "";
  const std::string script = memory + "mount -t tmpfs none /run && mkdir /run/sshd && exec " + clock + kSshd +
                             " -D -e -f " + (folder_ / (name + ".sshd_config")).string();
  daemons_[name] = std::make_unique<ChildProcess>(hosts_.on(name, {"/bin/sh", "-c", script}), Environment{},
                                                  folder_ / (name + ".out"), folder_ / (name + ".sshd"));
}

std::vector<std::string> LoginHosts::processes_on(const std::string& name) const {
  std::vector<std::string> found;
  std::error_code ignored;
  for (fs::directory_iterator it("/proc", ignored), end; it != end; it.increment(ignored)) {
    std::string words = text_of(it->path() / "cmdline");
    std::ranges::replace(words, '\0', ' ');
    const std::string environment = text_of(it->path() / "environ"), mark = "TMPDIR=" + temporary(name).string();
    const bool concerned = words.find(temporary(name).string() + "/") != std::string::npos ||
                           environment.find(mark + '\0') != std::string::npos;
    if (concerned && words.find("sshd") == std::string::npos) found.push_back(words);
  }
  return found;
}

std::vector<std::string> LoginHosts::files_on(const std::string& name) const {
  std::vector<std::string> files;
  std::error_code ignored;
  for (fs::recursive_directory_iterator it(temporary(name), ignored), end; it != end; it.increment(ignored)) {
    files.push_back(it->path().lexically_relative(temporary(name)));
  }
  return files;
}

bool LoginHosts::is_clean(const std::string& name) const {
  return eventually([&] { return processes_on(name).empty() && files_on(name).empty(); });
}

void LoginHosts::cut(const std::string& name) const {
  if (!hosts_.run(name, "ip link set eth0 down")) throw std::runtime_error("cannot cut " + name);
}

void LoginHosts::mend(const std::string& name) const {
  if (!hosts_.run(name, "ip link set eth0 up")) throw std::runtime_error("cannot mend " + name);
}

}  // namespace skein::test
