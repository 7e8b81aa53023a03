// Boxes, interest points and tracks of a flight, from its results folder, drawn as SVG.
// Frame W (ENU); metres.   Pure, except for read_picture(); any thread.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "results/run_record.hpp"

namespace skein::report {

struct PicturePoint {
  Vector3d p_W = Vector3d::Zero();
  double score = 0.0;                     ///< delivered score; below kDetected: not detected
  std::optional<std::size_t> cause = {};  ///< cause of its loss: index in kCauses
};

struct PictureTrack {
  std::string uav;
  bool explorer = false;
  std::vector<Vector3d> p_WB;  ///< positions, in order of time
};

struct FlightPicture {
  std::vector<std::array<Vector3d, 8>> boxes;  ///< corners; bit 0 of the index: x, bit 1: y, bit 2: z
  std::vector<PicturePoint> points;
  std::vector<PictureTrack> tracks;  ///< fleet order
  std::optional<Vector3d> station = {};
  std::vector<Vector3d> collisions = {};
};

/// Corners of a box in W. Bits of the index: 0 the box's x axis, 1 y, 2 z. @param size  full edge lengths.
std::array<Vector3d, 8> corners_of(const Vector3d& center, const Vector3d& size, const Eigen::Matrix3d& R_WB);

/// The boxes, points and tracks of a run, without its station and its collisions.
FlightPicture shape_of(const results::RunRecord& run);

/// Reads a whole picture from a results folder, without causes of losses. The picture is empty if result.json is
/// missing or damaged. If another file is missing, the picture lacks its content; from a damaged table, it has the rows
/// before the damage.
FlightPicture read_picture(const std::filesystem::path& dir);

/// Below this score a point is not detected.
inline constexpr double kDetected = 0.2;
/// Number of colours of detected points (by score) and of tracks. More tracks reuse the colours with dashed lines.
inline constexpr std::size_t kScoreColours = 4, kTrackColours = 6;

/// Direction of view of a parallel projection. aside: oblique, from the south-south-east.
enum class Look { aside, above, from_south, from_east };

/// Projection and extent of the drawings of one scene, so that all have the same scale.
class PictureView {
 public:
  /// Chooses the extent that contains everything in these pictures except collisions.
  /// @param width  of the drawing, in its own units.
  explicit PictureView(const std::vector<const FlightPicture*>& pictures, Look look = Look::aside,
                       double width = 360.0);

  Look look() const { return look_; }

  double width() const { return width_; }
  double height() const { return height_; }
  /// Where a point is drawn, in the drawing's units.
  Eigen::Vector2d at(const Vector3d& p_W) const;
  const Vector3d& low() const { return low_; }  ///< lowest corner of the extent; the ground is drawn at the z of it
  const Vector3d& high() const { return high_; }
  double grid_m() const { return grid_m_; }  ///< spacing of the grid lines

 private:
  Look look_;
  Vector3d low_ = Vector3d::Zero(), high_ = Vector3d::Zero();
  double grid_m_ = 10.0, scale_ = 1.0, width_ = 0.0, height_ = 0.0;
  Eigen::Vector2d offset_ = Eigen::Vector2d::Zero();
};

/// Options of a drawing.
struct PictureStyle {
  bool by_cause = false;                       ///< points in the colours of their causes, not of their scores
  std::optional<std::size_t> only_cause = {};  ///< colours only the points with this cause; other points stay pale
  bool tracks = true;
  std::string ground = {};  ///< SVG that is drawn first, under everything else
};

/// @returns an <svg> element. @param title  label for screen readers, as plain text.
std::string picture_svg(const FlightPicture& picture, const PictureView& view, const std::string& title,
                        const PictureStyle& style = {});

/// Legend of a picture's drawings: the colours of its tracks and of scores, as an HTML list.
std::string picture_legend(const FlightPicture& picture);

/// Simplifies a polyline: removes points that are at most `tolerance` away from the remaining line (Douglas and Peucker
/// 1973). Both ends stay.
std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& line, double tolerance);

}  // namespace skein::report
