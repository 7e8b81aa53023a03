#include "sim_server/flight/physics_world.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "core/vehicle/airframe.hpp"
#include "sim_server/flight/bullet_clearance.hpp"
#include "sim_server/flight/mass_frame.hpp"
#include "sim_server/flight/momentum_keeper.hpp"

namespace skein::sim {
namespace {

// Bullet keeps contact points of surfaces up to 2 cm apart, and pushes bodies apart that are nearer than their margins.
// A small margin makes thin members, such as those of a crane, only slightly thicker.
constexpr double kMargin = 0.001;  // [m]
// Thickness of a rotor's disc: the distance that a UAV flies in one tick at 10 m/s. So up to this speed, a UAV cannot
// pass through a thin sheet of the structure between two ticks.
constexpr double kRotorDiscThickness = 0.025;  // [m]
// The world tests a UAV for contacts if the UAV's bounding sphere is nearer than this to an obstacle. It is far more
// than the distance at which Bullet keeps contact points, and more than a UAV flies in a tick.
constexpr double kContactReach = 0.15;  // [m]
// Triangles in the ground plane count as ground, so that UAVs can land on the floor slab of a building.
constexpr float kGroundSlab = 0.01F;  // height above or below z = 0 [m]
constexpr int kSolverIterations = 20;
// A UAV without thrust that has been this slow for this long falls asleep, and then costs no computing time. Bullet has
// its own rule for sleep; this one does not depend on a body's neighbours.
constexpr double kStillSpeed = 0.02;  // [m/s], and [rad/s]
constexpr int kStillTicks = 200;
constexpr double kNoWrench = 1e-6;  // [N], [N m]

btTransform transform_of(const Quaterniond& q, const Vector3d& p) {
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(p));
}

bool in_ground_plane(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](std::uint32_t vertex) { return std::abs(mesh.vertices[vertex].z()) <= kGroundSlab; });
}

/// Boxes and six rotor discs; owns its children.
class VehicleShape {
 public:
  /// @param X_BP  pose in B of the frame P that is the shape's frame in Bullet.
  explicit VehicleShape(const VehicleConfig& vehicle, const Isometry3d& X_BP = Isometry3d::Identity())
      : disc_(btVector3(vehicle.rotor_radius_m, vehicle.rotor_radius_m, 0.5 * kRotorDiscThickness)) {
    const Isometry3d X_PB = X_BP.inverse();
    const auto add = [&](btCollisionShape& child, const Vector3d& p_B) {
      child.setMargin(kMargin);
      compound_.addChildShape(transform_of(Quaterniond(Matrix3d(X_PB.linear())), X_PB * p_B), &child);
    };
    const auto add_box = [&](const BodyBox& box) {
      boxes_.push_back(std::make_unique<btBoxShape>(to_bullet(0.5 * box.edges_m)));
      add(*boxes_.back(), box.p_B);
    };
    add_box({Vector3d::Zero(), vehicle.collision_box_m});
    for (const BodyBox& box : link_boxes(vehicle)) add_box(box);
    for (const Vector3d& p_BR : rotor_hubs(vehicle)) add(disc_, p_BR);
    compound_.setMargin(kMargin);
  }
  VehicleShape(const VehicleShape&) = delete;
  VehicleShape& operator=(const VehicleShape&) = delete;

  btCompoundShape& compound() { return compound_; }

 private:
  std::vector<std::unique_ptr<btBoxShape>> boxes_;
  btCylinderShapeZ disc_;
  btCompoundShape compound_;
};

/// Radius of the sphere about Bo that contains boxes and rotors.
double bounding_radius(const VehicleConfig& vehicle) {
  const double rotor =
      std::hypot(vehicle.arm_m + vehicle.rotor_radius_m, std::abs(vehicle.rotor_height_m) + 0.5 * kRotorDiscThickness);
  return std::max(rotor, box_reach(vehicle)) + kMargin;
}

struct UavBody {
  MassFrame frame;
  std::unique_ptr<VehicleShape> shape;
  std::unique_ptr<btRigidBody> body;  ///< its frame is P
  double radius = 0.0;                ///< of the bounding sphere about the centre of mass [m]
  bool pushed = false;                ///< a wrench acts during the coming tick
  int still_ticks = 0;
  bool out = false;                      ///< removed from the world
  ClearanceMemory clearance;             ///< from the structure
  std::optional<MomentumKeeper> keeper;  ///< while a step is under way

  UavBody(const VehicleConfig& vehicle, const Isometry3d& X_WB)
      : frame(mass_frame(vehicle)),
        shape(std::make_unique<VehicleShape>(vehicle, frame.X_BP)),
        radius(bounding_radius(vehicle) + frame.X_BP.translation().norm()) {
    body = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(frame.mass_kg, nullptr, &shape->compound(), to_bullet(frame.inertia)));
    body->setActivationState(DISABLE_DEACTIVATION);  // fall_asleep_if_still() replaces Bullet's rule
    body->setFlags(0);                               // no gyroscopic terms: MomentumKeeper computes them
    set_state({.p_WB = X_WB.translation(), .q_WB = Quaterniond(Matrix3d(X_WB.linear()))});
  }

  RigidBodyState state() const {
    const btTransform& X_WP = body->getWorldTransform();
    const btQuaternion q_WP = X_WP.getRotation();
    return body_state(frame, {to_eigen(X_WP.getOrigin()), Quaterniond(q_WP.w(), q_WP.x(), q_WP.y(), q_WP.z()),
                              to_eigen(body->getLinearVelocity()), to_eigen(body->getAngularVelocity())});
  }
  void set_state(const RigidBodyState& state) {
    const MassState moving = mass_state(frame, state);
    body->setWorldTransform(transform_of(moving.q_WP, moving.p_WBcm));
    body->setInterpolationWorldTransform(body->getWorldTransform());
    body->setLinearVelocity(to_bullet(moving.v_WBcm));
    body->setAngularVelocity(to_bullet(moving.w_WB));
    body->updateInertiaTensor();
  }

  bool asleep() const { return body->getActivationState() == DISABLE_SIMULATION; }
  void wake() {
    body->forceActivationState(DISABLE_DEACTIVATION);
    still_ticks = 0;
  }
  void begin_step(double step_s) {
    if (out || asleep()) return;
    keeper.emplace(frame.inertia, rotation(), to_eigen(body->getAngularVelocity()), step_s);
    body->setAngularVelocity(to_bullet(keeper->middle_velocity()));
  }
  void end_step() {
    if (!keeper) return;
    body->setAngularVelocity(to_bullet(keeper->finish(rotation(), to_eigen(body->getAngularVelocity()))));
    keeper.reset();
    fall_asleep_if_still();
  }

 private:
  Matrix3d rotation() const {
    const btMatrix3x3& R = body->getWorldTransform().getBasis();
    Matrix3d R_WP;
    R_WP << R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2];
    return R_WP;
  }
  void fall_asleep_if_still() {
    const bool still =
        !pushed && body->getLinearVelocity().norm() < kStillSpeed && body->getAngularVelocity().norm() < kStillSpeed;
    pushed = false;
    still_ticks = still ? still_ticks + 1 : 0;
    if (still_ticks < kStillTicks) return;
    body->setLinearVelocity(btVector3(0, 0, 0));
    body->setAngularVelocity(btVector3(0, 0, 0));
    body->forceActivationState(DISABLE_SIMULATION);
  }
};

}  // namespace

struct PhysicsWorld::Impl {
  Impl(const TriangleMesh& mesh, double the_step_s);
  ~Impl();

  void add_static(btCollisionShape& shape, std::unique_ptr<btRigidBody>& body, int user_index);
  bool worth_testing(UavBody& uav, const btCollisionObject& other);
  static void near_callback(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info);
  BodyId identify(const btCollisionObject& object) const;
  void step();
  std::vector<Contact> read_contacts();
  void wake_hit_uavs(const std::vector<Contact>& contacts);

  // User indices of bodies; that of a UAV is its fleet index.
  static constexpr int kGroundIndex = -2, kStructureIndex = -3;

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

  btStaticPlaneShape ground_shape{btVector3(0, 0, 1), 0.0};
  std::unique_ptr<btRigidBody> ground;
  std::vector<std::array<std::uint32_t, 3>> indices;  ///< of the structure's triangles; Bullet points into it
  btTriangleIndexVertexArray triangles;
  std::unique_ptr<btBvhTriangleMeshShape> structure_shape;
  std::unique_ptr<btRigidBody> structure;
  std::vector<UavBody> uavs;
  const double step_s;
};

PhysicsWorld::Impl::Impl(const TriangleMesh& mesh, double the_step_s) : step_s(the_step_s) {
  world.setGravity(btVector3(0, 0, -kWorldGravity));
  world.setForceUpdateAllAabbs(false);
  world.getDispatchInfo().m_deterministicOverlappingPairs = true;
  world.getSolverInfo().m_numIterations = kSolverIterations;
  solver.setRandSeed(0);
  // Bullet's callbacks get no context but the bodies, so the bodies' user pointers point to this object.
  dispatcher.setNearCallback(&Impl::near_callback);

  add_static(ground_shape, ground, kGroundIndex);
  std::remove_copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(indices),
                      [&](const auto& triangle) { return in_ground_plane(mesh, triangle); });
  if (indices.empty()) return;
  btIndexedMesh part;
  part.m_numTriangles = static_cast<int>(indices.size());
  part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices.data());
  part.m_triangleIndexStride = sizeof(indices[0]);
  part.m_numVertices = static_cast<int>(mesh.vertices.size());
  part.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh.vertices.data());
  part.m_vertexStride = sizeof(mesh.vertices[0]);
  part.m_vertexType = PHY_FLOAT;
  triangles.addIndexedMesh(part, PHY_INTEGER);
  structure_shape = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
  structure_shape->setMargin(kMargin);
  add_static(*structure_shape, structure, kStructureIndex);
}

PhysicsWorld::Impl::~Impl() {
  for (UavBody& uav : uavs) {
    if (!uav.out) world.removeRigidBody(uav.body.get());
  }
  if (structure) world.removeRigidBody(structure.get());
  world.removeRigidBody(ground.get());
}

void PhysicsWorld::Impl::add_static(btCollisionShape& shape, std::unique_ptr<btRigidBody>& body, int user_index) {
  shape.setMargin(kMargin);
  body = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, &shape));
  body->setUserIndex(user_index);
  body->setUserPointer(this);
  world.addRigidBody(body.get());
}

bool PhysicsWorld::Impl::worth_testing(UavBody& uav, const btCollisionObject& other) {
  // Bullet updates a pair's contact points only when it tests the pair. Skipping the test is safe, because it begins at
  // distances far beyond those at which Bullet keeps points.
  const btVector3& centre = uav.body->getWorldTransform().getOrigin();
  const double reach = uav.radius + kContactReach;
  if (other.getUserIndex() == kGroundIndex) return centre.z() < reach;
  return other.getUserIndex() != kStructureIndex || uav.clearance.may_touch(*structure_shape, to_eigen(centre), reach);
}

void PhysicsWorld::Impl::near_callback(btBroadphasePair& pair, btCollisionDispatcher& dispatcher,
                                       const btDispatcherInfo& info) {
  const auto* a = static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject);
  const auto* b = static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject);
  if (a->getUserIndex() < 0) std::swap(a, b);
  auto& self = *static_cast<Impl*>(a->getUserPointer());
  UavBody& uav = self.uavs[static_cast<std::size_t>(a->getUserIndex())];
  if (self.worth_testing(uav, *b)) btCollisionDispatcher::defaultNearCallback(pair, dispatcher, info);
}

void PhysicsWorld::Impl::step() {
  for (UavBody& uav : uavs) uav.begin_step(step_s);
  world.stepSimulation(step_s, 0);
  for (UavBody& uav : uavs) uav.end_step();
}

BodyId PhysicsWorld::Impl::identify(const btCollisionObject& object) const {
  switch (object.getUserIndex()) {
    case kGroundIndex:
      return {BodyId::Kind::ground, {}};
    case kStructureIndex:
      return {BodyId::Kind::structure, {}};
    default:
      return {BodyId::Kind::uav, UavIndex(static_cast<std::size_t>(object.getUserIndex()))};
  }
}

std::vector<Contact> PhysicsWorld::Impl::read_contacts() {
  std::vector<ContactPoint> points;
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const BodyId a = identify(*manifold.getBody0()), b = identify(*manifold.getBody1());
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold.getContactPoint(i);
      // Bullet also keeps points of bodies that are only near. Two bodies touch if they overlap or push each other.
      if (point.getDistance() > 0.0 && point.getAppliedImpulse() <= 0.0) continue;
      const btVector3 middle = 0.5 * (point.getPositionWorldOnA() + point.getPositionWorldOnB());
      points.push_back({contact_between(a, b, to_eigen(middle)), point.getDistance()});
    }
  }
  return one_for_each_pair(std::move(points));
}

void PhysicsWorld::Impl::wake_hit_uavs(const std::vector<Contact>& contacts) {
  for (const Contact& contact : contacts) {
    if (contact.other.kind != BodyId::Kind::uav) continue;
    UavBody &a = uavs[contact.uav], &b = uavs[contact.other.uav];
    if (a.asleep() && b.still_ticks == 0) a.wake();
    if (b.asleep() && a.still_ticks == 0) b.wake();
  }
}

PhysicsWorld::PhysicsWorld(const TriangleMesh& mesh, double step_s) : impl_(std::make_unique<Impl>(mesh, step_s)) {}
PhysicsWorld::~PhysicsWorld() = default;

void PhysicsWorld::add_uav(const VehicleConfig& vehicle, const Isometry3d& X_WB) {
  UavBody uav(vehicle, X_WB);
  uav.body->setUserIndex(static_cast<int>(impl_->uavs.size()));
  uav.body->setUserPointer(impl_.get());
  impl_->world.addRigidBody(uav.body.get());
  impl_->uavs.push_back(std::move(uav));
  states_.push_back({.p_WB = X_WB.translation(), .q_WB = Quaterniond(X_WB.linear())});
}

bool PhysicsWorld::touches_structure(const VehicleConfig& vehicle, const Isometry3d& X_WB) const {
  struct Touch final : btCollisionWorld::ContactResultCallback {
    bool found = false;
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
      found = found || point.getDistance() <= 0.0;
      return 0.0;
    }
  } touch;
  if (!impl_->structure) return false;
  VehicleShape shape(vehicle);
  btCollisionObject probe;
  probe.setCollisionShape(&shape.compound());
  probe.setWorldTransform(transform_of(Quaterniond(X_WB.linear()), X_WB.translation()));
  impl_->world.contactPairTest(&probe, impl_->structure.get(), touch);
  return touch.found;
}

void PhysicsWorld::apply_wrench(UavIndex uav, const Vector3d& force_W, const Vector3d& torque_W) {
  UavBody& pushed = impl_->uavs[uav];
  if (pushed.out) return;
  if (force_W.norm() < kNoWrench && torque_W.norm() < kNoWrench) return;
  if (pushed.asleep()) pushed.wake();
  pushed.pushed = true;
  pushed.body->applyCentralForce(to_bullet(force_W));
  pushed.body->applyTorque(to_bullet(torque_about_mass(pushed.frame, states_[uav].q_WB, force_W, torque_W)));
}

bool PhysicsWorld::sane(const RigidBodyState& state) const {
  const bool finite =
      state.p_WB.allFinite() && state.q_WB.coeffs().allFinite() && state.v_WB.allFinite() && state.w_WB_B.allFinite();
  // The limit of the velocities ensures that their squares in later computations are finite.
  constexpr double kFastest = 1e6;  // [m/s], and [rad/s]
  return finite && state.p_WB.norm() <= reach_m_ && state.v_WB.norm() < kFastest && state.w_WB_B.norm() < kFastest;
}

void PhysicsWorld::take_out(UavIndex uav) {
  impl_->world.removeRigidBody(impl_->uavs[uav].body.get());
  impl_->uavs[uav].out = true;
  states_[uav].v_WB = states_[uav].w_WB_B = Vector3d::Zero();
  strays_.push_back(uav);
}

void PhysicsWorld::tick() {
  impl_->step();
  strays_.clear();
  for (const UavIndex i : FirstUavs(states_.size())) {
    if (impl_->uavs[i].out) continue;
    const RigidBodyState state = impl_->uavs[i].state();
    if (sane(state)) {
      states_[i] = state;
    } else {
      take_out(i);
    }
  }
  contacts_ = impl_->read_contacts();
  impl_->wake_hit_uavs(contacts_);
}

void PhysicsWorld::set_state(UavIndex uav, const RigidBodyState& state) {
  UavBody& moved = impl_->uavs[uav];
  if (moved.out) return;
  moved.set_state(state);
  moved.clearance.forget();
  moved.wake();
  impl_->broadphase.getOverlappingPairCache()->cleanProxyFromPairs(moved.body->getBroadphaseProxy(),
                                                                   &impl_->dispatcher);
  states_[uav] = state;
}

}  // namespace skein::sim
