// Properties of every plan with full knowledge: score, paths, times and radio.
#include "sim_server/plan/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/oracle.hpp"
#include "sight/camera.hpp"
#include "sight/ray_shapes.hpp"
#include "sim_server/plan/plan_cache.hpp"
#include "sim_server/plan/schedule.hpp"
#include "sim_server/plan/ways.hpp"
#include "sim_server/sensors/antenna_link.hpp"
#include "sim_server/testing/plan_site.hpp"

namespace skein::sim {
namespace {

constexpr double kSearchNoise = 0.02;  ///< share of the score by which a search may miss a better plan

Plan plan_of(const test::PlanSite& site) { return make_plan(site.scenario, site.scene, site.config); }

const test::PlanSite& common_site() {
  static const test::PlanSite site(3, 60.0);
  return site;
}
const Plan& common_plan() {
  static const Plan plan = plan_of(common_site());
  return plan;
}

/// For each point, the best quality that the production camera gives it in the plan's pictures.
std::vector<float> pictures_of(const test::PlanSite& site, const Plan& plan) {
  std::vector<float> best(site.scene.points.size(), 0.0F);
  for (std::size_t i = 0; i < plan.uavs.size(); ++i) {
    const VehicleConfig& vehicle = site.scenario.fleet[i].vehicle;
    RayScene world(site.scene.mesh, {body_shape(vehicle)});
    for (const PlanMove& move : plan.uavs[i].moves) {
      if (!move.picture) continue;
      RigidBodyState body;
      body.p_WB = move.to_W;
      body.q_WB = Eigen::AngleAxisd(move.yaw, Vector3d::UnitZ());
      world.set_pose(UavIndex{0}, body.X_WB());
      Camera camera(vehicle.camera, site.scenario.desired_mm_per_pixel, site.scenario.rules, site.scene.points,
                    UavIndex{0});
      for (const Detection& seen : camera.capture(0, body, {move.pitch, 0.0, 0.0, 0.0}, world).detections) {
        best[seen.point] = std::max(best[seen.point], static_cast<float>(seen.q));
      }
    }
  }
  return best;
}

TEST(Plan, ThePlansScoreIsThatOfTheProductionCameraAtItsPictures) {
  double sum = 0.0;
  for (const float q : pictures_of(common_site(), common_plan())) sum += q;
  EXPECT_NEAR(common_plan().score, sum, 1e-3);
  EXPECT_GT(common_plan().score, 0.5 * static_cast<double>(common_site().scene.points.size()));
}

TEST(Plan, ThePlansScoreIsNeverAboveTheEstimate) {
  const test::PlanSite& site = common_site();
  const OracleReport report = consult_oracle(site.scenario, site.scene, {0.5, 2.5, 64, 1});
  EXPECT_LE(common_plan().score, report.reachable.attainable.score);
  EXPECT_LE(common_plan().points, report.reachable.attainable.points);
}

TEST(Plan, MoreTimeGivesNoWorsePlan) {
  double before = 0.0;
  for (const double duration_s : {15.0, 30.0, 60.0, 120.0}) {
    const double score = plan_of(test::PlanSite(2, duration_s)).score;
    EXPECT_GE(score, (1.0 - kSearchNoise) * before) << duration_s;
    before = score;
  }
}

TEST(Plan, MoreUavsGiveNoWorsePlan) {
  double before = 0.0;
  for (const std::size_t uavs : {1u, 2u, 3u, 4u}) {
    const double score = plan_of(test::PlanSite(uavs, 45.0)).score;
    EXPECT_GE(score, (1.0 - kSearchNoise) * before) << uavs;
    before = score;
  }
}

TEST(Plan, EveryLegIsClearOfTheStructure) {
  const test::PlanSite& site = common_site();
  const RayScene world(site.scene.mesh);
  for (std::size_t i = 0; i < common_plan().uavs.size(); ++i) {
    const double needed = Body(body_shape(site.scenario.fleet[i].vehicle)).radius + site.config.margin_m;
    for (const PlanMove& move : common_plan().uavs[i].moves) {
      const Vector3d way = move.to_W - move.from_W;
      for (double part = 0.0; part <= 1.0; part += 0.05 / std::max(0.05, way.norm())) {
        ASSERT_GE(world.clearance(move.from_W + part * way), needed - Ways::kSlack - 1e-9) << i << ' ' << move.from_s;
      }
    }
  }
}

TEST(Plan, MovesFollowEachOtherWithinTheVehiclesLimits) {
  const test::PlanSite& site = common_site();
  const Team team(site.scenario, site.config);
  for (std::size_t i = 0; i < common_plan().uavs.size(); ++i) {
    const std::vector<PlanMove>& moves = common_plan().uavs[i].moves;
    const TeamKind& kind = team.kinds[team.kind_of[i]];
    ASSERT_FALSE(moves.empty());
    EXPECT_EQ(moves.front().from_W.head<2>(), site.scenario.fleet[i].start);
    for (std::size_t k = 0; k < moves.size(); ++k) {
      EXPECT_NEAR(moves[k].until_s - moves[k].from_s, kind.travel_s(moves[k].to_W - moves[k].from_W), 1e-9);
      if (k + 1 == moves.size()) continue;
      EXPECT_EQ(moves[k].to_W, moves[k + 1].from_W);
      EXPECT_GE(moves[k + 1].from_s, moves[k].until_s + (moves[k].picture ? kPictureS : 0.0) - 1e-9);
    }
    for (double t = 0.0; t < site.scenario.duration_s; t += 0.05) {
      const PlanState state = plan_state(kind, moves, t);
      ASSERT_LE(state.v_WB.norm(), kind.speed + 1e-9);
      ASSERT_LE(state.a_WB.norm(), kind.acceleration + 1e-9);
      const PlanState next = plan_state(kind, moves, t + 0.001);
      ASSERT_NEAR((next.p_WB - state.p_WB - 0.001 * state.v_WB).norm(), 0.0, 1e-5) << i << ' ' << t;
    }
  }
}

TEST(Plan, UavsKeepApart) {
  const test::PlanSite& site = common_site();
  const Team team(site.scenario, site.config);
  const std::vector<PlanUav>& uavs = common_plan().uavs;
  for (double t = 0.0; t < site.scenario.duration_s; t += 0.05) {
    for (std::size_t a = 0; a < uavs.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const TeamKind &kind_a = team.kinds[team.kind_of[a]], &kind_b = team.kinds[team.kind_of[b]];
        const double distance =
            (plan_state(kind_a, uavs[a].moves, t).p_WB - plan_state(kind_b, uavs[b].moves, t).p_WB).norm();
        // Between two samples, two UAVs approach by no more than the distance that they fly in that time.
        ASSERT_GE(distance, Schedule::least_distance(kind_a, kind_b) - 0.05 * (kind_a.speed + kind_b.speed)) << t;
      }
    }
  }
}

TEST(Plan, TheLastPlaceIsLinkedToTheStationInTime) {
  const test::PlanSite& site = common_site();
  const RayScene world(site.scene.mesh);
  for (std::size_t i = 0; i < common_plan().uavs.size(); ++i) {
    const PlanUav& uav = common_plan().uavs[i];
    EXPECT_LE(uav.time_s, site.scenario.duration_s);
    const AntennaNode station{site.scenario.station_position, site.scenario.station_antenna_offset_m};
    const AntennaNode antenna{uav.moves.back().to_W, site.scenario.fleet[i].vehicle.antenna_offset_m};
    EXPECT_TRUE(trace_link(station, antenna, [&](const Vector3d& a, const Vector3d& b) {
                  return world.first_hit_distance(a, b);
                }).linked);
    EXPECT_EQ(uav.time_s, uav.moves.back().until_s);
  }
}

TEST(Plan, ThePlanDoesNotDependOnTheNumberOfThreads) {
  test::PlanSite site = common_site();
  site.config.threads = 3;
  EXPECT_EQ(to_json(plan_of(site)), to_json(common_plan()));
}

TEST(Plan, AUavBelowALidStaysOnTheGround) {
  test::PlanSite site(2, 30.0);
  const Vector2d start = site.scenario.fleet[0].start;
  test::add_box(site.scene.mesh, {start.x(), start.y(), 2.2}, {3.0, 3.0, 0.2});
  const Plan plan = plan_of(site);
  EXPECT_TRUE(plan.uavs[0].moves.empty());
  EXPECT_EQ(plan.uavs[0].views, 0u);
  EXPECT_GT(plan.uavs[1].views, 0u);
}

TEST(Plan, WithoutPointsThePlanIsEmpty) {
  test::PlanSite site(1, 30.0);
  site.scene.points.clear();
  const Plan plan = plan_of(site);
  EXPECT_EQ(plan.score, 0.0);
  EXPECT_TRUE(plan.uavs[0].moves.empty());
}

}  // namespace
}  // namespace skein::sim
