#include "sim_server/physics_world.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "sim_server/bullet_clearance.hpp"

namespace skein::sim {
namespace {

// Bullet keeps contact points up to 2 cm apart, and pushes apart what comes nearer than the margins. Small margins
// keep the thin members of a crane as thin as they are.
constexpr double kMargin = 0.001;
// A rotor sweeps a disc. As thick as the travel of one tick at 10 m/s, so that no sheet of the structure passes
// through it between two ticks.
constexpr double kRotorDiscThickness = 0.025;
// A UAV is tested for contacts when its sphere comes nearer than this: far beyond the distance at which Bullet keeps
// contact points, and more than the travel of a tick.
constexpr double kContactReach = 0.15;
// How far around that sphere the nearest triangle is looked for. Finding none, a UAV may fly so far untested.
constexpr double kLookAround = 1.5;
// With less room than this, looking for the nearest triangle at every tick would cost more than the test.
constexpr double kLeastRoom = 0.02;
// Triangles that lie in the ground plane are ground: the floor slab of a building is no obstacle to who lands there.
constexpr float kGroundSlab = 0.01F;
constexpr int kSolverIterations = 20;
// A UAV without thrust that has been this slow for this long lies still and costs nothing more. Bullet has a rule of
// its own for that; this one does not depend on a body's neighbours.
constexpr double kStillSpeed = 0.02;  // [m/s], and [rad/s]
constexpr int kStillTicks = 200;
constexpr double kNoWrench = 1e-6;  // [N], [N m]

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Quaterniond& q, const Vector3d& p) {
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(p));
}

bool in_ground_plane(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](std::uint32_t vertex) { return std::abs(mesh.vertices[vertex].z()) <= kGroundSlab; });
}

/// Box and six rotor discs; owns its children.
class VehicleShape {
 public:
  explicit VehicleShape(const VehicleConfig& vehicle)
      : box_(to_bullet(0.5 * vehicle.collision_box_m)),
        disc_(btVector3(vehicle.rotor_radius_m, vehicle.rotor_radius_m, 0.5 * kRotorDiscThickness)) {
    box_.setMargin(kMargin);
    disc_.setMargin(kMargin);
    compound_.addChildShape(btTransform::getIdentity(), &box_);
    for (int i = 0; i < 6; ++i) {
      const double angle = (30.0 + 60.0 * i) * std::numbers::pi / 180.0;
      const Vector3d p_BR(vehicle.arm_m * std::cos(angle), vehicle.arm_m * std::sin(angle), vehicle.rotor_height_m);
      compound_.addChildShape(to_bullet(Quaterniond::Identity(), p_BR), &disc_);
    }
    compound_.setMargin(kMargin);
  }
  VehicleShape(const VehicleShape&) = delete;
  VehicleShape& operator=(const VehicleShape&) = delete;

  btCompoundShape& compound() { return compound_; }

 private:
  btBoxShape box_;
  btCylinderShapeZ disc_;
  btCompoundShape compound_;
};

/// Radius of the sphere about the centre that holds box and rotors.
double bounding_radius(const VehicleConfig& vehicle) {
  const double rotor =
      std::hypot(vehicle.arm_m + vehicle.rotor_radius_m, vehicle.rotor_height_m + 0.5 * kRotorDiscThickness);
  return std::max(rotor, 0.5 * vehicle.collision_box_m.norm()) + kMargin;
}

struct UavBody {
  std::unique_ptr<VehicleShape> shape;
  std::unique_ptr<btRigidBody> body;
  double radius = 0.0;
  Vector3d inertia = Vector3d::Zero();
  bool pushed = false;  ///< a wrench acts during the coming tick
  int still_ticks = 0;
  bool tested = false;                ///< for contacts with the structure, when last asked
  std::optional<btVector3> clear_at;  ///< around here it cannot touch the structure ...
  double room = 0.0;                  ///< ... as long as it is no farther away than this

  bool asleep() const { return body->getActivationState() == DISABLE_SIMULATION; }
  void wake() {
    body->forceActivationState(DISABLE_DEACTIVATION);
    still_ticks = 0;
  }
  /// After a step: whether to go on.
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

/// Turns a body through one step so that its angular momentum is kept: Bullet knows angular velocity only, and its own
/// gyroscopic terms cost a spinning body 2 % of its energy in a second. Here Bullet turns the body at the velocity that
/// belongs to the middle of the step, and what its forces and contacts added to that is added to the momentum.
class MomentumKeeper {
 public:
  MomentumKeeper(UavBody& uav, double step_s) : body_(*uav.body), inertia_(uav.inertia), R_WB_(rotation()) {
    const Vector3d w_WB = to_eigen(body_.getAngularVelocity());
    L_W_ = momentum(R_WB_, w_WB);
    const double half_turn = 0.5 * step_s * w_WB.norm();
    const Matrix3d R_WM =
        half_turn > 0.0 ? Matrix3d(Eigen::AngleAxisd(half_turn, w_WB.normalized()).toRotationMatrix() * R_WB_) : R_WB_;
    w_middle_W_ = velocity(R_WM, L_W_);
    body_.setAngularVelocity(to_bullet(w_middle_W_));
  }
  /// After the step: the velocity that the momentum now amounts to.
  void finish() {
    L_W_ += momentum(R_WB_, to_eigen(body_.getAngularVelocity()) - w_middle_W_);
    body_.setAngularVelocity(to_bullet(velocity(rotation(), L_W_)));
  }

 private:
  Matrix3d rotation() const {
    const btMatrix3x3& R = body_.getWorldTransform().getBasis();
    Matrix3d R_WB;
    R_WB << R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2];
    return R_WB;
  }
  Vector3d momentum(const Matrix3d& R_WB, const Vector3d& w_W) const {
    return R_WB * inertia_.cwiseProduct(R_WB.transpose() * w_W);
  }
  Vector3d velocity(const Matrix3d& R_WB, const Vector3d& L_W) const {
    return R_WB * (R_WB.transpose() * L_W).cwiseQuotient(inertia_);
  }

  btRigidBody& body_;
  Vector3d inertia_;
  Matrix3d R_WB_;
  Vector3d L_W_, w_middle_W_;
};

}  // namespace

double rest_height(const VehicleConfig& vehicle) { return 0.5 * vehicle.collision_box_m.z(); }

double body_radius(const VehicleConfig& vehicle) {
  return std::max(vehicle.arm_m + vehicle.rotor_radius_m, 0.5 * vehicle.collision_box_m.head<2>().norm());
}

struct PhysicsWorld::Impl {
  Impl(const TriangleMesh& mesh, double the_step_s);
  ~Impl();

  void add_static(btCollisionShape& shape, std::unique_ptr<btRigidBody>& body, int user_index);
  bool worth_testing(UavBody& uav, const btCollisionObject& other);
  bool near_structure(UavBody& uav, const btVector3& centre) const;
  static void near_callback(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info);
  BodyId identify(const btCollisionObject& object) const;
  void step();
  std::vector<Contact> read_contacts();
  void wake_who_was_hit(const std::vector<Contact>& contacts);

  // User indices of bodies: UAVs have their number.
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
  std::vector<MomentumKeeper> keepers;  ///< of the step under way
  const double step_s;
};

PhysicsWorld::Impl::Impl(const TriangleMesh& mesh, double the_step_s) : step_s(the_step_s) {
  world.setGravity(btVector3(0, 0, -kWorldGravity));
  world.setForceUpdateAllAabbs(false);
  world.getDispatchInfo().m_deterministicOverlappingPairs = true;
  world.getSolverInfo().m_numIterations = kSolverIterations;
  solver.setRandSeed(0);
  // Bullet hands its callbacks no context but the shapes and bodies; the bodies' user pointers lead back here.
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
  for (UavBody& uav : uavs) world.removeRigidBody(uav.body.get());
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
  // Bullet refreshes a pair's contact points only when it tests the pair. Skipping is safe as the distances at which
  // it begins are far beyond those at which points are kept.
  const btVector3& centre = uav.body->getWorldTransform().getOrigin();
  if (other.getUserIndex() == kGroundIndex) return centre.z() < uav.radius + kContactReach;
  return other.getUserIndex() != kStructureIndex || near_structure(uav, centre);
}

bool PhysicsWorld::Impl::near_structure(UavBody& uav, const btVector3& centre) const {
  if (uav.clear_at && uav.clear_at->distance2(centre) < uav.room * uav.room) return false;
  const double sphere = uav.radius + kContactReach;
  uav.clear_at.reset();
  uav.room = clearance(*structure_shape, to_eigen(centre), sphere + kLookAround) - sphere;
  if (uav.room > kLeastRoom) uav.clear_at = centre;
  // One test more where there is room again, so that Bullet drops what it remembers.
  return std::exchange(uav.tested, !uav.clear_at) || uav.tested;
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
  keepers.clear();
  for (UavBody& uav : uavs) {
    if (!uav.asleep()) keepers.emplace_back(uav, step_s);
  }
  world.stepSimulation(step_s, 0);
  for (MomentumKeeper& keeper : keepers) keeper.finish();
  for (UavBody& uav : uavs) {
    if (!uav.asleep()) uav.fall_asleep_if_still();
  }
}

BodyId PhysicsWorld::Impl::identify(const btCollisionObject& object) const {
  switch (object.getUserIndex()) {
    case kGroundIndex:
      return {BodyId::Kind::ground, 0};
    case kStructureIndex:
      return {BodyId::Kind::structure, 0};
    default:
      return {BodyId::Kind::uav, static_cast<std::size_t>(object.getUserIndex())};
  }
}

std::vector<Contact> PhysicsWorld::Impl::read_contacts() {
  struct Found {
    Contact contact;
    double distance;
  };
  std::vector<Found> all;
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    BodyId a = identify(*manifold.getBody0()), b = identify(*manifold.getBody1());
    if (a.kind != BodyId::Kind::uav || (b.kind == BodyId::Kind::uav && b.uav < a.uav)) std::swap(a, b);
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold.getContactPoint(i);
      // Bullet also keeps points that are merely near. Two bodies touch when they overlap or push each other.
      if (point.getDistance() > 0.0 && point.getAppliedImpulse() <= 0.0) continue;
      const btVector3 middle = 0.5 * (point.getPositionWorldOnA() + point.getPositionWorldOnB());
      all.push_back({{a.uav, b, to_eigen(middle)}, point.getDistance()});
    }
  }
  const auto key = [](const Found& f) { return std::tuple(f.contact.uav, f.contact.other.kind, f.contact.other.uav); };
  std::stable_sort(all.begin(), all.end(), [&](const Found& x, const Found& y) {
    return key(x) != key(y) ? key(x) < key(y) : x.distance < y.distance;
  });
  all.erase(std::unique(all.begin(), all.end(), [&](const Found& x, const Found& y) { return key(x) == key(y); }),
            all.end());
  std::vector<Contact> contacts;
  for (const Found& found : all) contacts.push_back(found.contact);
  return contacts;
}

void PhysicsWorld::Impl::wake_who_was_hit(const std::vector<Contact>& contacts) {
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
  UavBody uav;
  uav.shape = std::make_unique<VehicleShape>(vehicle);
  uav.radius = bounding_radius(vehicle);
  uav.inertia = vehicle.inertia;
  btRigidBody::btRigidBodyConstructionInfo info(vehicle.mass_kg, nullptr, &uav.shape->compound(),
                                                to_bullet(vehicle.inertia));
  const Quaterniond q_WB(X_WB.linear());
  info.m_startWorldTransform = to_bullet(q_WB, X_WB.translation());
  uav.body = std::make_unique<btRigidBody>(info);
  uav.body->setActivationState(DISABLE_DEACTIVATION);  // UavBody sees to it
  uav.body->setFlags(0);                               // no gyroscopic terms: MomentumKeeper's business
  uav.body->setUserIndex(static_cast<int>(impl_->uavs.size()));
  uav.body->setUserPointer(impl_.get());
  impl_->world.addRigidBody(uav.body.get());
  impl_->uavs.push_back(std::move(uav));
  states_.push_back({.p_WB = X_WB.translation(), .q_WB = q_WB});
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
  probe.setWorldTransform(to_bullet(Quaterniond(X_WB.linear()), X_WB.translation()));
  impl_->world.contactPairTest(&probe, impl_->structure.get(), touch);
  return touch.found;
}

void PhysicsWorld::apply_wrench(std::size_t uav, const Vector3d& force_W, const Vector3d& torque_W) {
  UavBody& pushed = impl_->uavs[uav];
  if (force_W.norm() < kNoWrench && torque_W.norm() < kNoWrench) return;
  if (pushed.asleep()) pushed.wake();
  pushed.pushed = true;
  pushed.body->applyCentralForce(to_bullet(force_W));
  pushed.body->applyTorque(to_bullet(torque_W));
}

void PhysicsWorld::tick() {
  impl_->step();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const btRigidBody& body = *impl_->uavs[i].body;
    const btTransform& X_WB = body.getWorldTransform();
    const btQuaternion q = X_WB.getRotation();
    RigidBodyState& state = states_[i];
    state.p_WB = to_eigen(X_WB.getOrigin());
    state.q_WB = Quaterniond(q.w(), q.x(), q.y(), q.z());
    state.v_WB = to_eigen(body.getLinearVelocity());
    state.w_WB_B = to_eigen(body.getAngularVelocity() * X_WB.getBasis());  // row vector times R is R^T w
  }
  contacts_ = impl_->read_contacts();
  impl_->wake_who_was_hit(contacts_);
}

void PhysicsWorld::set_state(std::size_t uav, const RigidBodyState& state) {
  UavBody& moved = impl_->uavs[uav];
  moved.body->setWorldTransform(to_bullet(state.q_WB, state.p_WB));
  moved.body->setInterpolationWorldTransform(moved.body->getWorldTransform());
  moved.body->setLinearVelocity(to_bullet(state.v_WB));
  moved.body->setAngularVelocity(to_bullet(Vector3d(state.q_WB * state.w_WB_B)));
  moved.body->updateInertiaTensor();
  moved.clear_at.reset();
  moved.wake();
  impl_->broadphase.getOverlappingPairCache()->cleanProxyFromPairs(moved.body->getBroadphaseProxy(),
                                                                   &impl_->dispatcher);
  states_[uav] = state;
}

}  // namespace skein::sim
