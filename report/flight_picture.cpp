#include "report/flight_picture.hpp"

#include <map>
#include <stdexcept>

#include "process/json_text.hpp"
#include "results/run_folder.hpp"
#include "results/run_rows.hpp"

namespace skein::report {
namespace {

/// @throws Json::exception if `numbers` is not an array of at least three numbers.
Vector3d json_vector(const Json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

std::array<Vector3d, 8> box_corners(const Json& box) {
  Eigen::Matrix3d R_WB;
  for (int row = 0; row < 3; ++row) R_WB.row(row) = json_vector(box.at("rotation").at(row)).transpose();
  return corners_of(json_vector(box.at("center")), json_vector(box.at("size")), R_WB);
}

void read_tracks(const std::filesystem::path& dir, FlightPicture& picture) {
  std::map<std::string, std::size_t> index;
  const Json uavs = value_or(read_json(dir / run_folder::kResult), "uavs", Json::array());
  for (const Json& uav : uavs) {
    const std::string name = value_or(uav, "name", "");
    index[name] = picture.tracks.size();
    picture.tracks.push_back({name, value_or(uav, "role", "") == Json("explorer"), {}});
  }
  results::each_row<results::PoseCells>(dir, [&](const results::PoseCells& row) {
    const auto found = index.find(row.uav());
    if (found != index.end()) picture.tracks[found->second].p_WB.push_back(row.p_W());
  });
}

/// Calls `read` and ignores damage. What it has read before the damage stays: if a flight was aborted, the last line of
/// a table may be incomplete.
template <class Read>
void read_what_is_there(const Read& read) try {
  read();
} catch (const std::runtime_error&) {
} catch (const Json::exception&) {
}

}  // namespace

std::array<Vector3d, 8> corners_of(const Vector3d& center, const Vector3d& size, const Eigen::Matrix3d& R_WB) {
  std::array<Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3d signs((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
    corners[static_cast<std::size_t>(i)] = center + R_WB * signs.cwiseProduct(0.5 * size);
  }
  return corners;
}

FlightPicture read_picture(const std::filesystem::path& dir) {
  FlightPicture picture;
  read_what_is_there([&] {
    const Json boxes = value_or(read_json(dir / run_folder::kScene), "boxes", Json::array());
    for (const Json& box : boxes) picture.boxes.push_back(box_corners(box));
  });
  read_what_is_there([&] {
    results::each_row<results::PointCells>(dir, [&](const results::PointCells& row) {
      picture.points.push_back({row.p_W(), row.score()});
    });
  });
  read_what_is_there([&] { read_tracks(dir, picture); });
  return picture;
}

}  // namespace skein::report
