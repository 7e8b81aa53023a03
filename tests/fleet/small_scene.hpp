// A scene of a few boxes in the benchmark's own file layout (STL, PCD, box_description.yaml), written by the test.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace skein::test {

/// An axis-aligned block [m].
struct Block {
  std::array<double, 3> center, size;
};

struct SmallScene {
  std::vector<Block> blocks;                  ///< the mesh
  std::vector<Block> boxes;                   ///< bounding boxes that the UAVs get
  std::vector<std::array<double, 6>> points;  ///< interest points: position [m] and normal
  std::string fleet;                          ///< YAML list
  std::array<double, 3> station = {-6.0, 0.0, 0.3};
  double desired_mm_per_pixel = 2.0;
  double duration_s = 60.0;
};

/// Two UAVs in front of one block.
SmallScene default_scene();
inline constexpr int kSmallScenePoints = 12;

/// Writes scenario.yaml and scene/ into `folder`. @returns the scenario's path.
std::string write_small_scene(const std::filesystem::path& folder, const SmallScene& scene = default_scene());

}  // namespace skein::test
