#include "small_scene.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

namespace skein::test {
namespace {

std::ofstream open(const std::filesystem::path& file) { return std::ofstream(file, std::ios::binary); }

std::string list_of(const auto& numbers) {
  std::ostringstream text;
  for (const double value : numbers) {
    const bool whole = value == std::trunc(value);
    text << (text.tellp() > 0 ? ", " : "[") << value << (whole ? ".0" : "");
  }
  text << ']';
  return text.str();
}

/// Writes an ASCII STL with twelve triangles per block.
void write_mesh(std::ostream& out, const std::vector<Block>& blocks) {
  constexpr int kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  constexpr int kTriangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
  out << "solid scene\n";
  for (const Block& block : blocks) {
    for (const auto& face : kFaces) {
      for (const auto& triangle : kTriangles) {
        out << "facet normal 0 0 0\nouter loop\n";
        for (const int index : triangle) {
          const int corner = face[index];
          out << "vertex";
          for (int axis = 0; axis < 3; ++axis) {
            const double sign = corner >> axis & 1 ? 0.5 : -0.5;
            out << ' ' << block.center[axis] + sign * block.size[axis];
          }
          out << '\n';
        }
        out << "endloop\nendfacet\n";
      }
    }
  }
  out << "endsolid scene\n";
}

void write_points(std::ostream& out, const std::vector<std::array<double, 6>>& points) {
  out << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z normal_x normal_y normal_z\n"
      << "SIZE 4 4 4 4 4 4\nTYPE F F F F F F\nCOUNT 1 1 1 1 1 1\nWIDTH " << points.size() << "\nHEIGHT 1\n"
      << "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << points.size() << "\nDATA binary\n";
  for (const auto& point : points) {
    for (const double value : point) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
      for (int shift = 0; shift < 32; shift += 8) out.put(static_cast<char>(bits >> shift & 0xff));
    }
  }
}

void write_boxes(std::ostream& out, const std::vector<Block>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto& c = boxes[i].center;
    out << "box" << i + 1 << ":\n  center: " << list_of(c) << "\n  size: " << list_of(boxes[i].size)
        << "\n  orientation:\n    [1.0, 0.0, 0.0, " << c[0] << ",\n     0.0, 1.0, 0.0, " << c[1]
        << ",\n     0.0, 0.0, 1.0, " << c[2] << ",\n     0.0, 0.0, 0.0, 1.0]\n";
  }
}

}  // namespace

SmallScene default_scene() {
  SmallScene scene;
  const Block block = {{30.0, 0.0, 6.0}, {20.0, 10.0, 12.0}};
  scene.blocks = {block};
  scene.boxes = {block};
  for (int i = 0; i < kSmallScenePoints; ++i) {
    scene.points.push_back({20.0, -4.5 + 0.8 * i, 3.0 + 0.5 * i, -1.0, 0.0, 0.0});
  }
  scene.fleet =
      "  - {name: jurong, vehicle: explorer, start: [0, 5], start_yaw_deg: 0}\n"
      "  - {name: changi, vehicle: photographer, start: [0, -5], start_yaw_deg: 0}\n";
  return scene;
}

std::string write_small_scene(const std::filesystem::path& folder, const SmallScene& scene) {
  std::filesystem::create_directories(folder / "scene");
  auto mesh = open(folder / "scene/mesh.stl"), points = open(folder / "scene/points.pcd"),
       boxes = open(folder / "scene/box_description.yaml"), scenario = open(folder / "scenario.yaml");
  write_mesh(mesh, scene.blocks);
  write_points(points, scene.points);
  write_boxes(boxes, scene.boxes);
  scenario << "name: small\ndescription: a few blocks, for a test\nduration_s: " << scene.duration_s << "\n"
           << "desired_mm_per_pixel: " << scene.desired_mm_per_pixel
           << "\nstation: {position: " << list_of(scene.station) << ", antenna_offset_m: 0.1}\n"
           << "scene:\n  meshes: [./scene/mesh.stl]\n  points: ./scene/points.pcd\n"
           << "  boxes: ./scene/box_description.yaml\nfleet:\n"
           << scene.fleet;
  return folder / "scenario.yaml";
}

}  // namespace skein::test
