// One mesh in each format that read_mesh() reads, for the tests of the file readers. Not part of any program.
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/scenario/scene.hpp"
#include "core/text/base64.hpp"

namespace skein::sim::small_models {

/// A text of values, separated by spaces.
class Words {
 public:
  template <typename T>
  Words& operator<<(const T& value) {
    text_ << (text_.tellp() > 0 ? " " : "") << value;
    return *this;
  }
  std::string str() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

inline std::string bytes_of(const auto& value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }

inline std::string obj(const TriangleMesh& mesh) {
  std::ostringstream text;
  text << "# a mesh\nmtllib none.mtl\no part\nvt 0 0\nvn 0 0 1\n";
  for (const auto& v : mesh.vertices) text << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text << "usemtl " << (t % 2 == 0 ? "even" : "odd") << "\nf";  // so Assimp makes a mesh of each triangle
    for (const auto vertex : mesh.triangles[t]) text << ' ' << vertex + 1 << "/1/1";
    text << '\n';
  }
  return text.str();
}

inline std::string ply_header(const TriangleMesh& mesh, const std::string& form) {
  return "ply\nformat " + form + " 1.0\ncomment a mesh\nelement vertex " + std::to_string(mesh.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nelement face " +
         std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ascii_ply(const TriangleMesh& mesh) {
  std::ostringstream text;
  text << ply_header(mesh, "ascii");
  for (const auto& v : mesh.vertices) text << v.x() << ' ' << v.y() << ' ' << v.z() << " 255\n";
  for (const auto& [a, b, c] : mesh.triangles) text << "3 " << a << ' ' << b << ' ' << c << '\n';
  return text.str();
}

inline std::string binary_ply(const TriangleMesh& mesh, bool big_endian) {
  const auto number = [&](const auto& value) {
    const std::string bytes = bytes_of(value);
    return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  };
  std::string bytes = ply_header(mesh, big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const auto& v : mesh.vertices) bytes += number(v.x()) + number(v.y()) + number(v.z()) + '\xff';
  for (const auto& triangle : mesh.triangles) {
    bytes += '\3';
    for (const auto vertex : triangle) bytes += number(vertex);
  }
  return bytes;
}

/// A COLLADA file in centimetres, with z up. @param nodes  the nodes of its scene as XML; the geometry's id is `g`.
inline std::string dae(const TriangleMesh& mesh,
                       const std::string& nodes = "<node id=\"n\"><instance_geometry url=\"#g\"/></node>") {
  Words numbers, indices;
  for (const auto& v : mesh.vertices) numbers << 100 * v.x() << 100 * v.y() << 100 * v.z();
  for (const auto& [a, b, c] : mesh.triangles) indices << a << b << c;
  const std::string count = std::to_string(mesh.vertices.size()), size = std::to_string(3 * mesh.vertices.size());
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
         "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
         "<asset><unit name=\"centimeter\" meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset>\n"
         "<library_images><image id=\"i\"><init_from>none.png</init_from></image></library_images>\n"
         "<library_geometries><geometry id=\"g\"><mesh>\n<source id=\"p\"><float_array id=\"a\" count=\"" +
         size + "\">" + numbers.str() + "</float_array>\n<technique_common><accessor source=\"#a\" count=\"" + count +
         "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>\n"
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>\n<triangles count=\"" +
         std::to_string(mesh.triangles.size()) +
         "\" material=\"m\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" + indices.str() +
         "</p></triangles>\n</mesh></geometry></library_geometries>\n"
         "<library_visual_scenes><visual_scene id=\"s\">" +
         nodes +
         "</visual_scene></library_visual_scenes>\n"
         "<scene><instance_visual_scene url=\"#s\"/></scene>\n</COLLADA>\n";
}

/// The JSON of a glTF file, with y up. @param nodes  the nodes of its scene as JSON.   @param uri  the entry
///   `"uri": "..."` that names the data of gltf_data(); empty: they are in the binary part of a .glb file.
inline std::string gltf_text(const TriangleMesh& mesh, const std::string& nodes, const std::string& uri) {
  const std::size_t positions = 12 * mesh.vertices.size(), indices = 6 * mesh.triangles.size();
  return "{\"asset\": {\"version\": \"2.0\", \"generator\": \"written by a test, with a text that may be damaged "
         "without any consequence for the triangles, because no reader uses it, as is true of much that such files "
         "have\"},\n"
         "\"scene\": 0, \"scenes\": [{\"nodes\": [0]}],\n\"nodes\": [" +
         nodes +
         "],\n\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1, \"material\": 0}]}],\n"
         "\"materials\": [{\"name\": \"not read either\"}], \"images\": [{\"uri\": \"none.png\"}],\n"
         "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": " +
         std::to_string(mesh.vertices.size()) +
         ", \"type\": \"VEC3\"},\n{\"bufferView\": 1, \"componentType\": 5123, \"count\": " +
         std::to_string(3 * mesh.triangles.size()) +
         ", \"type\": \"SCALAR\"}],\n\"bufferViews\": [{\"buffer\": 0, \"byteLength\": " + std::to_string(positions) +
         "}, {\"buffer\": 0, \"byteOffset\": " + std::to_string(positions) +
         ", \"byteLength\": " + std::to_string(indices) +
         "}],\n\"buffers\": [{\"byteLength\": " + std::to_string(positions + indices) + (uri.empty() ? "" : ", ") +
         uri + "}]}";
}

inline std::string gltf_data(const TriangleMesh& mesh) {
  std::string bytes;
  for (const auto& v : mesh.vertices) bytes += bytes_of(v.x()) + bytes_of(v.z()) + bytes_of(-v.y());
  for (const auto& triangle : mesh.triangles) {
    for (const auto vertex : triangle) bytes += bytes_of(static_cast<std::uint16_t>(vertex));
  }
  return bytes;
}

inline std::string glb(const TriangleMesh& mesh, const std::string& nodes = "{\"mesh\": 0}") {
  std::string text = gltf_text(mesh, nodes, ""), data = gltf_data(mesh);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + data.size()) + word(text.size()) + "JSON" + text +
         word(data.size()) + std::string("BIN\0", 4) + data;
}

/// @param nodes  the nodes of its scene as JSON.
inline std::string gltf(const TriangleMesh& mesh, const std::string& nodes = "{\"mesh\": 0}") {
  const std::string data = gltf_data(mesh);
  return gltf_text(mesh, nodes,
                   "\"uri\": \"data:application/octet-stream;base64," +
                       base64({reinterpret_cast<const std::uint8_t*>(data.data()), data.size()}) + "\"");
}

}  // namespace skein::sim::small_models
