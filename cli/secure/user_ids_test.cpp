#include "cli/secure/user_ids.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "core/types.hpp"
#include "host/proc_table.hpp"

namespace skein::cli {
namespace {

class UserIdsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can choose user ids";
  }

  static bool has_processes(uid_t user) {
    const std::vector<pid_t> all = all_processes();
    return std::any_of(all.begin(), all.end(), [&](pid_t pid) { return belongs_to(pid, user); });
  }

  /// Starts a process of that user that leaves another one behind in a session of its own. Returns once that one runs.
  static void leave_behind(uid_t user) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t first = ::fork();
    if (first == 0) {
      if (::setuid(user) != 0) ::_exit(1);
      ::setsid();
      if (::fork() == 0) {
        [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
        for (;;) ::pause();
      }
      ::_exit(0);
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    ::waitpid(first, nullptr, 0);
    ::close(ready[0]);
    ::close(ready[1]);
  }
};

TEST_F(UserIdsTest, AreDifferentAndFree) {
  const UserIds a(8), b(8);
  std::vector<uid_t> all;
  for (std::size_t i = 0; i < 8; ++i) {
    all.push_back(a.at(i).uid);
    all.push_back(b.at(i).uid);
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::unique(all.begin(), all.end()), all.end());
  EXPECT_GE(all.front(), kFirstAgentUser);
  EXPECT_LE(all.back(), kLastAgentUser);
  for (const uid_t user : all) EXPECT_FALSE(has_processes(user)) << user;
}

TEST_F(UserIdsTest, EndAllProcessesOfTheirUsersInTheirDestructor) {
  uid_t user = 0;
  {
    const UserIds ids(1);
    user = ids.at(0).uid;
    leave_behind(user);
    EXPECT_TRUE(has_processes(user));
  }
  EXPECT_FALSE(has_processes(user));
}

TEST_F(UserIdsTest, TheUserIdOfASurvivingProcessIsNotGivenAgain) {
  constexpr std::size_t kAll = kLastAgentUser - kFirstAgentUser + 1;
  leave_behind(kFirstAgentUser);
  EXPECT_THROW(UserIds ids(kAll), InputError);
  EXPECT_TRUE(has_processes(kFirstAgentUser)) << "UserIds must not end a process that was there before";
  EXPECT_TRUE(end_processes_of(kFirstAgentUser));
  EXPECT_FALSE(has_processes(kFirstAgentUser));
}

TEST_F(UserIdsTest, NoOtherUsersProcessesAreEnded) {
  EXPECT_FALSE(end_processes_of(0));
  EXPECT_FALSE(end_processes_of(1000));
}

}  // namespace
}  // namespace skein::cli
