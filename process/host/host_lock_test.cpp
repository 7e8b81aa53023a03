#include "process/host/host_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

namespace skein {
namespace {

/// A name that no other test uses, and that differs if this test runs twice at once.
std::string own_name() { return "skein-host-lock-test-" + std::to_string(::getpid()); }

TEST(HostLock, OnlyOneHolderTakesALockAtATime) {
  auto first = HostLock::try_take(own_name());
  ASSERT_TRUE(first);
  EXPECT_FALSE(HostLock::try_take(own_name()));
  EXPECT_TRUE(HostLock::try_take(own_name() + "-other"));
  const HostLock moved = std::move(*first);
  first.reset();
  EXPECT_FALSE(HostLock::try_take(own_name()));
}

TEST(HostLock, ALockIsFreeOnceItsHolderHasGone) {
  { const auto lock = HostLock::try_take(own_name()); }
  EXPECT_TRUE(HostLock::try_take(own_name()));
}

TEST(HostLock, TheHolderIsKnown) {
  EXPECT_FALSE(HostLock::holder(own_name()));
  const auto lock = HostLock::try_take(own_name());
  EXPECT_EQ(HostLock::holder(own_name()), ::getpid());
}

// Each call of holder() takes a place in a queue of at most SOMAXCONN places.
TEST(HostLock, TheHolderIsKnownAgainOnceItHasForgottenItsVisitors) {
  const auto lock = HostLock::try_take(own_name());
  for (int round = 0; round < 3; ++round) {
    for (int call = 0; call < 2000; ++call) ASSERT_EQ(HostLock::holder(own_name()), ::getpid()) << call;
    lock->forget_visitors();
  }
}

TEST(HostLock, TheLockOfAKilledHolderIsFree) {
  const std::string name = own_name();
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t holder = ::fork();
  if (holder == 0) {
    const auto lock = HostLock::try_take(name);
    [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
    ::pause();
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_EQ(HostLock::holder(name), holder);
  EXPECT_FALSE(HostLock::try_take(name));
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_TRUE(HostLock::try_take(name));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(HostLock, ANameThatIsTooLongIsAnError) { EXPECT_THROW(HostLock::try_take(std::string(200, 'x')), std::exception); }

}  // namespace
}  // namespace skein
