#include "uav_agent/flight/proof.hpp"

#include <gtest/gtest.h>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/voxel_mapper.hpp"

namespace skein::agent {
namespace {

FreeSpace::Config asked(const Proof& proof, bool roomy) {
  FreeSpace::Config config{.blind_height_m = 10.0, .rays = Proof::rays(roomy)};
  proof.lessen(config);
  return config;
}

TEST(Proof, WhoSaysNothingAsksForAllOfIt) {
  EXPECT_EQ(FreeSpace::Config().rays, Proof::rays(false));
  EXPECT_EQ(VoxelMapper::Config().rays, Proof::rays(false));
  for (const bool roomy : {false, true}) EXPECT_EQ(asked(Proof(), roomy).rays, Proof::rays(roomy));
}

TEST(Proof, LessIsAskedRungByRungAndNeverLittle) {
  for (const bool roomy : {false, true}) {
    Proof proof;
    for (std::size_t rung = 0; rung < 10; ++rung) {
      const FreeSpace::Config now = asked(proof, roomy);
      EXPECT_GE(now.rays, asked(proof, false).rays);
      EXPECT_EQ(now.blind_height_m, rung < Proof::kLast ? 10.0 : 0.0);
      proof.ask_less();
      EXPECT_LE(asked(proof, roomy).rays, now.rays);
    }
    EXPECT_GE(asked(proof, roomy).rays, Proof::rays(roomy) / 4);
    proof.ask_all();
    EXPECT_EQ(asked(proof, roomy).rays, Proof::rays(roomy));
  }
}

TEST(Proof, SettlesWhenItsTimeIsOver) {
  const auto rays = [](const Proof& proof) { return asked(proof, false).rays; };
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
