#include "uav_agent/flight/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random_stream.hpp"

namespace skein::agent {
namespace {

constexpr double kDtS = 0.25;

AgentConfig fleet(std::size_t self, const std::vector<Vector3d>& starts) {
  AgentConfig config;
  config.self = UavIndex(self);
  for (const Vector3d& start : starts) {
    FleetMember member;
    member.p_WB_start = start;
    config.fleet.push_back(member);
  }
  return config;
}

Peers one_peer(const AgentConfig& config, UavIndex uav, const Vector3d& p, const Vector3d& v) {
  Peers peers(config);
  peers.update(0, {{.node = node_of_uav(uav), .p_W = p, .v_W = v}});
  return peers;
}

std::vector<Vector3d> eastwards(double speed) {
  return positions_ahead({0.0, 0.0, 10.0}, {{{50.0, 0.0, 10.0}, speed}}, kDtS, 13);
}

TEST(Separation, PositionsAheadKeepTheSpeedOfEachLegAndStopAtTheEnd) {
  const auto ahead = positions_ahead({0, 0, 0}, {{{2, 0, 0}, 4.0}, {{2, 1, 0}, 1.0}}, 0.25, 9);
  ASSERT_EQ(ahead.size(), 9U);
  EXPECT_NEAR((ahead[1] - Vector3d(1, 0, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((ahead[3] - Vector3d(2, 0.25, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((ahead[8] - Vector3d(2, 1, 0)).norm(), 0.0, 1e-9);
}

TEST(Separation, TheLowerNumberHasTheRightOfWay) {
  const std::vector<Vector3d> starts = {{0, 0, 0}, {20, 0, 0}};
  const Vector3d p(12.0, -12.0, 10.0), v(0.0, 4.0, 0.0);  // crosses at the same time
  const AgentConfig low = fleet(0, starts), high = fleet(1, starts);
  EXPECT_EQ(Separation({}, low).judge(0, eastwards(4.0), kDtS, one_peer(low, UavIndex{1}, p, v)), Traffic::wait)
      << "so tight that even the right of way does not help";
  const Vector3d passes_by(12.0, -7.5, 10.0);
  EXPECT_EQ(Separation({}, low).judge(0, eastwards(4.0), kDtS, one_peer(low, UavIndex{1}, passes_by, v)),
            Traffic::clear);
  EXPECT_EQ(Separation({}, high).judge(0, eastwards(4.0), kDtS, one_peer(high, UavIndex{0}, passes_by, v)),
            Traffic::wait);
}

TEST(Separation, GoesAroundWhoeverStandsInTheWayForAWhile) {
  const AgentConfig config = fleet(0, {{0, 0, 0}, {20, 0, 0}});
  const Peers peers = one_peer(config, UavIndex{1}, {8.0, 0.5, 10.0}, Vector3d::Zero());
  Separation separation({}, config);
  EXPECT_EQ(separation.judge(0, eastwards(4.0), kDtS, peers), Traffic::wait);
  Tick tick = 0;
  Traffic last = Traffic::wait;
  while (tick < ticks(5.0) && last == Traffic::wait) last = separation.judge(tick += 20, eastwards(4.0), kDtS, peers);
  EXPECT_EQ(last, Traffic::go_around);
  EXPECT_EQ(separation.keep_out(0, {0.0, 0.0, 10.0}, peers).size(), 1U);
  EXPECT_TRUE(separation.keep_out(0, {90.0, 0.0, 10.0}, peers).empty()) << "far away";
}

TEST(Separation, MovingApartIsNeverAConflict) {
  const AgentConfig config = fleet(1, {{0, 0, 0}, {20, 0, 0}});
  const Peers peers = one_peer(config, UavIndex{0}, {-1.5, 0.0, 10.0}, Vector3d::Zero());
  EXPECT_EQ(Separation({}, config).judge(0, eastwards(2.0), kDtS, peers), Traffic::clear);
}

/// What the rules say of one peer: in the same plane, both straight on at their speeds, or the peer brakes at 3 m/s^2.
bool conflicts(const Separation::Config& config, const AgentConfig& agent, double speed, const Vector3d& p,
               const Vector3d& v) {
  const double wide = 2.0 * 0.63 + config.margin_m, tight = 2.0 * 0.63 + config.tight_m;
  const double limit = v.norm() < 0.3 || agent.self > 0 ? wide : tight;
  const double now = (p - Vector3d(0.0, 0.0, 10.0)).norm();
  for (int i = 1; i <= static_cast<int>(config.horizon_s / kDtS); ++i) {
    const Vector3d own(speed * i * kDtS, 0.0, 10.0);
    const double stop_s = std::min(i * kDtS, v.norm() / 3.0);
    const Vector3d braked = v.norm() > 0.0 ? Vector3d(v * stop_s - 1.5 * stop_s * stop_s * v.normalized()) : v;
    const double on = (own - p - i * kDtS * v).norm(), braking = (own - p - braked).norm();
    if (on < limit && on < now - 0.05) return true;
    if (braking < tight && braking < now - 0.05) return true;
  }
  return false;
}

TEST(Separation, AConflictIsWhoComesNearWithinTheHorizonAndNobodyElse) {
  const std::vector<Vector3d> starts = {{0, 0, 0}, {20, 0, 0}};
  int clear = 0, waits = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    RandomStream random(i, "traffic", 0);
    const std::size_t self = i % 2;
    const Separation::Config config{.horizon_s = random.uniform() < 0.5 ? 3.0 : 1.5};
    const AgentConfig agent = fleet(self, starts);
    const double speed = random.uniform(0.5, 4.0);
    const Vector3d p(random.uniform(-6.0, 12.0), random.uniform(-8.0, 8.0), 10.0);
    Vector3d v(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0), 0.0);
    if (i % 3 == 0) v = {speed, random.uniform(-0.2, 0.2), 0.0};  // alongside
    if (i % 7 == 0) v.setZero();
    const bool expected = conflicts(config, agent, speed, p, v);
    const Traffic judged =
        Separation(config, agent).judge(0, eastwards(speed), kDtS, one_peer(agent, UavIndex(1 - self), p, v));
    ASSERT_EQ(judged, expected ? Traffic::wait : Traffic::clear) << "case " << i;
    ++(expected ? waits : clear);
  }
  EXPECT_GT(std::min(clear, waits), 200) << "both must have been drawn often";
}

TEST(Separation, NobodyRunsIntoWhoFliesAheadAndStops) {
  constexpr double kExchangeS = 0.05, kBrakesMps2 = 2.5, kReactsS = 0.4;
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream random(i, "behind", 0);
    const AgentConfig agent = fleet(i % 2, {{0, 0, 0}, {20, 0, 0}});
    Separation separation({}, agent);
    const double contact = 2.0 * agent.me().body_radius_m;
    double leader = random.uniform(contact + 1.6, 8.0), leads_mps = random.uniform(2.0, 4.0);
    double own = 0.0, own_mps = random.uniform(2.0, 4.0), waits_since = -1.0;
    const double brakes_at = random.uniform(0.0, 3.0);
    for (double t = 0.0; t < 10.0; t += kExchangeS) {
      const auto ahead = positions_ahead({own, 0.0, 10.0}, {{{90.0, 0.0, 10.0}, own_mps}}, kDtS, 13);
      const Peers peers = one_peer(agent, UavIndex(1 - i % 2), {leader, 0.0, 10.0}, {leads_mps, 0.0, 0.0});
      if (waits_since < 0.0 && separation.judge(ticks(t), ahead, kDtS, peers) != Traffic::clear) waits_since = t;
      if (t > brakes_at) leads_mps = std::max(0.0, leads_mps - 4.0 * kExchangeS);
      if (waits_since >= 0.0 && t > waits_since + kReactsS) own_mps = std::max(0.0, own_mps - kBrakesMps2 * kExchangeS);
      leader += leads_mps * kExchangeS;
      own += own_mps * kExchangeS;
      ASSERT_GT(leader - own, contact) << "case " << i << " at " << t;
    }
  }
}

TEST(Separation, WhoStandsInACrowdMayLeaveItButNotPressOn) {
  const AgentConfig config = fleet(0, {{0, 0, 0}, {20, 0, 0}});
  const Separation::Config limits;
  const double wanted = 2.0 * config.me().body_radius_m + limits.margin_m;
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream random(i, "crowd", 0);
    const Vector3d here(0.0, 0.0, 10.0);
    const Vector3d p = here + Vector3d(random.uniform(0.9, 9.0), random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    const auto spheres =
        Separation(limits, config).keep_out(0, here, one_peer(config, UavIndex{1}, p, Vector3d::Zero()));
    ASSERT_EQ(spheres.size(), 1U);
    const double distance = (p - here).norm();
    EXPECT_LT(spheres[0].radius_m, distance) << "it could go nowhere from where it is";
    EXPECT_GE(spheres[0].radius_m, std::min(wanted, distance - 0.1)) << "case " << i;
  }
}

TEST(Separation, WhoHasWaitedForSomebodyWhoStandsGetsPastWithLessRoomForAWhile) {
  const AgentConfig config = fleet(0, {{0, 0, 0}, {20, 0, 0}});
  const double contact = 2.0 * config.me().body_radius_m;
  const Separation::Config limits;
  const auto beside = [&](double gap) { return Vector3d(6.0, contact + gap, 10.0); };
  const auto beside_m = [&](double gap) { return one_peer(config, UavIndex{1}, beside(gap), Vector3d::Zero()); };
  Separation separation(limits, config);
  const double gap = 0.5 * (limits.margin_m + limits.tight_m);
  Tick tick = 0;
  while (separation.judge(tick, eastwards(4.0), kDtS, beside_m(gap)) == Traffic::wait && tick < ticks(20.0)) tick += 20;
  ASSERT_LT(tick, ticks(20.0)) << "it does not wait for ever";
  EXPECT_EQ(separation.judge(tick + 20, eastwards(4.0), kDtS, beside_m(gap)), Traffic::clear);
  EXPECT_LT(separation.keep_out(tick + 20, {0.0, 0.0, 10.0}, beside_m(gap))[0].radius_m, contact + gap);
  EXPECT_EQ(separation.judge(tick + 40, eastwards(4.0), kDtS, beside_m(limits.tight_m - 0.2)), Traffic::wait);
  EXPECT_EQ(separation.judge(tick + 60, eastwards(4.0), kDtS, beside_m(20.0)), Traffic::clear);
  EXPECT_EQ(separation.judge(tick + ticks(60.0), eastwards(4.0), kDtS, beside_m(gap)), Traffic::wait) << "as before";
}

TEST(Separation, WhoWentOutOfSightIsReckonedWithForAWhile) {
  const AgentConfig config = fleet(0, {{0, 0, 0}, {20, 0, 0}});
  const Vector3d here(0.0, 0.0, 10.0);
  for (std::uint64_t i = 0; i < 100; ++i) {
    RandomStream random(i, "hidden", 0);
    const bool stood = i % 2 == 0;
    const double near = stood ? 4.0 : 9.0;
    const Vector3d p(random.uniform(near, near + 3.0), random.uniform(-1.0, 1.0), 10.0);
    const Vector3d v = stood ? Vector3d::Zero() : Vector3d(random.uniform(-3.0, -1.0), 0.0, 0.0);
    Peers peers = one_peer(config, UavIndex{1}, p, v);
    peers.update(20, {});
    const double hidden_s = random.uniform(0.0, stood ? 19.0 : 1.5);
    const Vector3d there = p + hidden_s * v;
    const auto spheres = Separation({}, config).keep_out(ticks(hidden_s), here, peers);
    ASSERT_EQ(spheres.size(), 1U) << "case " << i;
    EXPECT_LT((spheres[0].p_W - there).norm(), 0.02) << "case " << i;
    EXPECT_EQ(Separation({}, config).judge(ticks(hidden_s), eastwards(4.0), kDtS, peers), Traffic::wait)
        << "case " << i;
    const Tick later = ticks(stood ? 21.0 : 2.5);
    EXPECT_EQ(Separation({}, config).judge(later, eastwards(4.0), kDtS, peers), Traffic::clear) << "case " << i;
    EXPECT_TRUE(Separation({}, config).keep_out(later, here, peers).empty()) << "case " << i;
  }
}

TEST(Separation, WhoWasNeverSeenIsNobody) {
  const AgentConfig config = fleet(0, {{0, 0, 0}, {6, 0, 10}});
  EXPECT_EQ(Separation({}, config).judge(0, eastwards(4.0), kDtS, Peers(config)), Traffic::clear);
}

/// How long a conflict that lasts is waited for [s].
double patience_s(Separation& separation, const Peers& peers, Tick& tick) {
  const Tick begin = tick;
  while (separation.judge(tick, eastwards(4.0), kDtS, peers) == Traffic::wait) tick += 20;
  return seconds(tick - begin);
}

TEST(Separation, PatienceGrowsWithRankIsThreefoldForWhoMovesAndBeginsAnewAfterAClearMoment) {
  const std::vector<Vector3d> starts = {{0, 0, 0}, {20, 0, 0}, {40, 0, 0}};
  for (std::size_t self = 0; self < 3; ++self) {
    const AgentConfig config = fleet(self, starts);
    const std::size_t other = self == 0 ? 1 : 0;
    const Peers stands = one_peer(config, UavIndex(other), {6.0, 0.5, 10.0}, Vector3d::Zero());
    const Peers moves = one_peer(config, UavIndex(other), {11.0, 0.0, 10.0}, {-4.0, 0.0, 0.0});
    const double patience = 1.5 + 0.5 * static_cast<double>(self);
    Tick tick = 0;
    Separation separation({}, config);
    EXPECT_NEAR(patience_s(separation, stands, tick), patience, 0.051) << self;
    tick += 20;
    EXPECT_NEAR(patience_s(separation, stands, tick), patience, 0.101) << self << ": going around takes its time, too";
    EXPECT_NEAR(patience_s(separation, moves, tick), 3.0 * patience, 0.101) << self;

    Separation interrupted({}, config);
    EXPECT_EQ(interrupted.judge(0, eastwards(4.0), kDtS, stands), Traffic::wait);
    EXPECT_EQ(interrupted.judge(ticks(1.0), eastwards(4.0), kDtS, Peers(config)), Traffic::clear);
    EXPECT_EQ(interrupted.judge(ticks(9.0), eastwards(4.0), kDtS, stands), Traffic::wait) << self;
  }
}

TEST(Separation, NeighboursLiftOffOneAfterTheOther) {
  const AgentConfig config = fleet(1, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Separation separation({}, config);
  EXPECT_EQ(separation.lifts_off_after(0, Peers(config)), 0U) << "number 0 still stands there";
  EXPECT_EQ(separation.lifts_off_after(400, one_peer(config, UavIndex{0}, {0, 0, 2.0}, {0, 0, 2.0})), 0U);
  EXPECT_FALSE(separation.lifts_off_after(800, one_peer(config, UavIndex{0}, {0, 0, 3.5}, {0, 0, 2.0})));
  const AgentConfig far = fleet(1, {{0, 0, 0}, {30, 0, 0}});
  EXPECT_FALSE(Separation({}, far).lifts_off_after(0, Peers(far)));
  Separation patient({}, config);
  EXPECT_EQ(patient.lifts_off_after(0, Peers(config)), 0U);
  EXPECT_FALSE(patient.lifts_off_after(ticks(6.0), Peers(config))) << "number 0 seems to be broken";
}

TEST(Separation, EachOneBeforeIsWaitedForAndNobodyElse) {
  const std::vector<Vector3d> starts = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {30, 0, 0}, {1, 1, 0}};
  const std::vector<double> patience_s = {0.0, 4.0, 8.0, 0.0, 12.0};  // four seconds for each nearer, lower number
  for (std::size_t self = 0; self < starts.size(); ++self) {
    const AgentConfig config = fleet(self, starts);
    Separation separation({}, config);
    Tick tick = 100;
    while (separation.lifts_off_after(tick, Peers(config))) tick += 20;
    EXPECT_NEAR(seconds(tick - 100), patience_s[self], 0.051) << self;
  }
}

}  // namespace
}  // namespace skein::agent
