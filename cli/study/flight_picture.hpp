// What a flight looked like: boxes, interest points and paths, read from its results folder, and its drawing.
// Frame W (ENU); metres. In drawings the view is from above and aside, parallel lines staying parallel.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace skein::cli {

struct PicturePoint {
  Vector3d p_W = Vector3d::Zero();
  double score = 0.0;  ///< delivered; below 0.2: not detected
};

struct PictureTrack {
  std::string uav;
  bool explorer = false;
  std::vector<Vector3d> p_WB;  ///< in time
};

struct FlightPicture {
  std::vector<std::array<Vector3d, 8>> boxes;  ///< corners; bit 0 of the index: x, bit 1: y, bit 2: z
  std::vector<PicturePoint> points;
  std::vector<PictureTrack> tracks;  ///< fleet order
};

/// Reads result.json, scene.json, score.csv and trajectories.csv; a file that is missing or damaged gives nothing.
FlightPicture read_picture(const std::filesystem::path& dir);

/// Below this score a point is not detected.
inline constexpr double kDetected = 0.2;
/// Detected points have one of so many colours, by score; tracks one of these, then they repeat, dashed.
inline constexpr std::size_t kScoreColours = 4, kTrackColours = 6;

/// Which part of the world drawings of one scene show, all at the same scale.
class PictureView {
 public:
  /// Takes in all that stands and flies in these pictures.
  explicit PictureView(const std::vector<const FlightPicture*>& pictures);

  double width() const { return width_; }
  double height() const { return height_; }
  /// Where a point is drawn, in the drawing's units.
  Eigen::Vector2d at(const Vector3d& p_W) const;
  const Vector3d& low() const { return low_; }  ///< of the shown part; the ground is at its z
  const Vector3d& high() const { return high_; }
  double grid_m() const { return grid_m_; }  ///< distance of the lines on the ground

 private:
  Vector3d low_ = Vector3d::Zero(), high_ = Vector3d::Zero();
  double grid_m_ = 10.0, scale_ = 1.0, width_ = 0.0, height_ = 0.0;
  Eigen::Vector2d offset_ = Eigen::Vector2d::Zero();
};

/// @param title  for those who hear the page.
std::string picture_svg(const FlightPicture& picture, const PictureView& view, const std::string& title);

/// Leaves out what is no farther than `tolerance` from the rest (Douglas and Peucker 1973); the ends stay.
std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& line, double tolerance);

}  // namespace skein::cli
