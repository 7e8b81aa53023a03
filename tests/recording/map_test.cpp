// The maps of UAVs in recorded flights: they agree with a simple map that is computed from the recording, and OctoMap
// can read their files.
#include <octomap/OcTree.h>

#include <cmath>
#include <random>

#include "fleet_fixture.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "recording/mcap/reader.hpp"
#include "results/run_folder.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/onboard/key_frame_filter.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

constexpr double kCellM = 0.5, kFreeCellM = 2.0;
constexpr int kMostRays = 20;

using Cell = std::array<int, 3>;

Cell cell_of(const Vector3d& p_W, double cell_m) {
  return {static_cast<int>(std::floor(p_W.x() / cell_m)), static_cast<int>(std::floor(p_W.y() / cell_m)),
          static_cast<int>(std::floor(p_W.z() / cell_m))};
}

/// A simple map: cells with hits, and for each coarse cell the number of rays that passed it. It traces the rays
/// itself, from the crossings of each ray with the borders of cells.
struct PlainMap {
  static constexpr std::size_t kTracedRays = 400;  ///< number of rays of a key frame, evenly picked
  static constexpr double kFarthest_m = 30.0, kShortOfHit_m = kFreeCellM;  ///< where rays end
  static constexpr double kGraze_m = 1e-3;  ///< a ray that passes less of a cell may also miss it: the cell is in doubt

  void insert(const std::vector<Eigen::Vector3f>& hits_W, const Vector3d& from_W) {
    for (const Eigen::Vector3f& hit : hits_W) {
      if (hit.z() >= 0.3F) hits.insert(cell_of(hit.cast<double>(), kCellM));
    }
    for (std::size_t i = 0; i < hits_W.size(); i += std::max<std::size_t>(1, hits_W.size() / kTracedRays)) {
      const Vector3d to_hit = hits_W[i].cast<double>() - from_W;
      const double length_m = std::min(to_hit.norm() - kShortOfHit_m, kFarthest_m);
      if (length_m > 0.0) pass(from_W, from_W + length_m * to_hit.normalized());
    }
  }
  /// Counts a ray in each cell that it passes, but not in the cell of its end.
  void pass(const Vector3d& from_W, const Vector3d& to_W) {
    const Vector3d way = to_W - from_W;
    std::vector<double> crossings = {0.0, 1.0};
    for (int axis = 0; axis < 3; ++axis) {
      const double low = std::min(from_W[axis], to_W[axis]), high = std::max(from_W[axis], to_W[axis]);
      for (double border = std::ceil(low / kFreeCellM) * kFreeCellM; border < high; border += kFreeCellM) {
        crossings.push_back((border - from_W[axis]) / way[axis]);
      }
    }
    std::ranges::sort(crossings);
    const Cell end = cell_of(to_W, kFreeCellM);
    for (const Vector3d& p_W : {from_W, to_W}) doubt(p_W);
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
      const Vector3d middle_W = from_W + 0.5 * (crossings[i] + crossings[i + 1]) * way;
      if ((crossings[i + 1] - crossings[i]) * way.norm() < kGraze_m) {
        doubt(middle_W);
      } else if (const Cell cell = cell_of(middle_W, kFreeCellM); cell != end) {
        ++rays[cell];
      }
    }
  }
  /// If a place is at the border of cells, all of these are in doubt.
  void doubt(const Vector3d& p_W) {
    std::set<Cell> cells;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d off(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
      cells.insert(cell_of(p_W + kGraze_m * off, kFreeCellM));
    }
    if (cells.size() > 1) in_doubt.insert(cells.begin(), cells.end());
  }
  bool occupied(const Vector3d& p_W) const { return hits.contains(cell_of(p_W, kCellM)); }
  bool known_free(const Vector3d& p_W, int wanted) const {
    const auto found = rays.find(cell_of(p_W, kFreeCellM));
    return found != rays.end() && found->second >= std::min(wanted, kMostRays) && !occupied(p_W);
  }
  std::optional<double> distance(const Vector3d& p_W, double most) const {
    const Cell low = cell_of(p_W - Vector3d::Constant(most), kCellM);
    const Cell high = cell_of(p_W + Vector3d::Constant(most), kCellM);
    double best = most;
    bool found = false;
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) {
          if (!hits.contains({x, y, z})) continue;
          const double d = (kCellM * (Vector3d(x, y, z) + Vector3d::Constant(0.5)) - p_W).norm();
          if (d > best) continue;
          best = d;
          found = true;
        }
      }
    }
    return found ? std::optional(best) : std::nullopt;
  }

  std::set<Cell> hits;
  std::map<Cell, int> rays;
  std::set<Cell> in_doubt;
};

class FlownMaps : public FleetTest {
 protected:
  /// Flies a run with a random scene, planner and seed.
  SkeinRun& flight(const std::string& name, Arguments more) {
    static constexpr const char* kScenes[] = {"towers", "hangar", "cranes", "spire", "sail"};
    static constexpr const char* kPlanners[] = {"patrol", "kios", "xxh", "star", "flock"};
    Arguments arguments = {kScenes[draw_() % 5],          "--planner",    kPlanners[draw_() % 5],       "--seed",
                           std::to_string(draw_() % 900), "--scene-seed", std::to_string(draw_() % 900)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(name, arguments);
  }
  Vector3d drawn_near(const std::vector<Vector3d>& places, double reach) {
    std::uniform_real_distribution<double> off(-reach, reach);
    Vector3d p_W = places[draw_() % places.size()] + Vector3d(off(draw_), off(draw_), off(draw_));
    p_W.z() = std::abs(p_W.z());
    return p_W;
  }

  std::mt19937 draw_{static_cast<unsigned>(::getpid())};
};

TEST_F(FlownMaps, AnswerEveryQueryAsASimpleMapDoes) {
  SkeinRun& flown = flight("flown", {"--one-process", "--record=all", "--duration", "60"});
  std::map<std::string, Vector3d> at_W;
  const agent::KeyFrameFilter filter;
  agent::OccupancyMap map;
  PlainMap plain;
  std::vector<Vector3d> places;
  mcap::Reader(flown.dir() / run_folder::kRecording)
      .messages([&](const mcap::Channel& channel, const mcap::Message& message) {
        const std::string uav = channel.topic.substr(1, channel.topic.find('/', 1) - 1);
        msg::Odometry odometry;
        msg::PointCloud2 cloud;
        if (channel.topic.ends_with("/odometry") && decode(message.data, odometry)) {
          at_W[uav] = from_odometry(odometry).p_WB;
        }
        if (!channel.topic.ends_with("/slf_kf_cloud") || !decode(message.data, cloud) || !at_W.contains(uav)) return;
        std::vector<Eigen::Vector3f> points_W;
        for (const ScanPoint& p : from_cloud<ScanPoint>(cloud)) points_W.emplace_back(p.x, p.y, p.z);
        const std::vector<Eigen::Vector3f> hits_W = filter.thinned(filter.sound(points_W, agent::KnownBodies({})));
        map.insert(hits_W, at_W.at(uav));
        plain.insert(hits_W, at_W.at(uav));
        for (std::size_t i = 0; i < hits_W.size(); i += 10) places.push_back(hits_W[i].cast<double>());
        places.push_back(at_W.at(uav));
      });
  ASSERT_GT(places.size(), 500U);
  EXPECT_EQ(map.occupied_cells(), plain.hits.size());
  std::map<bool, int> free, near;
  for (int i = 0; i < 20'000; ++i) {
    const Vector3d p_W = drawn_near(places, i % 2 == 0 ? 1.0 : 8.0);
    ASSERT_EQ(map.occupied(p_W), plain.occupied(p_W)) << p_W.transpose();
    for (const int rays : {1, 3, 8, 9, 12, 16, 20, 50}) {
      if (plain.in_doubt.contains(cell_of(p_W, kFreeCellM))) continue;
      ASSERT_EQ(map.known_free(p_W, rays), plain.known_free(p_W, rays)) << p_W.transpose() << ", " << rays;
      ++free[map.known_free(p_W, rays)];
    }
    if (i % 10 != 0) continue;
    const auto distance = map.distance_to_occupied(p_W, 3.0), expected = plain.distance(p_W, 3.0);
    ASSERT_EQ(distance.has_value(), expected.has_value()) << p_W.transpose();
    ASSERT_NEAR(distance.value_or(0.0), expected.value_or(0.0), 1e-9);
    ASSERT_EQ(map.any_occupied_within(p_W, 3.0), expected.has_value());
    ++near[expected.has_value()];
  }
  for (const bool yes : {false, true}) {
    EXPECT_GT(free[yes], 1000) << yes;
    EXPECT_GT(near[yes], 50) << yes;
  }
}

TEST_F(FlownMaps, AreWrittenToFilesThatOctoMapReads) {
  for (const char* how : {"--one-process", "--dds=mixed"}) {
    SkeinRun& flown = flight(std::string("flown") + how, {how, "--duration", "50"});
    const auto rows = read_csv(flown.dir() / run_folder::kTrajectories);
    const Json result = flown.result();
    for (const Json& uav : result["uavs"]) {
      const std::string name = uav["name"];
      octomap::OcTree tree(0.1);
      ASSERT_TRUE(tree.readBinary((flown.dir() / run_folder::map_file(name)).string())) << name;
      EXPECT_EQ(tree.getResolution(), kCellM);
      int occupied = 0;
      for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) occupied += tree.isNodeOccupied(*leaf);
      EXPECT_GT(occupied, 50) << name << " has received no map of an explorer";
      int places = 0, free = 0;
      for (const auto& row : rows) {
        if (row.at("uav") != name || row.at("alive") == "0") continue;
        const octomap::OcTreeNode* const node =
            tree.search(std::stod(row.at("x")), std::stod(row.at("y")), std::stod(row.at("z")));
        ++places;
        free += node != nullptr && !tree.isNodeOccupied(node);
        EXPECT_FALSE(node != nullptr && tree.isNodeOccupied(node))
            << name << " was at a place that its map calls occupied";
      }
      // A UAV without a LiDAR knows the space from explorers. On the ground it may know nothing.
      const int least = uav["distance_m"] > 10.0 ? places / 4 : 0;
      EXPECT_GE(free, least) << name << " has a map in which too little of its route is free";
    }
  }
}

}  // namespace
}  // namespace skein::test
