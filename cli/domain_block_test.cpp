#include "cli/domain_block.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/preflight.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

TEST(DomainBlock, TheFirstFreeBlockIsTaken) {
  const ScratchDir locks;
  const DomainBlock a(std::nullopt, 7, locks.path()), b(std::nullopt, 3, locks.path());
  EXPECT_EQ(a.base(), 1) << "0 is ROS 2's default domain";
  EXPECT_EQ(a.last(), 7);
  EXPECT_EQ(b.base(), 8);
  EXPECT_EQ(b.last(), 10);
}

TEST(DomainBlock, ABlockIsFreeAgainAfterItsEnd) {
  const ScratchDir locks;
  { const DomainBlock a(10, 5, locks.path()); }
  EXPECT_EQ(DomainBlock(10, 5, locks.path()).base(), 10);
}

TEST(DomainBlock, AnyOverlapIsRefused) {
  const ScratchDir locks;
  const DomainBlock a(10, 5, locks.path());
  for (int base = 6; base <= 14; ++base) EXPECT_THROW(DomainBlock(base, 5, locks.path()), InputError) << base;
  EXPECT_EQ(DomainBlock(5, 5, locks.path()).base(), 5);
  EXPECT_EQ(DomainBlock(15, 5, locks.path()).base(), 15);
  EXPECT_EQ(DomainBlock(std::nullopt, 10, locks.path()).base(), 15) << "1..9 are too few";
}

TEST(DomainBlock, TheRangeIsChecked) {
  const ScratchDir locks;
  EXPECT_THROW(DomainBlock(-1, 5, locks.path()), InputError);
  try {
    const DomainBlock world_in_the_default_domain(0, 5, locks.path());
    FAIL() << "domain 0 is every ROS 2 node's";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("must be within 1..196")) << "says what would be right";
    EXPECT_THAT(error.what(), testing::HasSubstr("ROS 2")) << "and why";
  }
  EXPECT_THROW(DomainBlock(kLastDomain - 3, 5, locks.path()), InputError);
  EXPECT_EQ(DomainBlock(kLastDomain - 4, 5, locks.path()).last(), kLastDomain);
  EXPECT_THROW(DomainBlock(std::nullopt, kLastDomain + 1, locks.path()), InputError);
}

TEST(DomainBlock, AFullHostIsRefused) {
  const ScratchDir locks;
  const DomainBlock all(std::nullopt, kLastDomain, locks.path());
  EXPECT_THROW(DomainBlock(std::nullopt, 1, locks.path()), InputError);
}

}  // namespace
}  // namespace skein::cli
