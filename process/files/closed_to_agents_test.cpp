#include "process/files/closed_to_agents.hpp"

#include <fcntl.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

constexpr uid_t kSomebody = 60710;
constexpr gid_t kProject = 54321;

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

/// Whether a user who is in these groups, and in no others, can open the file.
bool opens(const fs::path& path, const std::vector<gid_t>& groups) {
  const pid_t child = ::fork();
  if (child == 0) {
    const bool ready =
        ::setgroups(groups.size(), groups.data()) == 0 && ::setgid(kSomebody) == 0 && ::setuid(kSomebody) == 0;
    ::_exit(ready ? (::open(path.c_str(), O_RDONLY) >= 0 ? 0 : 1) : 2);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_LT(WEXITSTATUS(status), 2);
  return WEXITSTATUS(status) == 0;
}

class ClosedToAgents : public testing::Test {
 protected:
  ClosedToAgents() {
    std::string name = fs::temp_directory_path() / "skein-closed-XXXXXX";
    dir_ = ::mkdtemp(name.data());
    ::chmod(dir_.c_str(), 0755);
  }
  ~ClosedToAgents() override { fs::remove_all(dir_); }

  fs::path dir_;
};

TEST_F(ClosedToAgents, OnlyAgentsLoseAccessInAnyMode) {
  if (::geteuid() != 0) GTEST_SKIP() << "agents have users of their own only if root starts them";
  for (mode_t bits = 0; bits < 0100; ++bits) {
    for (const bool is_folder : {false, true}) {
      const fs::path path = dir_ / (std::to_string(bits) + (is_folder ? "d" : "f"));
      if (is_folder) {
        fs::create_directory(path);
      } else {
        std::ofstream(path) << "truth";
      }
      ASSERT_EQ(::chown(path.c_str(), 0, kProject), 0);
      ASSERT_EQ(::chmod(path.c_str(), 0700 | bits), 0);
      const bool others_could = opens(path, {}), project_could = opens(path, {kProject});
      const bool group_differs = bits >> 3 != (bits & 07);
      EXPECT_EQ(close_to_agents(path), (bits & 07) != 0) << std::oct << bits;
      EXPECT_FALSE(opens(path, {kAgentsGroup})) << std::oct << bits;
      EXPECT_FALSE(close_to_agents(path)) << "the path is closed already";
      if (group_differs) {
        EXPECT_EQ(opens(path, {kProject}), project_could) << std::oct << bits;
      } else {
        EXPECT_EQ(opens(path, {}), others_could) << std::oct << bits;
      }
    }
  }
}

TEST_F(ClosedToAgents, LinksAndMissingPathsStayAsTheyAre) {
  const fs::path file = dir_ / "file", link = dir_ / "link";
  std::ofstream(file) << "truth";
  ::chmod(file.c_str(), 0644);
  fs::create_symlink(file, link);
  EXPECT_FALSE(close_to_agents(link));
  EXPECT_FALSE(close_to_agents(dir_ / "nothing"));
  EXPECT_EQ(mode_of(file), 0644u);
  EXPECT_EQ(close_to_agents(file), ::geteuid() == 0) << "agents have users of their own only if root starts them";
}

}  // namespace
}  // namespace skein
