#include "uav_agent/flight/proof.hpp"

#include <gtest/gtest.h>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/voxel_mapper.hpp"

namespace skein::agent {
namespace {

int asked(const Proof& proof, bool roomy, Role role = Role::explorer) { return proof.of(Proof::rays(roomy), role); }

TEST(Proof, WhoSaysNothingAsksForAllOfIt) {
  EXPECT_EQ(FreeSpace::Config().rays, Proof::rays(false));
  EXPECT_EQ(VoxelMapper::Config().rays, Proof::rays(false));
  for (const bool roomy : {false, true}) EXPECT_EQ(asked(Proof(), roomy), Proof::rays(roomy));
}

TEST(Proof, LessIsAskedRungByRungAndNeverLittle) {
  for (const bool roomy : {false, true}) {
    Proof proof;
    for (std::size_t rung = 0; rung < 10; ++rung) {
      const int now = asked(proof, roomy);
      EXPECT_GE(now, asked(proof, false));
      proof.ask_less();
      EXPECT_LE(asked(proof, roomy), now);
    }
    EXPECT_GE(asked(proof, roomy), Proof::rays(roomy) / 4);
    proof.ask_all();
    EXPECT_EQ(asked(proof, roomy), Proof::rays(roomy));
  }
}

TEST(Proof, WhoAlreadyAsksForLittleIsNotTalkedOutOfIt) {
  for (int rays = 1; rays < 20; ++rays) {
    for (std::size_t rung = 0; rung < 6; ++rung) {
      for (const Role role : {Role::explorer, Role::photographer}) {
        EXPECT_LE(Proof::of(rays, rung, role), rays);
        EXPECT_GE(Proof::of(rays, rung, role), std::min(rays, 4));
      }
    }
  }
}

TEST(Proof, WhoSeesNothingAsksForMore) {
  for (const bool roomy : {false, true}) {
    Proof proof;
    for (std::size_t rung = 0; rung < 6; ++rung, proof.ask_less()) {
      EXPECT_GE(asked(proof, roomy, Role::photographer), asked(proof, roomy));
      EXPECT_GE(asked(proof, roomy, Role::photographer), 9);
    }
    EXPECT_GT(asked(proof, roomy, Role::photographer), asked(proof, roomy)) << "in the end";
  }
}

TEST(Proof, SettlesWhenItsTimeIsOver) {
  const auto rays = [](const Proof& proof) { return asked(proof, false); };
  Proof proof;
  proof.ask_less(ticks(10.0));
  proof.settle(ticks(9.9));
  EXPECT_LT(rays(proof), kProofRays);
  const int first = rays(proof);
  proof.ask_less(ticks(20.0));
  proof.settle(ticks(19.9));
  EXPECT_LT(rays(proof), first);
  proof.settle(ticks(20.0));
  EXPECT_EQ(rays(proof), kProofRays);
}

}  // namespace
}  // namespace skein::agent
