#include "sight/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "sight/ray_fan.hpp"
#include "sight/ray_shapes.hpp"

namespace skein::sim {
namespace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

/// Uses one thread, and an instruction set that every x86-64 CPU has: so the search tree is the same every time.
Device make_device(bool native_cpu) {
  std::string config = "threads=1,start_threads=0,set_affinity=0";
  if (!native_cpu) {
    config += ",isa=sse2";
  }
  Device device(rtcNewDevice(config.c_str()));
  if (!device) {
    throw std::runtime_error("Embree does not start, error " + std::to_string(rtcGetDeviceError(nullptr)));
  }
  return device;
}

RTCRayHit ray_query(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float distance_max) {
  RTCRayHit query{};
  query.ray.org_x = origin.x();
  query.ray.org_y = origin.y();
  query.ray.org_z = origin.z();
  query.ray.dir_x = direction.x();
  query.ray.dir_y = direction.y();
  query.ray.dir_z = direction.z();
  query.ray.tfar = distance_max;
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

RTCIntersectContext make_context(RTCIntersectContextFlags flags) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = flags;
  return context;
}

}  // namespace

BodyShape body_shape(const VehicleConfig& vehicle) {
  return {vehicle.collision_box_m, vehicle.arm_m, vehicle.rotor_radius_m, vehicle.rotor_height_m, link_boxes(vehicle)};
}

struct RayScene::Impl {
  /// Plane of a triangle: normal . p = offset.
  struct Plane {
    Vector3d normal = Vector3d::Zero();  ///< unit, or zero for a triangle without area
    double offset = 0.0;
  };

  Device device;
  EmbreeScene scene;
  TriangleMesh mesh;
  RayFan fan{TriangleMesh{}};
  std::vector<Plane> planes;
  std::vector<Body> bodies;
  BodySpheres spheres;

  Impl(const TriangleMesh& structure, const std::vector<BodyShape>& shapes, bool native_cpu)
      : device(make_device(native_cpu)),
        scene(rtcNewScene(device.get())),
        mesh(structure),
        bodies(shapes.begin(), shapes.end()) {
    // Robust: no ray passes between two triangles that share an edge, or through a thin member.
    // Context filter: for before_end().
    rtcSetSceneFlags(scene.get(),
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    if (!mesh.triangles.empty()) add_structure();
    rtcCommitScene(scene.get());
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE) {
      throw std::runtime_error("Embree cannot take the structure, error " + std::to_string(error));
    }
  }

  void add_structure() {
    for (const auto& triangle : mesh.triangles) {
      if (std::ranges::max(triangle) >= mesh.vertices.size()) {
        throw std::runtime_error("a triangle of the structure names vertex " +
                                 std::to_string(std::ranges::max(triangle)) + " of " +
                                 std::to_string(mesh.vertices.size()));
      }
      const auto [a, b, c] = corners(triangle);
      const Vector3d normal = (b - a).cross(c - a).stableNormalized();
      planes.push_back({normal, normal.dot(a)});
    }
    fan = RayFan(mesh);
    const auto geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<Eigen::Vector3f*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Eigen::Vector3f), mesh.vertices.size()));
    auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(mesh.triangles[0]), mesh.triangles.size()));
    if (vertices == nullptr || triangles == nullptr) {
      rtcReleaseGeometry(geometry);
      throw std::runtime_error("Embree has no memory for the structure");
    }
    std::ranges::copy(mesh.vertices, vertices);
    std::ranges::copy(mesh.triangles, triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
  }

  std::array<Vector3d, 3> corners(const std::array<std::uint32_t, 3>& triangle) const {
    return {mesh.vertices[triangle[0]].cast<double>(), mesh.vertices[triangle[1]].cast<double>(),
            mesh.vertices[triangle[2]].cast<double>()};
  }

  /// Distance at which a ray hits a triangle that Embree or the fan has found.
  /// @param ray  rounded to single precision: the ray that Embree or the fan has tested.
  double structure_distance(const Ray& ray, unsigned triangle) const {
    const Plane& plane = planes[triangle];
    const double slope = plane.normal.dot(ray.direction);
    const double height = plane.offset - plane.normal.dot(ray.origin);
    if (std::abs(slope) > 0.01) return std::max(0.0, height / slope);
    // If the ray is almost parallel to the plane, the crossing is ill-conditioned: limit it to the triangle.
    const auto points = corners(mesh.triangles[triangle]);
    std::array<double, 3> along;
    std::ranges::transform(points, along.begin(),
                           [&ray](const Vector3d& p) { return ray.direction.dot(p - ray.origin); });
    const auto [least, most] = std::ranges::minmax(along);
    return std::max(0.0, slope == 0.0 ? least : std::clamp(height / slope, least, most));
  }

  bool takes_part(UavIndex uav, const RayFilter& filter) const {
    return bodies[uav].placed && uav != filter.except_uav && uav != filter.except_other_uav;
  }

  /// The first hit of the structure; nullopt if there is none up to `distance_max`.
  std::optional<Hit> first_structure(const Ray& ray, double distance_max) const {
    const Eigen::Vector3f origin = ray.origin.cast<float>(), direction = ray.direction.cast<float>();
    RTCRayHit query = ray_query(origin, direction, static_cast<float>(distance_max));
    RTCIntersectContext context = make_context(RTC_INTERSECT_CONTEXT_FLAG_NONE);
    rtcIntersect1(scene.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{.distance = structure_distance({origin.cast<double>(), direction.cast<double>()}, query.hit.primID),
               .triangle = query.hit.primID};
  }

  /// The first hit of the ground or a body; nullopt if there is none up to `distance_max`.
  /// @param enough  a hit at less than this distance ends the search, so it need not be the first.
  std::optional<Hit> first_shape(const Ray& ray, double distance_max, const RayFilter& filter,
                                 double enough = 0.0) const {
    Hit nearest{.distance = distance_max};
    bool any = false;
    if (filter.ground) {
      if (const double t = ground_distance(ray); t <= nearest.distance) {
        nearest = {t, HitKind::ground, kNoUav, kNoTriangle};
        any = true;
      }
    }
    const auto meet = [&](UavIndex uav) {
      if (!takes_part(uav, filter)) return;
      const Vector3d offset = bodies[uav].p_WB - ray.origin;
      const double reach = bodies[uav].radius;
      const double along = std::clamp(offset.dot(ray.direction), 0.0, nearest.distance);
      if ((offset - along * ray.direction).squaredNorm() > reach * reach) return;
      if (const double t = bodies[uav].distance(ray); t <= nearest.distance) {
        nearest = {t, HitKind::uav, uav, kNoTriangle};
        any = true;
      }
    };
    const auto meet_all = [&](const auto& uavs) {
      for (auto uav = uavs.begin(); uav != uavs.end() && nearest.distance >= enough; ++uav) meet(*uav);
    };
    if (filter.uavs && filter.among) {
      meet_all(*filter.among);
    } else if (filter.uavs) {
      meet_all(FirstUavs(bodies.size()));
    }
    return any ? std::optional(nearest) : std::nullopt;
  }

  std::optional<Hit> first_hit(const Ray& ray, double distance_max, const RayFilter& filter,
                               double enough = 0.0) const {
    const auto shape = first_shape(ray, distance_max, filter, enough);
    if (shape && shape->distance < enough) return shape;
    const auto structure = first_structure(ray, shape ? shape->distance : distance_max);
    return structure ? structure : shape;
  }

  /// State of the Embree filter of before_end() along a ray.
  struct Crossings {
    RTCIntersectContext context;  ///< must be the first member: the filter casts its address to Crossings
    const Impl* impl;
    Eigen::Vector3f origin, direction;
    float length, nearest;
  };

  /// Embree filter, called for each triangle on the ray: tests the triangle and rejects it, so that the search goes on.
  static void try_crossing(const RTCFilterFunctionNArguments* args) {
    auto& crossings = *reinterpret_cast<Crossings*>(args->context);
    const auto& triangle = crossings.impl->mesh.triangles[RTCHitN_primID(args->hit, args->N, 0)];
    const auto& vertices = crossings.impl->mesh.vertices;
    const float t = crossing_distance(crossings.origin, crossings.direction,
                                      {vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]});
    if (t < crossings.length) crossings.nearest = std::min(crossings.nearest, t);
    args->valid[0] = 0;
  }

  /// Distance of the first hit of the structure alone that is less than `length`; infinity if there is none.
  float before_end(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float length) const {
    constexpr float kReach = 0.05F;  // beyond the end: Embree must find all triangles whose float distance may be less
    Crossings crossings{make_context(RTC_INTERSECT_CONTEXT_FLAG_NONE), this, origin, direction, length,
                        std::numeric_limits<float>::infinity()};
    crossings.context.filter = &Impl::try_crossing;
    RTCRayHit query = ray_query(origin, direction, length + kReach);
    rtcIntersect1(scene.get(), &crossings.context, &query);
    return crossings.nearest;
  }

  /// Distances to the structure or the ground. The ground limits the length of a ray before it is traced.
  void scan_structure(const Vector3d& origin, std::span<const Eigen::Vector3f> directions, std::size_t columns,
                      double distance_max, bool ground, std::span<double> distances) const {
    std::vector<float> reaches(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double t = ground ? ground_distance({origin, directions[i].cast<double>()}) : kInfinity;
      distances[i] = t <= distance_max ? t : kInfinity;
      reaches[i] = static_cast<float>(std::min(t, distance_max));
    }
    const Eigen::Vector3f rounded_origin = origin.cast<float>();
    std::vector<std::uint32_t> triangles(directions.size());
    fan.trace(rounded_origin, directions, columns, reaches, triangles);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (triangles[i] == RayFan::kNothing) continue;
      distances[i] = structure_distance({rounded_origin.cast<double>(), directions[i].cast<double>()}, triangles[i]);
    }
  }

  bool surely_blocked_by(std::uint32_t triangle, const Vector3d& from, const Vector3d& to, double distance_max) const {
    const auto [a, b, c] = corners(mesh.triangles[triangle]);
    const Vector3d normal = (b - a).cross(c - a), way = to - from;
    const double area2 = normal.norm(), length = way.norm();
    const double slope = normal.dot(way);  // area2 * length * sine of the angle between plane and ray
    const double share = normal.dot(a - from) / slope;
    // Rays are rounded to single precision: 0.1 mm at 100 m is a generous bound of the error.
    constexpr double kLeastSine = 0.02, kInside = 1e-4 / kLeastSine;
    if (!(std::abs(slope) > kLeastSine * area2 * length && share > 0.0)) return false;
    const double distance = share * length;
    if (distance < kInside || distance > distance_max - kInside) return false;
    const Vector3d p = from + share * way;
    const auto inside = [&](const Vector3d& start, const Vector3d& end) {
      return normal.dot((end - start).cross(p - start)) > kInside * (end - start).norm() * area2;
    };
    return inside(a, b) && inside(b, c) && inside(c, a);
  }

  /// Shortens the distances of the rays that hit this body.
  void scan_body(const Body& body, const Vector3d& origin, std::span<const Eigen::Vector3f> directions,
                 double distance_max, std::span<double> distances) const {
    const Vector3d offset = body.p_WB - origin;
    const double far = offset.norm();
    if (far - body.radius > distance_max) return;
    // Rays outside the cone around the body cannot hit it. If the origin is inside the body's sphere, all rays may.
    const double tangent2 = far * far - body.radius * body.radius;
    const float least_along =
        tangent2 > 0.0 ? static_cast<float>(std::sqrt(tangent2)) * 0.9999F : -std::numeric_limits<float>::infinity();
    const Eigen::Vector3f towards = offset.cast<float>();
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (directions[i].dot(towards) >= least_along) {
        const double t = body.distance({origin, directions[i].cast<double>()});
        if (t <= distance_max) {
          distances[i] = std::min(distances[i], t);
        }
      }
    }
  }

  /// State of a closest-point query.
  struct Nearest {
    const Impl* impl;
    Vector3d p;
    double squared;
  };

  static bool visit_triangle(RTCPointQueryFunctionArguments* args) {
    auto& nearest = *static_cast<Nearest*>(args->userPtr);
    const Plane& plane = nearest.impl->planes[args->primID];
    const double height = plane.normal.dot(nearest.p) - plane.offset;
    if (height * height >= nearest.squared) return false;
    const auto [a, b, c] = nearest.impl->corners(nearest.impl->mesh.triangles[args->primID]);
    const double squared = squared_distance(nearest.p, a, b, c);
    if (squared >= nearest.squared) return false;
    nearest.squared = squared;
    args->query->radius = static_cast<float>(std::sqrt(squared)) * 1.000001F;
    return true;
  }
};

RayScene::RayScene(const TriangleMesh& mesh, std::vector<BodyShape> bodies, bool native_cpu)
    : impl_(std::make_unique<Impl>(mesh, bodies, native_cpu)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::set_pose(UavIndex uav, const Isometry3d& X_WB) {
  Body& body = impl_->bodies.at(uav);
  body.placed = true;
  body.X_BW = X_WB.inverse();
  body.p_WB = X_WB.translation();
  impl_->spheres.set(uav, body.p_WB, body.radius);
}

const BodySpheres& RayScene::body_spheres() const { return impl_->spheres; }

std::optional<Hit> RayScene::first_hit(const Vector3d& p_W, const Vector3d& direction_W, double distance_max,
                                       const RayFilter& filter) const {
  return first_hit_or_blocker(p_W, direction_W, distance_max, 0.0, filter);
}

std::optional<Hit> RayScene::first_hit_or_blocker(const Vector3d& p_W, const Vector3d& direction_W, double distance_max,
                                                  double enough, const RayFilter& filter) const {
  const double length = direction_W.norm();
  if (!(length > 0.0)) return std::nullopt;
  return impl_->first_hit({p_W, direction_W / length}, distance_max, filter, enough);
}

std::optional<double> RayScene::first_hit_distance(const Vector3d& from_W, const Vector3d& to_W,
                                                   const RayFilter& filter) const {
  const auto hit = first_hit(from_W, to_W - from_W, (to_W - from_W).norm(), filter);
  return hit ? std::optional(hit->distance) : std::nullopt;
}

std::optional<RayScene::HitBeforeEnd> RayScene::first_hit_before_end(const Vector3d& from_W, const Vector3d& to_W,
                                                                     const RayFilter& filter) const {
  // Origin, direction and length are rounded separately. Rounding moves the origin but does not adapt the length: this
  // mostly decides whether a surface at the end is hit.
  const Ray ray{from_W, (to_W - from_W).normalized()};
  const auto length = static_cast<float>((to_W - from_W).norm());
  if (!(length > 0.0F)) return std::nullopt;
  float nearest = impl_->before_end(ray.origin.cast<float>(), ray.direction.cast<float>(), length);
  if (const auto shape = impl_->first_shape(ray, length, filter)) {
    nearest = std::min(nearest, static_cast<float>(shape->distance));
  }
  return nearest < length ? std::optional(HitBeforeEnd{nearest, length}) : std::nullopt;
}

bool RayScene::surely_blocked_by(std::uint32_t triangle, const Vector3d& from_W, const Vector3d& to_W,
                                 double distance_max) const {
  return triangle != kNoTriangle && impl_->surely_blocked_by(triangle, from_W, to_W, distance_max);
}

void RayScene::scan(const Vector3d& p_W, std::span<const Eigen::Vector3f> directions_W, std::size_t columns,
                    double distance_max, const RayFilter& filter, std::span<double> distances) const {
  if (distances.size() != directions_W.size()) {
    throw std::invalid_argument("RayScene::scan: one distance for each direction");
  }
  if (columns == 0 || directions_W.size() % columns != 0) {
    throw std::invalid_argument("RayScene::scan: the directions make no whole rows");
  }
  impl_->scan_structure(p_W, directions_W, columns, distance_max, filter.ground, distances);
  for (const UavIndex uav : FirstUavs(filter.uavs ? impl_->bodies.size() : 0)) {
    if (impl_->takes_part(uav, filter)) {
      impl_->scan_body(impl_->bodies[uav], p_W, directions_W, distance_max, distances);
    }
  }
}

double RayScene::clearance(const Vector3d& p_W, double distance_max) const {
  if (impl_->mesh.triangles.empty()) return kInfinity;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  RTCPointQuery query{};
  query.x = static_cast<float>(p_W.x());
  query.y = static_cast<float>(p_W.y());
  query.z = static_cast<float>(p_W.z());
  query.radius = static_cast<float>(distance_max);
  Impl::Nearest nearest{impl_.get(), p_W, distance_max * distance_max};
  rtcPointQuery(impl_->scene.get(), &query, &context, &Impl::visit_triangle, &nearest);
  return nearest.squared < distance_max * distance_max ? std::sqrt(nearest.squared) : kInfinity;
}

}  // namespace skein::sim
