#include "uav_agent/maps/free_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr float kPerM2 = 4.0F;  ///< of one beam: a window of a quarter of a square metre

Vector3d drawn_line(RandomStream& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

int nearest_axis(const Vector3d& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return axis;
}

TEST(UnseenMembers, TablesAreAboveTheIntegralsAndNearToThem) {
  for (double k = 0.0; k < 300.0; k = k * 1.13 + 0.07) {
    double g = 0.0, d = 0.0;
    constexpr int kParts = 200'000;
    for (int part = 0; part < kParts; ++part) {
      const double x = (part + 0.5) / kParts, sine = std::sin(0.5 * std::numbers::pi * x);
      g += 0.5 * std::numbers::pi * std::exp(-k * sine) * sine / kParts;
      d += std::exp(-k * (1.0 - x * x)) / kParts;
    }
    EXPECT_GE(unseen_along_one_direction(k), g * (1.0 - 1e-6)) << k;
    EXPECT_LE(unseen_along_one_direction(k), 1.01 * g) << k;
    EXPECT_GE(unseen_about_an_axis(k), d * (1.0 - 1e-6)) << k;
    EXPECT_LE(unseen_about_an_axis(k), 1.01 * d) << k;
  }
}

/// Beams come from one place, from two, from along a line, or from all sides. Of members with drawn directions, the
/// share that stays unseen by the header's formula is never above the bound.
TEST(UnseenMembers, TheBoundHoldsWhereverBeamsComeFrom) {
  const FreeCriterion criterion;
  for (std::uint64_t world = 0; world < 60; ++world) {
    RandomStream random(world, "unseen", 0);
    const std::vector<Vector3d> places = {drawn_line(random), drawn_line(random), drawn_line(random)};
    const int beams = static_cast<int>(random.uniform(5.0, 120.0));
    BeamEvidence evidence;
    std::vector<std::pair<Vector3d, double>> all;  // direction, density
    for (int beam = 0; beam < beams; ++beam) {
      const double part = random.uniform();
      const std::vector<Vector3d> kinds = {places[0], part < 0.5 ? places[0] : places[1],
                                           (places[0] + 4.0 * part * places[1]).normalized(), drawn_line(random)};
      const Vector3d direction = kinds[world % 4];
      const int axis = nearest_axis(direction);
      evidence.add(BeamEvidence((part < 0.3 ? -direction : direction).cast<float>(), axis, kPerM2));
      all.emplace_back(direction, kPerM2 / std::abs(direction[axis]));
    }
    ASSERT_EQ(evidence.per_m2(), beams * kPerM2);
    double unseen = 0.0, unseen2 = 0.0;
    constexpr int kMembers = 4000;
    for (int member = 0; member < kMembers; ++member) {
      const Vector3d u = drawn_line(random);
      double met = 0.0;
      for (const auto& [direction, density] : all) met += density * direction.cross(u).norm();
      const double p = std::exp(-met * criterion.member_width_m * criterion.member_in_halo_m);
      unseen += p / kMembers;
      unseen2 += p * p / kMembers;
    }
    const double error = std::sqrt(unseen2 / kMembers);
    EXPECT_GE(evidence.unseen_probability(criterion), 0.97 * unseen - 4.0 * error) << world;
  }
}

TEST(UnseenMembers, FewerBeamsProveIfTheyComeFromAllSides) {
  const auto beams_needed = [](bool all_sides) {
    RandomStream random(1, "needed", 0);
    BeamEvidence evidence;
    const FreeCriterion criterion;
    while (evidence.unseen_probability(criterion) > criterion.unseen_p) {
      const Vector3d direction = all_sides ? drawn_line(random) : Vector3d::UnitX();
      evidence.add(BeamEvidence(direction.cast<float>(), nearest_axis(direction), kPerM2));
    }
    return evidence.per_m2();
  };
  EXPECT_NEAR(beams_needed(false), 375, 8);
  EXPECT_LT(beams_needed(true), 160);  // oblique beams count for more
}

/// Beams whose return is lost with probability q count as 1 - q times as many beams.
TEST(UnseenMembers, LostReturnsCountAsFewerBeams) {
  for (const double q : {0.3, 0.5, 0.75}) {
    FreeCriterion losing;
    losing.no_return_p = q;
    RandomStream random(4, "lost", 0);
    BeamEvidence all, part;
    for (int beam = 0; beam < 160; ++beam) {  // every third along x, the others from all sides
      const Vector3d direction = beam % 3 == 0 ? Vector3d::UnitX() : drawn_line(random);
      const int axis = nearest_axis(direction);
      all.add(BeamEvidence(direction.cast<float>(), axis, kPerM2));
      part.add(BeamEvidence(direction.cast<float>(), axis, static_cast<float>(1.0 - q) * kPerM2));
      const double expected = part.unseen_probability(FreeCriterion());
      ASSERT_NEAR(all.unseen_probability(losing), expected, 0.05 * expected + 1e-9) << beam << " of " << q;
    }
    BeamEvidence along_one_line;
    while (along_one_line.unseen_probability(losing) > losing.unseen_p && !along_one_line.full()) {
      along_one_line.add(BeamEvidence(Eigen::Vector3f::UnitX(), 0, kPerM2));
    }
    EXPECT_NEAR(along_one_line.per_m2(), std::min<double>(375.0 / (1.0 - q), BeamEvidence::kMostPerM2), 16.0) << q;
  }
}

/// Each sighting of a member may be lost, independently of the others. The share of unseen members is below the bound.
TEST(UnseenMembers, TheBoundHoldsIfSightingsAreLost) {
  FreeCriterion criterion;
  criterion.no_return_p = 0.3;
  RandomStream random(6, "lost", 0);
  BeamEvidence evidence;
  for (int beam = 0; beam < 40; ++beam) evidence.add(BeamEvidence(Eigen::Vector3f::UnitX(), 0, kPerM2));
  const double k = 40 * kPerM2 * criterion.member_width_m * criterion.member_in_halo_m;
  constexpr int kMembers = 200'000, kParts = 400;  // places where a beam may meet the member, few of which do
  int unseen = 0;
  for (int member = 0; member < kMembers; ++member) {
    const double met_p = k * Vector3d::UnitX().cross(drawn_line(random)).norm() / kParts;
    bool seen = false;
    for (int part = 0; part < kParts && !seen; ++part) {
      seen = random.uniform() < met_p && random.uniform() >= criterion.no_return_p;
    }
    unseen += !seen;
  }
  const double share = static_cast<double>(unseen) / kMembers, error = std::sqrt(share / kMembers);
  EXPECT_GE(evidence.unseen_probability(criterion), share - 6.0 * error);
  EXPECT_LT(evidence.unseen_probability(FreeCriterion()), share - 6.0 * error)
      << "the bound for no lost returns would not hold";
}

TEST(UnseenMembers, EvidenceDoesNotOverflowWithManyBeams) {
  const FreeCriterion criterion{.member_width_m = 0.005, .member_in_halo_m = 1.0, .unseen_p = 1e-3};  // a thin wire
  RandomStream random(2, "many", 0);
  BeamEvidence evidence;
  double before = 1.0 + 1e-9;
  for (int beam = 0; beam < 2000; ++beam) {
    const Vector3d direction = drawn_line(random);
    evidence.add(BeamEvidence(direction.cast<float>(), nearest_axis(direction), kPerM2));
    const double now = evidence.unseen_probability(criterion);
    ASSERT_GT(now, 0.0) << beam;
    ASSERT_LE(now, before + 0.01) << beam;
    before = now;
  }
  EXPECT_EQ(evidence.per_m2(), BeamEvidence::kMostPerM2);
  EXPECT_TRUE(evidence.full());
}

TEST(BeamEvidence, IsDueOnceItsBeamsReachTheReminder) {
  BeamEvidence evidence;
  EXPECT_TRUE(evidence.due());
  evidence.remind_at(10.0);
  for (const bool due : {false, false, true}) {
    evidence.add(BeamEvidence(Eigen::Vector3f::UnitX(), 0, kPerM2));
    EXPECT_EQ(evidence.due(), due) << evidence.per_m2();
  }
  evidence.never_remind();
  for (int i = 0; i < 1000; ++i) evidence.add(BeamEvidence(Eigen::Vector3f::UnitX(), 0, kPerM2));
  EXPECT_FALSE(evidence.due());
}

/// Beams come from one direction, from a cone around it, or from all sides. The test compares the two after each beam,
/// until well after the number at which the judgement changes.
TEST(FreeJudge, AgreesWithTheUnseenProbability) {
  std::size_t asked = 0, proved = 0;
  for (const auto& [unseen_p, no_return_p] : {std::pair{1e-2, 0.0}, {1e-3, 0.0}, {1e-3, 0.3}, {1e-4, 0.0}}) {
    const FreeCriterion criterion{.unseen_p = unseen_p, .no_return_p = no_return_p};
    const FreeJudge judge(criterion);
    for (std::uint64_t world = 0; world < 300; ++world) {
      RandomStream random(world, "judge", 0);
      const Vector3d about = drawn_line(random);
      const double spread = random.uniform() < 0.2 ? 0.0 : random.uniform(0.0, 3.0);
      BeamEvidence evidence;
      for (int more = 0; evidence.unseen_probability(criterion) > 0.3 * unseen_p && !evidence.full(); ++more) {
        const Eigen::Vector3f direction = (about + spread * drawn_line(random)).normalized().cast<float>();
        evidence.add(BeamEvidence(direction, nearest_axis(direction.cast<double>()), kPerM2));
        const bool is_proved = evidence.unseen_probability(criterion) <= criterion.unseen_p;
        ASSERT_EQ(judge.proved(evidence), is_proved) << unseen_p << ", world " << world << ", " << more;
        ASSERT_TRUE(!is_proved || evidence.per_m2() >= judge.fewest_per_m2());
        ++asked;
        proved += is_proved;
      }
    }
  }
  EXPECT_GT(proved, 1000U);
  EXPECT_GT(asked, 2 * proved);
}

TEST(UnseenMembers, WithoutBeamsEveryMemberIsUnseen) {
  EXPECT_NEAR(BeamEvidence().unseen_probability(FreeCriterion()), 1.0, 1e-9);
}

}  // namespace
}  // namespace skein::agent
