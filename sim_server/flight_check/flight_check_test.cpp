// The flight check compared with closed forms, and applied to flights of which some could always stop.
#include "sim_server/flight_check/flight_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "sim_server/record/flight_review.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim {
namespace {

constexpr double kRight = FlightCheck::kToleranceM + 1e-4;  // the second term is for single precision

Scenario fleet_of(const std::vector<std::string>& vehicles) {
  Scenario scenario;
  scenario.file = "check.yaml";
  scenario.station_position = {-5, -20, 0.3};
  for (const std::string& type : vehicles) {
    const double y = 6.0 * static_cast<double>(scenario.fleet.size());
    scenario.fleet.push_back({.name = "uav" + std::to_string(scenario.fleet.size()),
                              .vehicle = load_vehicle(type, source_path("config")),
                              .start = {0, y}});
  }
  return scenario;
}

CheckedUav flying(const Vector3d& p_W, const Vector3d& v_W, double delay_s = 0.05) {
  return {.p_W = p_W, .v_W = v_W, .present = true, .flies = true, .delay_s = delay_s, .setpoint = {}};
}

double way_of(const VehicleConfig& vehicle, double speed, double delay_s) {
  return speed * delay_s + speed * speed / (2.0 * FlightCheck::kBrakingShare * vehicle.max_acceleration_mps2);
}

FlightCheck::Findings found_in(const Scenario& scenario, const RayScene& rays, const std::vector<CheckedUav>& uavs) {
  FlightCheck check(scenario);
  check.add(20, rays, uavs);
  return check.findings();
}

RayScene wall_from_x_0() {
  TriangleMesh mesh;
  test::add_box(mesh, {5, 0, 0}, {10, 400, 400});
  return RayScene(mesh);
}

TEST(FlightCheck, TheCheckFindsASphereThatCannotStopBeforeAWall) {
  const Scenario scenario = fleet_of({"explorer"});
  const VehicleConfig& vehicle = scenario.fleet[0].vehicle;
  const RayScene wall = wall_from_x_0();
  const double radius = body_sphere_m(vehicle);
  RandomStream random(1, "wall", 0);
  int hits = 0, free = 0;
  for (int i = 0; i < 300; ++i) {
    const double room = random.uniform(0.0, 5.0), speed = random.uniform(0.0, 6.0), delay = random.uniform(0.0, 0.2);
    Vector3d direction = test::random_unit(random);
    const Vector3d p(-radius - room, random.uniform(-5, 5), random.uniform(-5, 5));
    const double left = room - std::max(0.0, direction.x()) * way_of(vehicle, speed, delay);
    const auto found = found_in(scenario, wall, {flying(p, speed * direction, delay)});
    EXPECT_EQ(found.exchanges, 1U);
    EXPECT_NEAR(found.least_clearance_m, room, 1e-4);
    // Inside the wall the distance is that of its nearest face.
    const double depth = std::max(left, -2.0 * radius - left);
    if (left > -radius) {
      EXPECT_NEAR(found.least_braking_clearance_m, depth, kRight) << i;
    }
    if (std::abs(left) < kRight) continue;
    EXPECT_EQ(found.braking_hits, left < 0.0 ? 1U : 0U) << i << ", " << left;
    ASSERT_EQ(found.first.size(), found.braking_hits);
    (left < 0.0 ? hits : free) += 1;
  }
  EXPECT_GT(hits, 30);
  EXPECT_GT(free, 30);
}

TEST(FlightCheck, TheCheckFindsAThinPoleThatIsTooCloseToTheBrakingPath) {
  const Scenario scenario = fleet_of({"photographer"});
  const VehicleConfig& vehicle = scenario.fleet[0].vehicle;
  TriangleMesh mesh;
  test::add_box(mesh, {0, 0, 0}, {0.02, 0.02, 100});
  const RayScene pole(mesh);
  RandomStream random(2, "pole", 0);
  for (int i = 0; i < 200; ++i) {
    const double speed = random.uniform(2.0, 8.0), way = way_of(vehicle, speed, 0.1);
    const double ahead = random.uniform(0.05, 0.95) * way, aside = random.uniform(0.05, 2.0);
    const auto found = found_in(scenario, pole, {flying({-ahead, 0.01 + aside, 3}, {speed, 0, 0}, 0.1)});
    const double left = aside - body_sphere_m(vehicle);
    EXPECT_NEAR(found.least_braking_clearance_m, left, kRight) << i;
    if (std::abs(left) < kRight) continue;
    EXPECT_EQ(found.braking_hits, left < 0.0 ? 1U : 0U) << i;
    if (left > 0.0) continue;
    ASSERT_EQ(found.first.size(), 1U);
    EXPECT_NEAR(found.first[0].p_W.x(), 0.0, 0.2) << "where it is nearest";
    EXPECT_FALSE(found.first[0].with);
  }
}

TEST(FlightCheck, TheCheckFindsTwoUavsThatFlyHeadOnAndCannotStop) {
  const Scenario scenario = fleet_of({"explorer", "photographer"});
  const RayScene nothing{TriangleMesh{}};
  const double radii = body_sphere_m(scenario.fleet[0].vehicle) + body_sphere_m(scenario.fleet[1].vehicle);
  RandomStream random(3, "head_on", 0);
  for (int i = 0; i < 200; ++i) {
    const double va = random.uniform(0.0, 6.0), vb = random.uniform(0.0, 8.0), room = random.uniform(0.0, 9.0);
    const Vector3d to_b = test::random_unit(random);
    const auto found =
        found_in(scenario, nothing,
                 {flying({0, 0, 50}, va * to_b), flying(Vector3d(0, 0, 50) + (radii + room) * to_b, -vb * to_b)});
    const double left =
        room - way_of(scenario.fleet[0].vehicle, va, 0.05) - way_of(scenario.fleet[1].vehicle, vb, 0.05);
    EXPECT_NEAR(found.least_separation_m, room, 1e-9);
    EXPECT_NEAR(found.least_braking_separation_m, std::max(left, -radii), kRight) << i;
    if (std::abs(left) < kRight) continue;
    EXPECT_EQ(found.braking_meets, left < 0.0 ? 1U : 0U) << i;
    EXPECT_EQ(found.ways_meet, left < 0.0 ? 1U : 0U) << i;
    EXPECT_EQ(found.braking_hits, 0U);
  }
}

TEST(FlightCheck, BrakingPathsMayMeetAlthoughTheBodiesNeverDo) {
  const Scenario scenario = fleet_of({"photographer", "photographer"});
  const RayScene nothing{TriangleMesh{}};
  // One UAV flies ahead of the other, and both brake alike: the second one passes the present place of the first one.
  const auto found = found_in(scenario, nothing, {flying({0, 0, 9}, {5, 0, 0}), flying({2, 0, 9}, {5, 0, 0})});
  EXPECT_EQ(found.braking_meets, 0U);
  EXPECT_EQ(found.ways_meet, 1U);
  EXPECT_NEAR(found.least_braking_separation_m, found.least_separation_m, 1e-9);
}

TEST(FlightCheck, TrackingIsNotMeasuredWhileAUavCatchesUpAfterTakeoff) {
  const Scenario scenario = fleet_of({"explorer"});
  const RayScene nothing{TriangleMesh{}};
  FlightCheck check(scenario);
  CheckedUav uav = flying({0, 0, 5}, {0, 0, 1});
  uav.setpoint = TrajectoryCommand{.p_WB = {0, 0, 5.5}, .v_WB = {0, 0, 1}};
  CheckedUav rests = uav;
  rests.flies = false;
  const auto seen = [&] { return check.findings().tracking.quantiles().samples; };
  check.add(400, nothing, std::vector{rests});
  check.add(400 + ticks(FlightCheck::kCatchUpS), nothing, std::vector{uav});
  EXPECT_EQ(seen(), 0U);
  check.add(401 + ticks(FlightCheck::kCatchUpS), nothing, std::vector{uav});
  ASSERT_EQ(seen(), 1U);
  EXPECT_NEAR(check.findings().tracking.quantiles().max, 0.5, results::TrackingTable::kErrorStepM + 1e-9);
  uav.setpoint->p_WB = {0, 0, 0};  // all zeros: the command has no position
  check.add(8000, nothing, std::vector{uav});
  uav.setpoint.reset();
  check.add(8020, nothing, std::vector{uav});
  EXPECT_EQ(seen(), 1U);
  EXPECT_EQ(check.findings().exchanges, 4U);
}

TEST(FlightCheck, AUavThatIsOutOrStandsOnTheGroundIsNotChecked) {
  const Scenario scenario = fleet_of({"explorer", "explorer"});
  const RayScene wall = wall_from_x_0();
  CheckedUav out = flying({-1, 0, 5}, {6, 0, 0});
  out.present = out.flies = false;
  CheckedUav stands = flying({-1, 3, 5}, {6, 0, 0});
  stands.flies = false;
  const auto found = found_in(scenario, wall, {out, stands});
  EXPECT_EQ(found.exchanges, 0U);
  EXPECT_EQ(found.braking_hits + found.braking_meets + found.ways_meet, 0U);
  EXPECT_EQ(found.least_separation_m, FlightCheck::kMostM);
  // But a UAV that stands is an obstacle for one that flies.
  const auto other = found_in(scenario, wall, {flying({-50, 0, 5}, {6, 0, 0}), [&] {
                                                 CheckedUav still = stands;
                                                 still.p_W = {-46, 0, 5};
                                                 return still;
                                               }()});
  EXPECT_EQ(other.braking_meets, 1U);
}

TEST(FlightCheck, TheCheckListsTheFirstFindingOfEachFlight) {
  const Scenario scenario = fleet_of({"explorer", "explorer"});
  const RayScene wall = wall_from_x_0();
  std::vector<CheckedUav> uavs = {flying({-1, 0, 5}, {6, 0, 0}), flying({-1, 0.2, 5}, {6, 0, 0})};
  FlightCheck check(scenario);
  std::size_t listed = 0;
  Tick tick = 0;
  for (const bool flies : {true, true, false, true, true}) {
    if (flies && !uavs[0].flies) listed = 3;
    for (CheckedUav& uav : uavs) uav.flies = flies;
    check.add(tick += 20, wall, uavs);
    EXPECT_EQ(check.findings().first.size(), listed + 3) << "each UAV with the wall, and the two with each other";
  }
}

/// A pilot's setpoints, one after the other.
using Pilot = std::function<TrajectoryCommand(double t)>;

/// Climbs to z, then flies along a line from its start: as fast as it may, and brakes such that it stands at `end_m`.
Pilot line_flight(const Vector3d& start_W, const Vector3d& direction_W, double end_m, double speed, double braking) {
  constexpr double kZ = 8.0, kClimbS = 8.0;
  return [=](double t) {
    const Vector3d from(start_W.x(), start_W.y(), kZ);
    if (t < kClimbS) return TrajectoryCommand{.p_WB = from - Vector3d(0, 0, std::max(0.0, kZ - 0.5 - 1.5 * t))};
    const double s = t - kClimbS, a = 1.5, rise_s = speed / a, brake_s = speed / braking;
    const double cruise_s = (end_m - 0.5 * speed * (rise_s + brake_s)) / speed;
    double x = end_m, v = 0.0, acc = 0.0;
    if (s < rise_s) {
      std::tie(x, v, acc) = std::tuple(0.5 * a * s * s, a * s, a);
    } else if (s < rise_s + cruise_s) {
      std::tie(x, v, acc) = std::tuple(0.5 * speed * rise_s + speed * (s - rise_s), speed, 0.0);
    } else if (const double left_s = rise_s + cruise_s + brake_s - s; left_s > 0.0) {
      std::tie(x, v, acc) = std::tuple(end_m - 0.5 * braking * left_s * left_s, braking * left_s, -braking);
    }
    return TrajectoryCommand{.p_WB = from + x * direction_W, .v_WB = v * direction_W, .a_WB = acc * direction_W};
  };
}

/// Flies the pilots' setpoints in the simulation. @returns the report of the check.
FlightCheckReport flown(const Scenario& scenario, const TriangleMesh& mesh, const std::vector<Pilot>& pilots,
                        double duration_s, bool& collided) {
  Scene scene;
  scene.mesh = mesh;
  Simulation simulation(scenario, scene, 0);
  FlightReview review(scenario);
  collided = false;
  for (double t = 0.0; t < duration_s; t += scenario.exchange_period_s) {
    for (std::size_t i = 0; i < pilots.size(); ++i) simulation.command_trajectory(UavIndex(i), pilots[i](t));
    simulation.advance();
    collided = collided || !simulation.events().collisions.empty();
    review.add_step(simulation);
  }
  return review.report();
}

TEST(FlightCheck, TheCheckFindsAUavThatFliesFastAtAWallAndStopsLate) {
  const Scenario scenario = fleet_of({"explorer"});
  TriangleMesh wall;
  test::add_box(wall, {30.5, 0, 10}, {1, 40, 20});
  bool collided = false;
  const Vector3d start(0, 0, 0);
  // The flights `late` and `honest` both end 1.5 m before the wall, and neither UAV touches it.
  const auto late = flown(scenario, wall, {line_flight(start, {1, 0, 0}, 28.5, 5.0, 3.9)}, 24.0, collided);
  ASSERT_FALSE(collided);
  EXPECT_GT(*late.braking_hits, 0U);
  EXPECT_LT(*late.least_braking_clearance_m, 0.0);
  EXPECT_GT(*late.least_clearance_m, 0.0);
  ASSERT_FALSE(late.first.empty());
  EXPECT_EQ(late.first[0].uav, "uav0");
  EXPECT_EQ(late.first[0].with, "structure");
  EXPECT_GT(*late.first[0].time_s, 8.0);
  EXPECT_GT((*late.first[0].position)[0], 28.0);

  // A UAV that hits the wall could not have stopped before.
  const auto hit = flown(scenario, wall, {line_flight(start, {1, 0, 0}, 40.0, 4.0, 2.0)}, 24.0, collided);
  ASSERT_TRUE(collided);
  EXPECT_GT(*hit.braking_hits, 0U);

  const auto honest = flown(scenario, wall, {line_flight(start, {1, 0, 0}, 28.5, 5.0, 2.0)}, 24.0, collided);
  ASSERT_FALSE(collided);
  EXPECT_EQ(*honest.braking_hits, 0U);
  EXPECT_GT(*honest.least_braking_clearance_m, 0.0);
  EXPECT_NEAR(*honest.least_clearance_m, 1.5 - body_sphere_m(scenario.fleet[0].vehicle), 0.3);
  EXPECT_TRUE(honest.first.empty());
  EXPECT_GT(*honest.tracking_error_m.samples, 200U);
  EXPECT_LT(*honest.tracking_error_m.p50, 0.3);
}

TEST(FlightCheck, TheCheckFindsTwoUavsThatPassTooCloseToBrake) {
  // Their lines cross at a right angle. The fast one is there after 20 m of its way, the slow one `apart_s` before it.
  constexpr double kFast = 6.0, kSlow = 3.0, kAcceleration = 1.5;
  const auto fly = [&](double apart_s, bool& collided) {
    const double slow_s = 20.0 / kFast + 0.5 * kFast / kAcceleration - apart_s;
    const double before_m = kSlow * (slow_s - 0.5 * kSlow / kAcceleration);
    Scenario scenario = fleet_of({"photographer", "photographer"});
    scenario.fleet[0].start = {-20, 0};
    scenario.fleet[1].start = {0, -before_m};
    return flown(scenario, {},
                 {line_flight({-20, 0, 0}, {1, 0, 0}, 40.0, kFast, 3.0),
                  line_flight({0, -before_m, 0}, {0, 1, 0}, 30.0, kSlow, 3.0)},
                 24.0, collided);
  };
  bool collided = false;
  const auto near = fly(0.4, collided);
  ASSERT_FALSE(collided);
  EXPECT_GT(*near.least_separation_m, 0.1);
  EXPECT_GT(*near.braking_meets, 0U);
  EXPECT_GT(*near.ways_meet, 0U);
  ASSERT_FALSE(near.first.empty());
  EXPECT_EQ(near.first[0].uav, "uav0");
  EXPECT_EQ(near.first[0].with, "uav1");
  EXPECT_LT(Vector3d((*near.first[0].position).data()).head<2>().norm(), 2.0) << "at the crossing";
  // If the fast UAV arrives that late, the slow one has left the crossing before.
  const auto far = fly(2.5, collided);
  ASSERT_FALSE(collided);
  EXPECT_EQ(*far.braking_meets, 0U);
  EXPECT_EQ(*far.ways_meet, 0U);
  EXPECT_GT(*far.least_braking_separation_m, 0.0);
  EXPECT_TRUE(far.first.empty());
}

}  // namespace
}  // namespace skein::sim
