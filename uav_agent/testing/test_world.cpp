#include "uav_agent/testing/test_world.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/math/euler.hpp"
#include "uav_agent/onboard/agent.hpp"
#include "uav_agent/planning/strips.hpp"
#include "uav_agent/testing/test_lidar.hpp"

namespace skein::agent {
namespace {

constexpr double kDtS = 0.05;
constexpr double kOnGroundM = 0.16;  ///< height of the centre of a UAV on the ground
constexpr double kLidarRangeM = 40.0;
constexpr double kSurfaceStepM = 0.8;
constexpr std::uint64_t kKeyFrameSteps = 20, kCameraSteps = 4;

double distance_to(const OrientedBox& box, const Vector3d& p_W) {
  const Vector3d p = (box.R_WO.transpose() * (p_W - box.center)).cwiseAbs() - 0.5 * box.size;
  return p.cwiseMax(0.0).norm();
}

/// Whether the open segment passes through the box (its inside, so that surface points can be seen).
bool hits(const OrientedBox& box, const Vector3d& a_W, const Vector3d& b_W) {
  const Vector3d a = box.R_WO.transpose() * (a_W - box.center), b = box.R_WO.transpose() * (b_W - box.center);
  double enter = 0.0, leave = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double half = 0.5 * box.size[i] - 0.02, d = b[i] - a[i];
    if (std::abs(d) < 1e-12) {
      if (std::abs(a[i]) > half) return false;
      continue;
    }
    const double t1 = (-half - a[i]) / d, t2 = (half - a[i]) / d;
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  }
  return enter < leave;
}

struct SurfacePoint {
  Vector3d p_W, n_W;
  bool seen = false;
};

std::vector<SurfacePoint> sample_surface(const std::vector<OrientedBox>& solids) {
  std::vector<SurfacePoint> points;
  for (const OrientedBox& box : solids) {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, w = (axis + 2) % 3;
      for (const double sign : {-1.0, 1.0}) {
        for (double a = -0.5 * box.size[u] + 0.3; a < 0.5 * box.size[u]; a += kSurfaceStepM) {
          for (double b = -0.5 * box.size[w] + 0.3; b < 0.5 * box.size[w]; b += kSurfaceStepM) {
            Vector3d p;
            p[axis] = sign * 0.5 * box.size[axis];
            p[u] = a;
            p[w] = b;
            const Vector3d p_W = box.center + box.R_WO * p;
            const bool hidden = std::any_of(solids.begin(), solids.end(), [&](const OrientedBox& other) {
              return &other != &box && other.contains(p_W, 0.1);
            });
            if (p_W.z() > 0.2 && !hidden) points.push_back({p_W, sign * box.R_WO.col(axis)});
          }
        }
      }
    }
  }
  return points;
}

struct Uav {
  Uav(const AgentConfig& c, const std::string& p) : planner(p), agent(c, make_planner(p, c)), config(c) {
    state.p_WB = c.me().p_WB_start + Vector3d(0.0, 0.0, kOnGroundM);
    if (agent.wants_beams()) lidar.emplace(*c.vehicle.lidar);
  }

  std::string planner;
  Agent agent;
  AgentConfig config;
  std::optional<TestLidar> lidar;  ///< if the agent asks for beams
  RigidBodyState state;
  GimbalState gimbal;
  double highest_m = 0.0;
  std::uint64_t captures = 0;
  std::vector<std::uint64_t> acks;
  std::vector<RadioMessage> mail;  ///< to be delivered at the next step
  std::size_t undelivered = 0;
};

}  // namespace

OrientedBox make_box(const Vector3d& centre, const Vector3d& size, double yaw) {
  OrientedBox box;
  box.center = centre;
  box.size = size;
  box.R_WO = rotation_z(yaw);
  return box;
}

TestScene two_towers() {
  TestScene scene;
  scene.solids = {make_box({0.0, 12.0, 14.0}, {16.0, 8.0, 28.0}), make_box({30.0, 14.0, 12.0}, {14.0, 10.0, 24.0}, 0.3),
                  make_box({14.0, 2.0, 2.0}, {8.0, 6.0, 4.0})};
  for (std::size_t i = 0; i < 2; ++i) {
    OrientedBox loose = scene.solids[i];
    loose.center.z() += 1.5;
    loose.size += Vector3d(3.0, 5.0, 1.0);
    scene.boxes.push_back(loose);
  }
  return scene;
}

TestScene many_boxes(int count) {
  TestScene scene;
  for (int i = 0; i < count; ++i) {
    const Vector3d centre(14.0 * (i % 5), 14.0 * (i / 5), 6.0 + i % 4);
    scene.solids.push_back(make_box(centre, {4.0, 4.0, 2.0 * centre.z()}, 0.2 * i));
    scene.boxes.push_back(make_box(centre + Vector3d(0.0, 0.0, 0.5), {5.0, 5.0, 2.0 * centre.z() + 1.0}, 0.2 * i));
  }
  return scene;
}

std::vector<TestUav> test_fleet(std::size_t count) {
  std::vector<TestUav> fleet;
  for (std::size_t i = 0; i < count; ++i) {
    fleet.push_back({"uav" + std::to_string(i),
                     i % 2 == 0 ? Role::explorer : Role::photographer,
                     {3.0 * static_cast<double>(i) - 8.0, -14.0}});
  }
  return fleet;
}

struct TestWorld::Impl {
  Impl(TestScene s, double d) : scene(std::move(s)), surface(sample_surface(scene.solids)), duration_s(d) {}

  bool in_sight(const Vector3d& a, const Vector3d& b) const {
    return std::none_of(scene.solids.begin(), scene.solids.end(),
                        [&](const OrientedBox& box) { return hits(box, a, b); });
  }
  std::vector<Eigen::Vector3f> scan(const Vector3d& p_W) const {
    std::vector<Eigen::Vector3f> points;
    for (const SurfacePoint& point : surface) {
      if ((point.p_W - p_W).norm() < kLidarRangeM && in_sight(p_W, point.p_W))
        points.push_back(point.p_W.cast<float>());
    }
    for (double x = -24.0; x <= 24.0; x += 3.0) {  // the ground
      for (double y = -24.0; y <= 24.0; y += 3.0) {
        const Vector3d ground(p_W.x() + x, p_W.y() + y, 0.0);
        if (in_sight(p_W, ground)) points.push_back(ground.cast<float>());
      }
    }
    return points;
  }
  void photograph(const Uav& uav) {
    const CameraReach reach = camera_reach(uav.config.vehicle.camera, uav.config.desired_mm_per_pixel);
    const double yaw = roll_pitch_yaw(uav.state.q_WB.toRotationMatrix()).yaw;
    const Matrix3d R_CW = (rotation_z(yaw + uav.gimbal.yaw) * rotation_y(uav.gimbal.pitch)).transpose();
    for (SurfacePoint& point : surface) {
      if (point.seen || (point.p_W - uav.state.p_WB).norm() > 14.0) continue;
      const Vector3d p_C = R_CW * (point.p_W - uav.state.p_WB);
      const bool framed = p_C.x() > 0.5 && p_C.x() < 1.25 * reach.sharp_distance_m &&
                          std::abs(p_C.y()) < reach.half_width_slope * p_C.x() &&
                          std::abs(p_C.z()) < reach.half_height_slope * p_C.x();
      const bool facing = point.n_W.dot(uav.state.p_WB - point.p_W) > 0.0;
      point.seen = framed && facing && in_sight(uav.state.p_WB, point.p_W);
    }
  }
  void mix(double value) { fingerprint = (fingerprint ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ULL; }

  AgentInput sense(std::size_t i, const std::vector<std::vector<Eigen::Vector3f>>& scans) const;
  void deliver_radio(const std::vector<AgentOutput>& outputs);
  void move(Uav& uav, const AgentOutput& output);
  void step();

  TestScene scene;
  std::vector<SurfacePoint> surface;
  double duration_s;
  std::vector<Uav> uavs;
  std::uint64_t k = 0, fingerprint = 14695981039346656037ULL;
  double clearance = 1e9, separation = 1e9, gap = 1e9;
  std::size_t bad_commands = 0, longest_message = 0;
};

AgentInput TestWorld::Impl::sense(std::size_t i, const std::vector<std::vector<Eigen::Vector3f>>& scans) const {
  const Uav& uav = uavs[i];
  AgentInput input;
  input.k = k;
  input.tick = static_cast<Tick>(k) * ticks(kDtS);
  input.state = uav.state;
  input.gimbal = uav.gimbal;
  const double now = static_cast<double>(k) * kDtS;
  if (k > 20) input.mission_remaining_s = duration_s - now;
  if (now >= scene.boxes_at_s && k % 100 == 0) input.boxes = scene.boxes;
  const auto link = [&](Node node, const Vector3d& p, const Vector3d& v) {
    if (scene.radio && in_sight(uav.state.p_WB, p)) input.neighbours.push_back({node, p, v});
  };
  link(kStationNode, scene.station, Vector3d::Zero());
  for (std::size_t j = 0; j < uavs.size(); ++j) {
    if (j != i) link(node_of_uav(UavIndex(j)), uavs[j].state.p_WB, uavs[j].state.v_WB);
  }
  if (!scans[i].empty()) input.key_frames.push_back({.points_W = scans[i], .source = node_of_uav(UavIndex(i))});
  for (const Neighbour& neighbour : input.neighbours) {
    if (neighbour.node == kStationNode || scans[neighbour.node - 1].empty()) continue;
    input.key_frames.push_back({.points_W = scans[neighbour.node - 1], .source = neighbour.node});
  }
  if (uav.lidar && uav.lidar->due(input.tick)) {
    input.servos.push_back(uav.lidar->servo(input.tick));
    input.scans.push_back(uav.lidar->scan(input.tick, uav.state.X_WB(), scene.solids));
  }
  if (k % 40 == 0) input.capture_reports.push_back({.capture = uav.captures, .bytes = 200});
  input.capture_acks = uav.acks;
  input.radio = uav.mail;
  return input;
}

void TestWorld::Impl::move(Uav& uav, const AgentOutput& output) {
  if (output.trajectory) {
    const TrajectoryCommand& command = *output.trajectory;
    const VehicleConfig& vehicle = uav.config.vehicle;
    const bool finite = command.p_WB.allFinite() && command.v_WB.allFinite() && command.a_WB.allFinite() &&
                        std::isfinite(command.yaw) && std::isfinite(command.yaw_rate);
    const bool within = command.v_WB.norm() <= vehicle.max_speed_mps + 1e-6 &&
                        command.a_WB.norm() <= vehicle.max_acceleration_mps2 + 1e-6;
    if (!finite || !within) ++bad_commands;
  }
  if (output.gimbal && !(std::isfinite(output.gimbal->pitch) && std::isfinite(output.gimbal->yaw))) ++bad_commands;
  if (output.trajectory) {
    uav.state.p_WB = output.trajectory->p_WB;
    uav.state.p_WB.z() = std::max(uav.state.p_WB.z(), kOnGroundM);
    uav.state.v_WB = output.trajectory->v_WB;
    uav.state.q_WB = Eigen::AngleAxisd(output.trajectory->yaw, Vector3d::UnitZ());
  }
  if (output.gimbal) {
    uav.gimbal.pitch = output.gimbal->pitch;
    uav.gimbal.yaw = output.gimbal->yaw;
  }
  if (k % 40 == 0) {
    ++uav.captures;
    ++uav.undelivered;
  }
  uav.undelivered -= uav.acks.size();
  uav.acks.clear();
  uav.acks.insert(uav.acks.end(), output.captures.begin(), output.captures.end());
  uav.highest_m = std::max(uav.highest_m, uav.state.p_WB.z());
  for (int i = 0; i < 3; ++i) mix(uav.state.p_WB[i]);
  mix(uav.gimbal.yaw);
}

/// Each UAV in line of sight receives all messages at the next step.
void TestWorld::Impl::deliver_radio(const std::vector<AgentOutput>& outputs) {
  for (std::size_t to = 0; to < uavs.size(); ++to) {
    uavs[to].mail.clear();
    for (std::size_t from = 0; from < uavs.size() && scene.radio; ++from) {
      for (const RadioMessage& message : outputs[from].radio) {
        longest_message = std::max(longest_message, message.text.size());
      }
      if (from == to || !scene.talk || !in_sight(uavs[from].state.p_WB, uavs[to].state.p_WB)) continue;
      uavs[to].mail.insert(uavs[to].mail.end(), outputs[from].radio.begin(), outputs[from].radio.end());
    }
  }
}

void TestWorld::Impl::step() {
  std::vector<std::vector<Eigen::Vector3f>> scans(uavs.size());
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    if (uavs[i].config.me().role == Role::explorer && k % kKeyFrameSteps == 0) scans[i] = scan(uavs[i].state.p_WB);
  }
  std::vector<AgentOutput> outputs;
  for (std::size_t i = 0; i < uavs.size(); ++i) outputs.push_back(uavs[i].agent.step(sense(i, scans)));
  deliver_radio(outputs);
  for (std::size_t i = 0; i < uavs.size(); ++i) move(uavs[i], outputs[i]);
  ++k;
  for (std::size_t i = 0; i < uavs.size(); ++i) {
    const Vector3d p = uavs[i].state.p_WB;
    if (p.z() < 0.5) continue;
    for (const OrientedBox& solid : scene.solids) clearance = std::min(clearance, distance_to(solid, p));
    for (std::size_t j = 0; j < i; ++j) {
      if (uavs[j].state.p_WB.z() <= 0.5) continue;
      const double apart = (p - uavs[j].state.p_WB).norm();
      separation = std::min(separation, apart);
      gap = std::min(gap, apart - uavs[i].config.me().body_radius_m - uavs[j].config.me().body_radius_m);
    }
    if (k % kCameraSteps == 0) photograph(uavs[i]);
  }
}

TestWorld::TestWorld(TestScene scene, const std::vector<TestUav>& fleet, const std::string& planner, double duration_s)
    : impl_(std::make_unique<Impl>(std::move(scene), duration_s)) {
  AgentConfig config;
  config.duration_s = duration_s;
  config.station_position = impl_->scene.station;
  for (const TestUav& uav : fleet) {
    config.fleet.push_back({uav.name, uav.role, Vector3d(uav.start.x(), uav.start.y(), 0.0),
                            uav.role == Role::explorer ? kExplorerRadiusM : kPhotographerRadiusM});
  }
  for (const UavIndex self : FirstUavs(fleet.size())) {
    config.self = self;
    config.vehicle.role = config.me().role;
    config.vehicle.lidar.reset();
    if (config.me().role == Role::explorer) config.vehicle.lidar.emplace();
    impl_->uavs.emplace_back(config, planner);
  }
}

TestWorld::~TestWorld() = default;

void TestWorld::run(double seconds_to_run) {
  const auto steps = static_cast<std::uint64_t>(seconds_to_run / kDtS);
  for (std::uint64_t i = 0; i < steps; ++i) impl_->step();
}

std::uint64_t TestWorld::doubtful_scans() const {
  std::uint64_t count = 0;
  for (const Uav& uav : impl_->uavs) {
    for (const ScanDoubt doubt : {ScanDoubt::no_servo, ScanDoubt::no_pose, ScanDoubt::misfit}) {
      count += uav.agent.beam_scans(doubt);
    }
  }
  return count;
}

void TestWorld::time_parts(const WorkParts::Clock& clock) {
  for (Uav& uav : impl_->uavs) uav.agent.time_parts(clock);
}

const WorkParts& TestWorld::parts(std::size_t uav) const { return *impl_->uavs.at(uav).agent.parts(); }

void TestWorld::restart(std::size_t uav) {
  Uav& again = impl_->uavs.at(uav);
  again.agent = Agent(again.config, make_planner(again.planner, again.config));
}

std::size_t TestWorld::bad_commands() const { return impl_->bad_commands; }
std::size_t TestWorld::longest_message() const { return impl_->longest_message; }
std::uint64_t TestWorld::fingerprint() const { return impl_->fingerprint; }
double TestWorld::clearance() const { return impl_->clearance; }
double TestWorld::separation() const { return impl_->separation; }
double TestWorld::gap() const { return impl_->gap; }
double TestWorld::highest_m(std::size_t uav) const { return impl_->uavs.at(uav).highest_m; }
Vector3d TestWorld::position(std::size_t uav) const { return impl_->uavs.at(uav).state.p_WB; }

double TestWorld::coverage() const {
  // Counts the structure in the boxes, except below 5 m, where UAVs cannot fly.
  double seen = 0.0, all = 0.0;
  for (const SurfacePoint& point : impl_->surface) {
    const bool inspected = std::any_of(impl_->scene.boxes.begin(), impl_->scene.boxes.end(),
                                       [&](const OrientedBox& box) { return box.contains(point.p_W); });
    if (!inspected || point.p_W.z() < 5.0) continue;
    all += 1.0;
    seen += point.seen;
  }
  return all > 0.0 ? seen / all : 0.0;
}

std::size_t TestWorld::undelivered() const {
  std::size_t count = 0;
  for (const Uav& uav : impl_->uavs) count += uav.undelivered;
  return count;
}

}  // namespace skein::agent
