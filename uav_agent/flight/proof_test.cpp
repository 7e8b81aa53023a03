#include "uav_agent/flight/proof.hpp"

#include <gtest/gtest.h>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/voxel_mapper.hpp"

namespace skein::agent {
namespace {

TEST(Proof, WhoSaysNothingAsksForAllOfIt) {
  EXPECT_EQ(FreeSpace::Config().rays, Proof().rays(false));
  EXPECT_EQ(VoxelMapper::Config().rays, Proof().rays(false));
}

TEST(Proof, LessIsAskedRungByRungAndNeverLittle) {
  for (const bool roomy : {false, true}) {
    Proof proof;
    for (std::size_t rung = 0; rung < 10; ++rung) {
      EXPECT_EQ(proof.rays(roomy), Proof::rays(rung, roomy));
      EXPECT_LE(Proof::rays(rung + 1, roomy), Proof::rays(rung, roomy));
      EXPECT_GE(Proof::rays(rung, roomy), Proof::rays(rung, false));
      EXPECT_EQ(proof.at_last(), rung >= Proof::kLast);
      proof.ask_less();
    }
    EXPECT_GE(proof.rays(roomy), kProofRays / 2);
    proof.ask_all();
    EXPECT_EQ(proof.rays(roomy), Proof::rays(0, roomy));
  }
}

TEST(Proof, SettlesWhenItsTimeIsOver) {
  Proof proof;
  proof.ask_less(ticks(10.0));
  proof.settle(ticks(9.9));
  EXPECT_EQ(proof.rays(false), Proof::rays(1, false));
  proof.ask_less(ticks(20.0));
  proof.settle(ticks(19.9));
  EXPECT_EQ(proof.rays(false), Proof::rays(2, false));
  proof.settle(ticks(20.0));
  EXPECT_EQ(proof.rays(false), Proof::rays(0, false));
}

}  // namespace
}  // namespace skein::agent
