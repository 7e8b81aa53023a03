// Mass and size of a vehicle that is composed of parts: compared with mechanics for random vehicles, and computed by
// hand for the shipped ones.
#include "core/vehicle/airframe.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"

namespace skein {
namespace {

Vector3d draw(RandomStream& random, double low, double high) {
  return {random.uniform(low, high), random.uniform(low, high), random.uniform(low, high)};
}

VehicleConfig drawn_vehicle(RandomStream& random) {
  VehicleConfig vehicle;
  vehicle.mass_kg = random.uniform(0.5, 5.0);
  vehicle.inertia = draw(random, 0.01, 0.2);
  vehicle.rotor_mass_kg = random.uniform(0.0, 0.1);
  vehicle.arm_m = random.uniform(0.1, 0.6);
  vehicle.rotor_height_m = random.uniform(-0.1, 0.2);
  for (int i = 0; i < 3; ++i) {
    vehicle.links.push_back({.name = "part",
                             .mass_kg = random.uniform(0.0, 1.0),
                             .inertia = draw(random, 0.0, 0.05),
                             .p_BL = draw(random, -0.4, 0.4),
                             .box_m = draw(random, 0.05, 0.5)});
  }
  return vehicle;
}

struct RigidPart {
  double mass;
  Vector3d inertia, p_B;
};

std::vector<RigidPart> parts(const VehicleConfig& vehicle) {
  std::vector<RigidPart> parts{{vehicle.mass_kg, vehicle.inertia, Vector3d::Zero()}};
  for (const Vector3d& p_BR : rotor_hubs(vehicle)) parts.push_back({vehicle.rotor_mass_kg, Vector3d::Zero(), p_BR});
  for (const VehicleLink& link : vehicle.links) parts.push_back({link.mass_kg, link.inertia, link.p_BL});
  return parts;
}

TEST(Airframe, TurningPartsHaveTheMomentumAndEnergyOfTheWhole) {
  RandomStream random(1, "airframes", 0);
  for (int i = 0; i < 200; ++i) {
    const VehicleConfig vehicle = drawn_vehicle(random);
    const MassProperties whole = mass_properties(vehicle);
    const Vector3d w = draw(random, -3.0, 3.0);  // about the centre of mass
    double mass = 0.0, energy = 0.0;
    Vector3d momentum = Vector3d::Zero(), angular_momentum = Vector3d::Zero();
    for (const RigidPart& part : parts(vehicle)) {
      const Vector3d r = part.p_B - whole.p_BBcm, v = w.cross(r);
      mass += part.mass;
      momentum += part.mass * v;
      angular_momentum += part.mass * r.cross(v) + part.inertia.cwiseProduct(w);
      energy += 0.5 * part.mass * v.squaredNorm() + 0.5 * w.dot(part.inertia.cwiseProduct(w));
    }
    EXPECT_NEAR(whole.mass_kg, mass, 1e-12);
    EXPECT_LT(momentum.norm(), 1e-12) << "a body that turns about its centre of mass has no linear momentum";
    EXPECT_LT((whole.I_BBcm_B * w - angular_momentum).norm(), 1e-12);
    EXPECT_NEAR(0.5 * w.dot(whole.I_BBcm_B * w), energy, 1e-12);
  }
}

TEST(Airframe, AVehicleOfOneBodyHasTheMassAndInertiaOfThatBody) {
  const VehicleConfig vehicle;
  const MassProperties whole = mass_properties(vehicle);
  EXPECT_EQ(whole.mass_kg, vehicle.mass_kg);
  EXPECT_EQ(whole.p_BBcm, Vector3d::Zero());
  EXPECT_EQ(whole.I_BBcm_B, Matrix3d(vehicle.inertia.asDiagonal()));
}

TEST(Airframe, TheShippedVehiclesHaveTheMassAndInertiaComputedByHand) {
  const std::filesystem::path config = source_path("config");
  const MassProperties explorer = mass_properties(load_vehicle("explorer", config));
  EXPECT_NEAR(explorer.mass_kg, 3.385, 1e-12);
  // 2.5 kg at 0, 0.81 kg at 0.2 m, six times 0.0125 kg at 0.074 m, 0.43 m out.
  const double z = (0.81 * 0.2 + 0.075 * 0.074) / 3.385;
  EXPECT_NEAR(z, 0.0495, 1e-4);
  EXPECT_LT((explorer.p_BBcm - Vector3d(0, 0, z)).norm(), 1e-12);
  const double roll = 0.07648816666 + 2.5 * z * z + 0.81 * (0.2 - z) * (0.2 - z) +
                      0.075 * (0.5 * 0.43 * 0.43 + (0.074 - z) * (0.074 - z));
  EXPECT_NEAR(roll, 0.108, 2e-4);
  const Vector3d diagonal(roll, roll, 0.16283333333 + 0.075 * 0.43 * 0.43);
  EXPECT_LT((explorer.I_BBcm_B - Matrix3d(diagonal.asDiagonal())).norm(), 1e-12);

  const MassProperties photographer = mass_properties(load_vehicle("photographer", config));
  EXPECT_NEAR(photographer.mass_kg, 1.545, 1e-12);
  EXPECT_NEAR(photographer.p_BBcm.z(), 0.045 * 0.037 / 1.545, 1e-12);
  EXPECT_NEAR(photographer.I_BBcm_B(2, 2), 0.0977 + 0.045 * 0.2156 * 0.2156, 1e-12);
}

TEST(Airframe, ReachRadiusAndRestHeightFollowFromTheBoxes) {
  RandomStream random(2, "airframes", 0);
  for (int i = 0; i < 200; ++i) {
    const VehicleConfig vehicle = drawn_vehicle(random);
    std::vector<BodyBox> boxes = link_boxes(vehicle);
    ASSERT_EQ(boxes.size(), vehicle.links.size());
    boxes.push_back({Vector3d::Zero(), vehicle.collision_box_m});
    double reach = 0.0, radius = vehicle.arm_m + vehicle.rotor_radius_m, lowest = 0.0;
    for (const BodyBox& box : boxes) {
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d side(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
        const Vector3d p_B = box.p_B + side.cwiseProduct(box.edges_m);
        reach = std::max(reach, p_B.norm());
        radius = std::max(radius, p_B.head<2>().norm());
        lowest = std::min(lowest, p_B.z());
      }
    }
    EXPECT_NEAR(box_reach(vehicle), reach, 1e-12);
    EXPECT_NEAR(body_radius(vehicle), radius, 1e-12);
    EXPECT_NEAR(rest_height(vehicle), -lowest, 1e-12);
  }
}

}  // namespace
}  // namespace skein
