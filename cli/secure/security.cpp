#include "cli/secure/security.hpp"

#include <fcntl.h>
#include <grp.h>
#include <sys/fsuid.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "cli/secure/earlier_truth.hpp"
#include "cli/secure/keys.hpp"
#include "cli/secure/rules.hpp"
#include "core/config/config_files.hpp"
#include "core/topics.hpp"
#include "core/types.hpp"
#include "process/files/closed_to_agents.hpp"
#include "process/files/private_file.hpp"
#include "process/files/security_files.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// A user id as agents have, to check what they can read; nullopt: agents run as the launcher's user.
std::optional<UserId> any_agents_user() {
  if (::geteuid() != 0) return std::nullopt;
  return UserId{kFirstAgentUser, kFirstAgentUser};
}

/// Limits to what is kept of an agent's files, since it may write without end [bytes, files].
constexpr std::uintmax_t kMostOfAnAgent = 64 << 20;
constexpr std::size_t kMostFilesOfAnAgent = 1000;

/// During its lifetime, this thread opens files with the rights of another user (setfsuid(2)).
class AsUser {
 public:
  explicit AsUser(UserId user) : groups_(static_cast<std::size_t>(::getgroups(0, nullptr))) {
    ::getgroups(static_cast<int>(groups_.size()), groups_.data());
    ::setgroups(1, &kAgentsGroup);
    gid_ = static_cast<gid_t>(::setfsgid(user.gid));
    uid_ = static_cast<uid_t>(::setfsuid(user.uid));
  }
  ~AsUser() {
    ::setfsuid(uid_);
    ::setfsgid(gid_);
    ::setgroups(groups_.size(), groups_.data());
  }
  AsUser(const AsUser&) = delete;
  AsUser& operator=(const AsUser&) = delete;

 private:
  std::vector<gid_t> groups_;
  uid_t uid_;
  gid_t gid_;
};

bool can_read(const fs::path& file, UserId user) {
  const AsUser as_user(user);
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd >= 0) ::close(fd);
  return fd >= 0;
}

/// The first folder on the path to `file` that is closed to a user, else the file itself.
fs::path closed_part(const fs::path& file, UserId user) {
  const AsUser as_user(user);
  fs::path part;
  for (const fs::path& name : file) {
    const fs::path folder = part;
    part /= name;
    struct stat status {};
    if (::stat(part.c_str(), &status) != 0) return folder;
  }
  return file;
}

void require_access(const fs::path& path, UserId user) {
  const fs::path file = fs::weakly_canonical(path);
  if (!fs::exists(file) || can_read(file, user)) return;
  const fs::path closed = closed_part(file, user);
  throw InputError("--secure: the agents run as users of their own and cannot read " + file.string() + ", since " +
                   closed.string() + " is closed to others; open it (chmod o+rX " + closed.string() +
                   "), keep the file elsewhere, or start skein as an ordinary user");
}

void give(const fs::path& path, const std::optional<UserId>& user) {
  if (!user || ::lchown(path.c_str(), user->uid, user->gid) == 0) return;
  throw std::system_error(errno, std::generic_category(),
                          "--secure: " + path.string() + " cannot be given to user id " + std::to_string(user->uid));
}

void make_private_folder(const fs::path& folder, const std::optional<UserId>& user) {
  if (::mkdir(folder.c_str(), 0700) != 0) throw std::system_error(errno, std::generic_category(), folder.string());
  give(folder, user);
}

/// Copies a regular file that belongs to `owner`. Skips everything else, such as links to files of other users.
/// @param room  bytes that may still be copied; becomes less. @returns false if the copy was cut.
bool copy_from(const fs::path& from, const fs::path& to, UserId owner, std::uintmax_t& room) {
  const int fd = ::open(from.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return true;
  struct stat status {};
  bool whole = true;
  if (::fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == owner.uid && status.st_nlink == 1) {
    std::ofstream out(to, std::ios::binary);
    std::array<char, 65536> buffer;
    ssize_t n = 0;
    while (out && room > 0 && (n = ::read(fd, buffer.data(), std::min<std::uintmax_t>(buffer.size(), room))) > 0) {
      out.write(buffer.data(), n);
      room -= static_cast<std::uintmax_t>(n);
    }
    whole = out.flush() && (n == 0 || ::read(fd, buffer.data(), 1) == 0);
  }
  ::close(fd);
  return whole;
}

}  // namespace

std::map<std::string, SecurityFiles> security_of(const FleetPlan& plan, int base_domain) {
  // Two authorities, so that no participant's certificate counts as one that may sign permissions.
  const Authority identities("identities"), documents("permissions");
  const std::string rules = documents.sign(governance(base_domain, base_domain + domain_count(plan) - 1));
  std::map<std::string, SecurityFiles> security;
  for (const auto& [program, vendor] : dds_vendors(plan)) {
    const Identity identity = identities.issue(program);
    security[program] = {{security_files::kIdentityCa, identities.certificate()},
                         {security_files::kCertificate, identity.certificate},
                         {security_files::kKey, identity.key},
                         {security_files::kPermissionsCa, documents.certificate()},
                         {security_files::kGovernance, rules},
                         {security_files::kPermissions,
                          documents.sign(permissions(identity.subject, rights_of(plan, program, base_domain)))}};
  }
  return security;
}

std::unique_ptr<UserIds> check_agents_access(const FleetPlan& plan) {
  if (::geteuid() != 0) return nullptr;
  auto users = std::make_unique<UserIds>(1);
  const UserId user = users->at(0);
  for (const fs::path& agent : agent_files(plan)) require_access(agent, user);
  require_access(plan.scenario.file, user);
  if (plan.options.faults) require_access(*plan.options.faults, user);
  for (const auto& entry : fs::recursive_directory_iterator(default_config_dir())) {
    if (entry.is_regular_file()) require_access(entry.path(), user);
  }
  return users;
}

std::vector<std::string> exposed_files(const FleetPlan& plan) {
  std::vector<std::string> warnings;
  const auto user = any_agents_user();
  if (!user) {
    warnings.push_back(
        "--secure without root: agents run as your own user, so they can read your files, the keys of "
        "other programs and their memory (docs/security.md)");
    return warnings;
  }
  std::vector<fs::path> files = plan.scenario.scene.meshes;
  files.push_back(plan.scenario.scene.points);
  for (const fs::path& file : files) {
    if (file.empty() || !can_read(file, *user)) continue;
    warnings.push_back("--secure: agents can read the ground truth in " + file.string() +
                       "; close it to others (chmod o-r)");
  }
  return warnings;
}

KeptMode::KeptMode(fs::path folder) : folder_(std::move(folder)), mode_(fs::status(folder_).permissions()) {}

KeptMode::~KeptMode() {
  std::error_code ignored;
  fs::permissions(folder_, mode_, ignored);
}

SecureRun::SecureRun(const FleetPlan& plan, int base_domain, fs::path out) : out_(std::move(out)), out_mode_(out_) {
  if (any_agents_user()) {
    const auto vendors = dds_vendors(plan);
    users_.emplace(static_cast<std::size_t>(std::count_if(
        vendors.begin(), vendors.end(), [](const auto& program) { return programs::is_agent(program.first); })));
    // Agents pass through this folder to their own.
    fs::permissions(scratch_.path(), fs::perms::others_exec | fs::perms::group_exec, fs::perm_options::add);
    fs::permissions(out_, fs::perms::owner_all);
    close_earlier_truth(out_);
  }
  make_folders(plan, base_domain);
}

void SecureRun::make_folders(const FleetPlan& plan, int base_domain) {
  std::size_t agents = 0;
  for (const auto& [program, files] : security_of(plan, base_domain)) {
    SecureFolder folder{scratch_.path() / program, {}, {}};
    if (users_ && programs::is_agent(program)) folder.user = users_->at(agents++);
    make_private_folder(folder.keys, folder.user);
    for (const auto& [name, text] : files) {
      write_private_file(folder.keys / name, text);
      give(folder.keys / name, folder.user);
    }
    if (folder.user) {
      make_private_folder(folder.out = scratch_.path() / (program + ".out"), folder.user);
      require_access(folder.keys / security_files::kKey, *folder.user);
    }
    folders_[program] = std::move(folder);
  }
}

SecureRun::~SecureRun() = default;

std::vector<std::string> SecureRun::collect() const {
  if (users_) users_->end_processes();
  std::vector<std::string> left_behind;
  for (const auto& [program, folder] : folders_) {
    if (!folder.user) continue;
    std::uintmax_t room = kMostOfAnAgent;
    std::size_t files = 0, cut = 0;
    for (const auto& entry : fs::directory_iterator(folder.out)) {
      const fs::path copy = out_ / run_folder::collected_file(program, entry.path().filename());
      if (++files > kMostFilesOfAnAgent || !copy_from(entry.path(), copy, *folder.user, room)) ++cut;
    }
    if (cut > 0) {
      left_behind.push_back(program + ": " + std::to_string(cut) +
                            " of the files that it wrote are cut short or were "
                            "left behind (the disk is full, or they are more than " +
                            std::to_string(kMostOfAnAgent >> 20) + " MB or " + std::to_string(kMostFilesOfAnAgent) +
                            " files)");
    }
  }
  return left_behind;
}

}  // namespace skein::cli
