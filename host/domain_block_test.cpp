#include "host/domain_block.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "core/types.hpp"

namespace skein::cli {
namespace {

/// A name for locks that no fleet and no other test uses.
std::string own_realm() { return "test-" + std::to_string(::getpid()) + "-"; }

TEST(DomainBlock, TheFirstFreeBlockIsTaken) {
  const DomainBlock a(std::nullopt, 7, own_realm()), b(std::nullopt, 3, own_realm());
  EXPECT_EQ(a.base(), 1) << "0 is ROS 2's default domain";
  EXPECT_EQ(a.last(), 7);
  EXPECT_EQ(b.base(), 8);
  EXPECT_EQ(b.last(), 10);
}

TEST(DomainBlock, ABlockIsFreeAgainAfterItsEnd) {
  { const DomainBlock a(10, 5, own_realm()); }
  EXPECT_EQ(DomainBlock(10, 5, own_realm()).base(), 10);
}

TEST(DomainBlock, AnyOverlapIsRefused) {
  const DomainBlock a(10, 5, own_realm());
  for (int base = 6; base <= 14; ++base) EXPECT_THROW(DomainBlock(base, 5, own_realm()), InputError) << base;
  EXPECT_EQ(DomainBlock(5, 5, own_realm()).base(), 5);
  EXPECT_EQ(DomainBlock(15, 5, own_realm()).base(), 15);
  EXPECT_EQ(DomainBlock(std::nullopt, 10, own_realm()).base(), 15) << "the free domains 1..9 are too few for the block";
}

TEST(DomainBlock, TheTemporaryFolderDoesNotMatter) {
  const char* folder = std::getenv("TMPDIR");
  const std::string before = folder ? folder : "";
  ::setenv("TMPDIR", "/dev/shm", 1);
  const DomainBlock a(10, 5, own_realm());
  ::setenv("TMPDIR", "/", 1);
  EXPECT_THROW(DomainBlock(10, 5, own_realm()), InputError);
  folder ? ::setenv("TMPDIR", before.c_str(), 1) : ::unsetenv("TMPDIR");
}

TEST(DomainBlock, ARefusalNamesTheProcessThatUsesTheDomain) {
  const DomainBlock a(12, 2, own_realm());
  try {
    const DomainBlock b(10, 5, own_realm());
    FAIL() << "two blocks have the same domain";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("uses domain 12 (process " + std::to_string(::getpid()) + ")"),
              std::string::npos)
        << error.what();
  }
}

TEST(DomainBlock, ABlockOutsideTheRangeOfDomainsIsRefused) {
  EXPECT_THROW(DomainBlock(-1, 5, own_realm()), InputError);
  try {
    const DomainBlock world_in_the_default_domain(0, 5, own_realm());
    FAIL() << "domain 0 was accepted, although every ROS 2 node uses it by default";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("must be within 1..196")) << "the message names the correct range";
    EXPECT_THAT(error.what(), testing::HasSubstr("ROS 2")) << "the message gives the reason";
  }
  EXPECT_THROW(DomainBlock(kLastDomain - 3, 5, own_realm()), InputError);
  EXPECT_EQ(DomainBlock(kLastDomain - 4, 5, own_realm()).last(), kLastDomain);
  EXPECT_THROW(DomainBlock(std::nullopt, kLastDomain + 1, own_realm()), InputError);
}

TEST(DomainBlock, ABlockIsRefusedIfNoDomainIsFree) {
  const DomainBlock all(std::nullopt, kLastDomain, own_realm());
  EXPECT_THROW(DomainBlock(std::nullopt, 1, own_realm()), InputError);
}

}  // namespace
}  // namespace skein::cli
