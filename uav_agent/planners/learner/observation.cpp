#include "uav_agent/planners/learner/observation.hpp"

#include <algorithm>
#include <cmath>

#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {
namespace {

constexpr double kAirborneM = 0.5;   ///< height above the start from which a UAV counts as airborne; chosen
constexpr double kRoundingM = 1e-6;  ///< a cube that reaches less far into a cell is not in it; numeric
constexpr std::int8_t kUnknown = -1, kFree = 0, kOccupied = 1;  // values of a map cell
// Values of `goal`. Format: docs/python.md.
constexpr std::int8_t kNoGoal = 0, kFlying = 1, kReached = 2, kNoWay = 3, kBlocked = 4;
constexpr double kNever = -1.0;  ///< age of something that has not happened yet; format: docs/python.md
/// Lengths of rows. Format: docs/python.md.
constexpr std::size_t kQuaternionNumbers = 4, kGimbalNumbers = 4, kDetectionNumbers = 5;
constexpr std::size_t kBoxNumbers = 3 + 3 + kQuaternionNumbers;  ///< centre, size, attitude; format: docs/python.md

void put(std::span<double> to, const auto& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[static_cast<Eigen::Index>(i)];
}

}  // namespace

void Observation::lay_out(BlockLayout& layout, const std::string& prefix) {
  const std::size_t mates = agent_.fleet.size() - 1, detections = static_cast<std::size_t>(config_.detections);
  time_s_ = layout.add<double>(prefix + "time_s");
  time_left_s_ = layout.add<double>(prefix + "time_left_s");
  position_ = layout.add<double>(prefix + "position", {3});
  velocity_ = layout.add<double>(prefix + "velocity", {3});
  attitude_ = layout.add<double>(prefix + "attitude", {kQuaternionNumbers});
  angular_velocity_ = layout.add<double>(prefix + "angular_velocity", {3});
  airborne_ = layout.add<std::int8_t>(prefix + "airborne");
  gimbal_ = layout.add<double>(prefix + "gimbal", {kGimbalNumbers});
  box_count_ = layout.add<std::int64_t>(prefix + "box_count");
  boxes_ = layout.add<double>(prefix + "boxes", {kMostBoxes, kBoxNumbers});
  peers_ = layout.add<double>(prefix + "peers", {mates, 3});
  peer_velocities_ = layout.add<double>(prefix + "peer_velocities", {mates, 3});
  peer_ages_s_ = layout.add<double>(prefix + "peer_ages_s", {mates});
  peers_linked_ = layout.add<std::int8_t>(prefix + "peers_linked", {mates});
  linked_ = layout.add<std::int8_t>(prefix + "linked");
  undelivered_ = layout.add<std::int64_t>(prefix + "undelivered");
  detection_count_ = layout.add<std::int64_t>(prefix + "detection_count");
  detections_ = layout.add<double>(prefix + "detections", {detections, kDetectionNumbers});
  goal_ = layout.add<std::int8_t>(prefix + "goal");
  map_origin_ = layout.add<double>(prefix + "map_origin", {3});
  map_ = layout.add<std::int8_t>(prefix + "map",
                                 {static_cast<std::size_t>(config_.map_x), static_cast<std::size_t>(config_.map_y),
                                  static_cast<std::size_t>(config_.map_z)});
  const auto& lidar = agent_.vehicle.lidar;
  const std::size_t beams = config_.scans && lidar ? static_cast<std::size_t>(lidar->rings * lidar->columns) : 0;
  scan_age_s_ = layout.add<double>(prefix + "scan_age_s");
  scan_points_ = layout.add<std::int64_t>(prefix + "scan_points");
  scan_ = layout.add<float>(prefix + "scan", {beams, 3});
}

void Observation::use(std::byte* block) {
  block_ = block;
  std::ranges::fill(map_.in(block_), kUnknown);
  window_.reset();
}

void Observation::note(const PlannerInput& in) {
  for (const DetectedPoint& point : in.detected) detected_.push_back(point);
  detected_since_ += static_cast<std::int64_t>(in.detected.size());
  while (detected_.size() > static_cast<std::size_t>(config_.detections)) detected_.pop_front();
  for (const Outcome& outcome : in.flight.outcomes) {
    outcome_ = outcome.kind;
    has_outcome_ = true;
  }
  if (in.scans.empty() || scan_.size == 0) return;
  const Scan& scan = in.scans.back();
  scan_tick_ = scan.tick;
  const auto to = scan_.in(block_);
  const std::size_t count = std::min(scan.points_W.size(), to.size() / 3);
  for (std::size_t i = 0; i < count; ++i) std::copy_n(scan.points_W[i].data(), 3, &to[3 * i]);
  std::fill(to.begin() + static_cast<std::ptrdiff_t>(3 * count), to.end(), 0.0F);
  scan_points_.in(block_)[0] = static_cast<std::int64_t>(count);
}

void Observation::write(const PlannerInput& in) {
  time_s_.in(block_)[0] = seconds(in.tick);
  time_left_s_.in(block_)[0] = in.mission_remaining_s.value_or(agent_.duration_s);
  put(position_.in(block_), in.state.p_WB);
  put(velocity_.in(block_), in.state.v_WB);
  const Quaterniond& q = in.state.q_WB;
  put(attitude_.in(block_), Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
  put(angular_velocity_.in(block_), in.state.w_WB_B);
  airborne_.in(block_)[0] = in.state.p_WB.z() > agent_.me().p_WB_start.z() + kAirborneM ? 1 : 0;
  put(gimbal_.in(block_), Eigen::Vector4d(in.gimbal.pitch, in.gimbal.yaw, in.gimbal.pitch_rate, in.gimbal.yaw_rate));
  linked_.in(block_)[0] = in.station_linked ? 1 : 0;
  undelivered_.in(block_)[0] = static_cast<std::int64_t>(in.undelivered_captures);
  scan_age_s_.in(block_)[0] = scan_tick_ ? seconds(in.tick - *scan_tick_) : kNever;
  write_peers(in);
  write_boxes(in);
  write_detections();
  write_flight(in);
  write_map(in);
}

void Observation::write_peers(const PlannerInput& in) {
  const std::vector<Peer>& peers = in.peers.all();
  const auto places = peers_.in(block_), velocities = peer_velocities_.in(block_), ages = peer_ages_s_.in(block_);
  for (std::size_t i = 0; i < std::min(peers.size(), ages.size()); ++i) {
    put(places.subspan(3 * i, 3), peers[i].p_W);
    put(velocities.subspan(3 * i, 3), peers[i].v_W);
    ages[i] = peers[i].seen ? seconds(in.tick - *peers[i].seen) : kNever;
    peers_linked_.in(block_)[i] = peers[i].visible ? 1 : 0;
  }
}

void Observation::write_boxes(const PlannerInput& in) {
  if (in.boxes.size() == boxes_written_) return;  // all boxes arrive at once
  boxes_written_ = in.boxes.size();
  const std::size_t count = std::min(in.boxes.size(), kMostBoxes);
  box_count_.in(block_)[0] = static_cast<std::int64_t>(count);
  const auto rows = boxes_.in(block_);
  for (std::size_t i = 0; i < count; ++i) {
    const OrientedBox& box = in.boxes[i];
    const Quaterniond q(box.R_WO);
    const auto row = rows.subspan(kBoxNumbers * i, kBoxNumbers);
    put(row.first(3), box.center);
    put(row.subspan(3, 3), box.size);
    put(row.last(kQuaternionNumbers), Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
  }
}

/// The newest detection comes last; unused rows are zero.
void Observation::write_detections() {
  const auto rows = detections_.in(block_);
  std::size_t at = 0;
  for (const DetectedPoint& point : detected_) {
    for (int i = 0; i < 3; ++i) rows[at++] = static_cast<double>(point.p_W[i]);
    rows[at++] = point.score;
    rows[at++] = static_cast<double>(point.order);
  }
  std::fill(rows.begin() + static_cast<std::ptrdiff_t>(at), rows.end(), 0.0);
  detection_count_.in(block_)[0] = detected_since_;
  detected_.clear();
  detected_since_ = 0;
}

void Observation::write_flight(const PlannerInput& in) {
  std::int8_t state = kNoGoal;
  if (in.flight.goal) {
    state = kFlying;
  } else if (has_outcome_) {
    state = outcome_ == Outcome::Kind::reached ? kReached : outcome_ == Outcome::Kind::no_way ? kNoWay : kBlocked;
  }
  goal_.in(block_)[0] = state;
}

// ---- the window of the map --------------------------------------------------------------------------------------

std::size_t Observation::map_index(const Eigen::Vector3i& cell) const {
  return static_cast<std::size_t>((cell.x() * config_.map_y + cell.y()) * config_.map_z + cell.z());
}

/// A number that changes whenever the map changes in the window whose lowest cell is `from`.
std::uint64_t Observation::state_of_map(const PlannerInput& in, const Eigen::Vector3i& from) const {
  if (in.world_map == nullptr) return in.map.key_frames();
  const double region_m = in.world_map->config().cell_m * WorldMap::kChunk * WorldMap::kRegion;
  const auto region_of = [&](const Eigen::Vector3i& cell) {
    return Eigen::Vector3i((cell.cast<double>() * (config_.map_cell_m / region_m)).array().floor().cast<int>());
  };
  const Eigen::Vector3i first = region_of(from), last = region_of(from + window());
  std::uint64_t newest = 0;
  for (int x = first.x(); x <= last.x(); ++x) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int z = first.z(); z <= last.z(); ++z) {
        newest = std::max(newest, in.world_map->region_changed_at({x, y, z}));
      }
    }
  }
  return newest;
}

/// The window consists of cells of a grid that is fixed in W; the UAV is in the middle cell.
void Observation::write_map(const PlannerInput& in) {
  if (map_.size == 0) return;
  const Eigen::Vector3i at((in.state.p_WB / config_.map_cell_m).array().floor().cast<int>());
  const Eigen::Vector3i from = at - window() / 2;
  const Window now{from, state_of_map(in, from)};
  if (window_ == now) return;
  window_ = now;
  put(map_origin_.in(block_), Vector3d(from.cast<double>() * config_.map_cell_m));
  in.world_map != nullptr ? write_cells(*in.world_map, from) : write_cells(in.map, from);
}

/// A cell is occupied if any of the map's cubes that reach into it is occupied, and free if all of them are free.
void Observation::write_cells(const WorldMap& map, const Eigen::Vector3i& from) {
  const auto cells = map_.in(block_);
  const auto space_in = [&](const Eigen::Vector3i& cell) {
    const Eigen::Vector3i low = map.cube_of((cell.cast<double>() * config_.map_cell_m).array() + kRoundingM);
    const Eigen::Vector3i high = map.cube_of(((cell.array() + 1).cast<double>() * config_.map_cell_m) - kRoundingM);
    std::int8_t space = kFree;
    Eigen::Vector3i cube;
    for (cube.z() = low.z(); cube.z() <= high.z(); ++cube.z()) {
      for (cube.y() = low.y(); cube.y() <= high.y(); ++cube.y()) {
        for (cube.x() = low.x(); cube.x() <= high.x(); ++cube.x()) {
          const Space one = map.known(cube).space;
          if (one == Space::occupied) return kOccupied;
          if (one == Space::unknown) space = kUnknown;
        }
      }
    }
    return space;
  };
  Eigen::Vector3i cell;
  for (cell.x() = 0; cell.x() < config_.map_x; ++cell.x()) {
    for (cell.y() = 0; cell.y() < config_.map_y; ++cell.y()) {
      for (cell.z() = 0; cell.z() < config_.map_z; ++cell.z()) cells[map_index(cell)] = space_in(from + cell);
    }
  }
}

void Observation::write_cells(const OccupancyMap& map, const Eigen::Vector3i& from) {
  const auto cells = map_.in(block_);
  const Vector3d corner_W = from.cast<double>() * config_.map_cell_m;
  Eigen::Vector3i cell;
  for (cell.x() = 0; cell.x() < config_.map_x; ++cell.x()) {
    for (cell.y() = 0; cell.y() < config_.map_y; ++cell.y()) {
      for (cell.z() = 0; cell.z() < config_.map_z; ++cell.z()) {
        const Vector3d middle_W = corner_W + (cell.cast<double>() + Vector3d::Constant(0.5)) * config_.map_cell_m;
        cells[map_index(cell)] = map.known_free(middle_W) ? kFree : kUnknown;
      }
    }
  }
  const Vector3d size = window().cast<double>() * config_.map_cell_m;
  const OrientedBox box{.name = {}, .center = corner_W + 0.5 * size, .size = size};
  map.visit_occupied(box, [&](const Vector3d& p_W) {
    const Eigen::Vector3i met(((p_W - corner_W) / config_.map_cell_m).array().floor().cast<int>());
    if ((met.array() >= 0).all() && (met.array() < window().array()).all()) cells[map_index(met)] = kOccupied;
  });
}

}  // namespace skein::agent
