#include "sim_server/scene_files/mesh_file.hpp"

#include <assimp/scene.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "core/file_bytes.hpp"

namespace skein::sim {
namespace {

constexpr std::uintmax_t kMostBytes = 1u << 30;
constexpr std::size_t kBinaryHead = 84;      // 80 bytes of text, the number of triangles
constexpr std::size_t kBinaryTriangle = 50;  // normal, three vertices, two bytes of attributes

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(file.string() + ": " + why);
}

/// Triangles that the head of a binary STL promises.
std::size_t promised_triangles(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Checks the skeleton of an ASCII STL, which assimp takes as it comes: each facet with its three vertices of three
/// numbers, and the end. @returns the number of triangles.
std::size_t check_ascii(const std::filesystem::path& file, std::string_view bytes) {
  std::size_t facets = 0, ends = 0, vertices = 0, at = 0;
  bool closed = false;
  while (at < bytes.size()) {
    while (at < bytes.size() && is_space(bytes[at])) ++at;
    const std::size_t begin = at;
    while (at < bytes.size() && !is_space(bytes[at])) {
      if (static_cast<unsigned char>(bytes[at]) < 0x20) refuse(file, "neither binary nor ASCII STL");
      ++at;
    }
    const std::string_view word = bytes.substr(begin, at - begin);
    if (word == "facet") ++facets;
    if (word == "vertex") ++vertices;
    if (word == "endfacet") {
      ++ends;
      if (ends != facets || vertices != 3 * facets) {
        refuse(file, "facet " + std::to_string(ends) + " has not three vertices");
      }
    }
    if (word == "endsolid") closed = true;
    if (word == "solid") closed = false;
  }
  if (!closed || ends != facets) refuse(file, "truncated: the ASCII STL does not end with 'endsolid'");
  return facets;
}

/// @returns the number of triangles that an intact file of this form has.
std::size_t check_form(const std::filesystem::path& file, std::string_view bytes) {
  if (bytes.empty()) refuse(file, "empty; an STL file is needed");
  if (bytes.size() >= kBinaryHead && bytes.size() == kBinaryHead + kBinaryTriangle * promised_triangles(bytes)) {
    return promised_triangles(bytes);
  }
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && bytes.substr(first).starts_with("solid")) return check_ascii(file, bytes);
  if (bytes.size() < kBinaryHead) refuse(file, "truncated: too short for an STL file");
  const std::size_t promised = promised_triangles(bytes);
  const std::size_t present = (bytes.size() - kBinaryHead) / kBinaryTriangle;
  refuse(file, std::string(present < promised ? "truncated" : "not an STL file") + ": its head promises " +
                   std::to_string(promised) + " triangles, but it holds " + std::to_string(present));
}

void append(const std::filesystem::path& file, const aiMesh& part, TriangleMesh& mesh) {
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) refuse(file, "holds a face that is no triangle");
    std::array<std::uint32_t, 3> triangle{};
    for (unsigned i = 0; i < 3; ++i) {
      if (face.mIndices[i] >= part.mNumVertices) refuse(file, "holds a triangle without its vertices");
      const aiVector3D& v = part.mVertices[face.mIndices[i]];
      const Eigen::Vector3f vertex(v.x, v.y, v.z);
      if (!vertex.allFinite()) {
        refuse(file, "triangle " + std::to_string(mesh.triangles.size()) + " has a vertex that is not finite");
      }
      triangle[i] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(vertex);
    }
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& file) {
  const std::string bytes = read_file_bytes(file, kMostBytes);
  const std::size_t expected = check_form(file, bytes);
  if (expected == 0) refuse(file, "has no triangles");
  if (expected > kMostTriangles) {
    refuse(file, "has " + std::to_string(expected) + " triangles, more than the " + std::to_string(kMostTriangles) +
                     " that are accepted; simplify the mesh");
  }
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "stl");
  if (!scene) refuse(file, std::string("not a readable STL file: ") + importer.GetErrorString());
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * expected);
  mesh.triangles.reserve(expected);
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(file, *scene->mMeshes[i], mesh);
  if (mesh.triangles.size() != expected) {
    refuse(file, "malformed: " + std::to_string(expected) + " triangles are announced, " +
                     std::to_string(mesh.triangles.size()) + " could be read");
  }
  return mesh;
}

}  // namespace skein::sim
