#include "uav_agent/maps/scan_bundles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/random_stream.hpp"
#include "core/vehicle/lidar_geometry.hpp"

namespace skein::agent {
namespace {

bool everywhere(const Vector3d&, const Vector3d&, double) { return true; }

BeamScan drawn_scan(const LidarConfig& lidar, std::uint64_t world) {
  RandomStream random(world, "scan", 0);
  BeamScan scan{.columns = lidar.columns};
  for (int i = 0; i < lidar.rings * lidar.columns; ++i) {
    const double kind = random.uniform();
    const auto range_m = static_cast<float>(random.uniform(0.9, 50.0));
    if (kind < 0.9) {
      scan.beams.push_back({BeamState::none, 0.0F});
    } else {
      scan.beams.push_back({kind < 0.98   ? BeamState::range
                            : kind < 0.99 ? BeamState::uav
                                          : BeamState::unknown,
                            range_m});
    }
  }
  const Isometry3d X_WL =
      Eigen::Translation3d(10.0, -3.0, 20.0) * Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized());
  scan.fired = {{.X_WL = X_WL}};
  return scan;
}

TEST(ScanBundler, ABundleOfOneBeamProvesTheSameAsTheBeam) {
  const LidarConfig lidar;
  const BeamScan scan = drawn_scan(lidar, 1);
  ScanBundler bundler(lidar, 0.0);
  const ScanBundler::Bundles& said = bundler.bundle(scan, {}, everywhere);
  std::size_t bundle = 0, hit = 0;
  for (int ring = 0; ring < lidar.rings; ++ring) {
    for (int column = 0; column < lidar.columns; ++column) {
      const BeamScan::Beam& beam = scan.beam(ring, column);
      if (beam.state == BeamState::unknown) continue;
      const Vector3d direction_W = scan.fired[0].X_WL.linear() * lidar_direction_L(lidar, ring, column);
      ASSERT_LT(bundle, said.bundles.size());
      const BeamBundle& one = said.bundles[bundle++];
      EXPECT_EQ(one.beams, 1);
      EXPECT_EQ(one.from_W, scan.fired[0].X_WL.translation());
      EXPECT_LT((one.direction_W.cast<double>() - direction_W).norm(), 1e-6);
      EXPECT_EQ(one.free_m, beam.state == BeamState::none ? 50.0F : beam.range_m);
    }
  }
  EXPECT_EQ(bundle, said.bundles.size());
  for (int column = 0; column < lidar.columns; ++column) {
    for (int ring = 0; ring < lidar.rings; ++ring) {
      const BeamScan::Beam& beam = scan.beam(ring, column);
      if (beam.state != BeamState::range) continue;
      const Vector3d hit_W =
          scan.fired[0].X_WL * (static_cast<double>(beam.range_m) * lidar_direction_L(lidar, ring, column));
      ASSERT_LT(hit, said.hits_W.size());
      EXPECT_LT((said.hits_W[hit++].cast<double>() - hit_W).norm(), 1e-4);
    }
  }
  EXPECT_EQ(hit, said.hits_W.size());
}

/// For all numbers of rings and columns of a LiDAR, each beam is in a bundle, and no bundle proves more than its beams.
TEST(ScanBundler, ABundleProvesWhatAllItsBeamsProve) {
  struct Kind {
    int rings, columns;
    double fov_deg;
  };
  for (const Kind& kind : {Kind{16, 440, 30.0}, {5, 61, 20.0}, {1, 300, 0.0}, {32, 1000, 40.0}}) {
    LidarConfig lidar;
    lidar.rings = kind.rings;
    lidar.columns = kind.columns;
    lidar.vertical_fov_deg = kind.fov_deg;
    for (std::uint64_t world = 0; world <= 4; ++world) {
      BeamScan scan = drawn_scan(lidar, world);
      ScanBundler bundler(lidar);
      scan.tick = static_cast<Tick>(3 * world) * lidar_period(lidar);
      for (auto& beam : scan.beams) beam.state = beam.state == BeamState::unknown ? BeamState::none : beam.state;
      int beams = 0;
      for (const BeamBundle& bundle : bundler.bundle(scan, {}, everywhere).bundles) {
        beams += bundle.beams;
        // Considers all beams within the bundle's half width (a little less, because its neighbours have beams, too).
        const Vector3d middle_L = scan.fired[0].X_WL.linear().transpose() * bundle.direction_W.cast<double>();
        float least = 50.0F;
        int within = 0;
        for (int i = 0; i < lidar.rings * lidar.columns; ++i) {
          const Vector3d beam_L = lidar_direction_L(lidar, i / lidar.columns, i % lidar.columns);
          if (2.0 * std::asin(0.5 * (beam_L - middle_L).norm()) > bundler.half_rad() + 1e-5) continue;
          const BeamScan::Beam& beam = scan.beams[static_cast<std::size_t>(i)];
          if (beam.state != BeamState::none) least = std::min(least, beam.range_m);
          ++within;
        }
        EXPECT_GE(within, bundle.beams);
        EXPECT_GE(bundle.free_m, least);
        if (within == bundle.beams) {
          EXPECT_EQ(bundle.free_m, least);
        }
        EXPECT_LE(bundle.around_free_m, bundle.free_m);
      }
      EXPECT_EQ(beams, lidar.rings * lidar.columns) << kind.rings << " x " << kind.columns;
    }
  }
}

TEST(ScanBundler, AHitLimitsTheFreeRangeAroundNeighbouringBundles) {
  const LidarConfig lidar;
  RandomStream random(4, "neighbours", 0);
  ScanBundler bundler(lidar);
  for (int draw = 0; draw < 50; ++draw) {
    BeamScan scan{.columns = lidar.columns};
    scan.beams.assign(static_cast<std::size_t>(lidar.rings * lidar.columns), {BeamState::none, 0.0F});
    scan.fired = {{}};
    const int ring = static_cast<int>(random.uniform() * lidar.rings);
    const int column = draw < 5 ? draw : static_cast<int>(random.uniform() * lidar.columns);
    scan.beams[static_cast<std::size_t>(ring * lidar.columns + column)] = {BeamState::range, 7.0F};
    const Vector3d hit_L = lidar_direction_L(lidar, ring, column);
    int met = 0, around = 0;
    for (const BeamBundle& bundle : bundler.bundle(scan, {}, everywhere).bundles) {
      const double apart = std::acos(std::min(1.0, bundle.direction_W.cast<double>().dot(hit_L)));
      if (bundle.free_m < 50.0F) ++met;
      if (bundle.around_free_m < 50.0F) {
        ++around;
        EXPECT_EQ(bundle.around_free_m, 7.0F);
      }
      // Bundles that may pass the same window of a metre as the hit, eight metres away.
      if (apart < 0.1) {
        EXPECT_EQ(bundle.around_free_m, 7.0F) << apart;
      }
    }
    EXPECT_EQ(met, 1);
    EXPECT_GE(around, 15);
    EXPECT_LE(around, 25);
  }
}

TEST(ScanBundler, ABeamWithoutReturnCountsOnlyIfItsFirstStretchIsKnownToBeFree) {
  const LidarConfig lidar;
  BeamScan scan{.columns = lidar.columns};
  scan.beams.assign(static_cast<std::size_t>(lidar.rings * lidar.columns), {BeamState::none, 0.0F});
  for (int column = 0; column < 4; ++column) {
    for (const int ring : {14, 15})
      scan.beams[static_cast<std::size_t>(ring * lidar.columns + column)] = {BeamState::range, 5.0F};
  }
  scan.fired = {{}};
  const auto below = [](const Vector3d& a_W, const Vector3d& b_W, double radius_m) {
    if (a_W == b_W) return false;
    EXPECT_NEAR((b_W - a_W).norm(), 0.9, 1e-12);
    EXPECT_GT(radius_m, 0.02);
    return b_W.z() < a_W.z();
  };
  ScanBundler bundler(lidar);
  const std::vector<BeamBundle>& bundles = bundler.bundle(scan, {}, below).bundles;
  EXPECT_EQ(bundles.size(), 4U * 110U + 1U);
  for (const BeamBundle& bundle : bundles) {
    EXPECT_TRUE(bundle.direction_W.z() < 0.0F || bundle.free_m == 5.0F) << "a beam that returned proves its own path";
  }
}

TEST(ScanBundler, ABeamThatMayHaveBeenLostEndsAtTheFirstOccupiedCube) {
  const LidarConfig lidar;
  const BeamScan scan = drawn_scan(lidar, 3);
  ScanBundler bundler(lidar, 0.0);
  const std::vector<BeamBundle> whole = bundler.bundle(scan, {}, everywhere).bundles;
  std::size_t asked = 0;
  const auto clear_way = [&](const Vector3d& from_W, const Vector3d& direction_W, double reach_m) {
    EXPECT_EQ(from_W, scan.fired[0].X_WL.translation());
    ++asked;
    return direction_W.z() < 0.0 ? std::min(reach_m, 11.0) : reach_m;
  };
  const std::vector<BeamBundle>& bundles = bundler.bundle(scan, {}, everywhere, clear_way).bundles;
  ASSERT_EQ(bundles.size(), whole.size());
  std::size_t without_return = 0;
  for (std::size_t i = 0; i < bundles.size(); ++i) {
    const bool none = whole[i].free_m == 50.0F, ends = none && bundles[i].direction_W.z() < 0.0F;
    EXPECT_EQ(bundles[i].free_m, ends ? 11.0F : whole[i].free_m) << "a beam that returned proves its own path";
    EXPECT_LE(bundles[i].around_free_m, bundles[i].free_m);
    without_return += none;
  }
  EXPECT_EQ(asked, without_return);
}

TEST(ScanBundler, AScanInDoubtHasNoBundlesAndNoHits) {
  const LidarConfig lidar;
  BeamScan scan = drawn_scan(lidar, 2);
  scan.doubt = ScanDoubt::misfit;
  ScanBundler bundler(lidar);
  EXPECT_TRUE(bundler.bundle(scan, {}, everywhere).bundles.empty());
  EXPECT_TRUE(bundler.bundle(scan, {}, everywhere).hits_W.empty());
}

TEST(ScanBundler, RepeatedBeamsGiveNoBundlesButTheirHitsAreKept) {
  const LidarConfig lidar;
  const BeamScan scan = drawn_scan(lidar, 3);
  ScanBundler bundler(lidar);
  const std::size_t all = bundler.bundle(scan, {}, everywhere).bundles.size();
  const std::size_t hits = bundler.bundle(scan, {}, everywhere).hits_W.size();
  RepeatedScans::Repeated about_x;
  about_x.cosine = 0.9;
  EXPECT_LT(bundler.bundle(scan, about_x, everywhere).bundles.size(), all);
  RepeatedScans::Repeated repeated;
  repeated.all = true;
  EXPECT_TRUE(bundler.bundle(scan, repeated, everywhere).bundles.empty());
  EXPECT_EQ(bundler.bundle(scan, repeated, everywhere).hits_W.size(), hits);
}

}  // namespace
}  // namespace skein::agent
