// What a flight looked like: boxes, interest points and paths, read from its results folder, and its drawing.
// Frame W (ENU); metres.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace skein::report {

struct PicturePoint {
  Vector3d p_W = Vector3d::Zero();
  double score = 0.0;                     ///< delivered; below 0.2: not detected
  std::optional<std::size_t> cause = {};  ///< of its loss, of kCauses
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
  std::optional<Vector3d> station = {};
  std::vector<Vector3d> collisions = {};
};

/// Of a box; bit 0 of the index: its x, bit 1: y, bit 2: z.
std::array<Vector3d, 8> corners_of(const Vector3d& center, const Vector3d& size, const Eigen::Matrix3d& R_WB);

/// Reads result.json, scene.json, score.csv and trajectories.csv; a file that is missing or damaged gives nothing.
FlightPicture read_picture(const std::filesystem::path& dir);

/// Below this score a point is not detected.
inline constexpr double kDetected = 0.2;
/// Detected points have one of so many colours, by score; tracks one of these, then they repeat, dashed.
inline constexpr std::size_t kScoreColours = 4, kTrackColours = 6;

/// Whence one looks, parallel lines staying parallel.
enum class Look { aside, above, from_south, from_east };

/// Which part of the world drawings of one scene show, all at the same scale.
class PictureView {
 public:
  /// Takes in all that stands and flies in these pictures. @param width  of the drawing.
  explicit PictureView(const std::vector<const FlightPicture*>& pictures, Look look = Look::aside,
                       double width = 360.0);

  Look look() const { return look_; }

  double width() const { return width_; }
  double height() const { return height_; }
  /// Where a point is drawn, in the drawing's units.
  Eigen::Vector2d at(const Vector3d& p_W) const;
  const Vector3d& low() const { return low_; }  ///< of the shown part; the ground is at its z
  const Vector3d& high() const { return high_; }
  double grid_m() const { return grid_m_; }  ///< distance of the lines on the ground

 private:
  Look look_;
  Vector3d low_ = Vector3d::Zero(), high_ = Vector3d::Zero();
  double grid_m_ = 10.0, scale_ = 1.0, width_ = 0.0, height_ = 0.0;
  Eigen::Vector2d offset_ = Eigen::Vector2d::Zero();
};

/// What a drawing shows beside structure and boxes.
struct PictureStyle {
  bool by_cause = false;                       ///< points in the colours of their causes, not of their scores
  std::optional<std::size_t> only_cause = {};  ///< other points stay pale
  bool tracks = true;
  std::string ground = {};  ///< SVG, below all that stands and flies
};

/// @param title  for those who hear the page.
std::string picture_svg(const FlightPicture& picture, const PictureView& view, const std::string& title,
                        const PictureStyle& style = {});

/// Colours of its drawings, as an HTML list.
std::string picture_legend(const FlightPicture& picture);

/// Leaves out what is no farther than `tolerance` from the rest (Douglas and Peucker 1973); the ends stay.
std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& line, double tolerance);

}  // namespace skein::report
