// The extension of a mesh file decides on its format. This file reads STL, and model_file.cpp the others.
//
// Assimp reads the triangles of an STL file. But it accepts malformed ASCII files, for example with commas and numbers
// that overflow, and looks for byte order marks and colours in the header of binary files. So this file checks the
// format first, and gives Assimp a file in the simplest form.
#include "scenes/files/mesh_file.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "core/files/file_bytes.hpp"
#include "scenes/files/limits.hpp"
#include "scenes/files/mesh_checks.hpp"
#include "scenes/files/model_file.hpp"
#include "scenes/files/words.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kBinaryHead = 84;      ///< 80 bytes of text, the number of triangles
constexpr std::size_t kBinaryTriangle = 50;  ///< normal, three vertices, two bytes of attributes
constexpr std::size_t kAttributes = 48;      ///< offset of the attributes in a triangle

/// Number of triangles according to the header of a binary STL.
std::size_t promised_triangles(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kBinaryHead - sizeof count, sizeof count);
  return count;
}

std::size_t binary_size(std::size_t triangles) { return kBinaryHead + kBinaryTriangle * triangles; }

/// Refuses a file with too many triangles after reading its header only.
void refuse_huge_binary(const std::filesystem::path& file) {
  std::error_code ignored;
  std::array<char, kBinaryHead> head{};
  if (!std::filesystem::is_regular_file(file, ignored)) return;
  if (!std::ifstream(file, std::ios::binary).read(head.data(), head.size())) return;
  const std::size_t count = promised_triangles({head.data(), head.size()});
  if (count > kMostTriangles && std::filesystem::file_size(file, ignored) == binary_size(count)) {
    refuse_count(file, std::to_string(count) + " triangles, more");
  }
}

/// A file in the simplest form, which Assimp reads reliably.
struct PlainStl {
  std::string bytes;
  std::size_t triangles = 0;
};

/// The binary file with a blank header and without attributes.
PlainStl plain_binary(const std::filesystem::path& file, std::string bytes) {
  const std::size_t count = promised_triangles(bytes);
  check_count(file, count);
  std::fill_n(bytes.begin(), kBinaryHead - sizeof(std::uint32_t), ' ');
  for (std::size_t i = 0; i < count; ++i) {
    std::memset(bytes.data() + binary_size(i) + kAttributes, 0, kBinaryTriangle - kAttributes);
  }
  return {std::move(bytes), count};
}

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Parses an ASCII STL word by word. Keywords may have any case; the rest of a line after "solid" or "endsolid" is a
/// name, and is ignored.
class AsciiStl {
 public:
  AsciiStl(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {}

  /// The file as one solid without a name, in lower case, with zero normals, and with the shortest numbers without an
  /// exponent.
  PlainStl plain() {
    PlainStl stl{"solid\n", 0};
    bool inside = false;
    for (std::string_view word = next(); !word.empty() || inside; word = next()) {
      if (!inside) {
        if (!is(word, "solid")) wrong("'solid'", word);
        inside = true;
        skip_line();
      } else if (is(word, "endsolid")) {
        inside = false;
        skip_line();
      } else if (is(word, "facet")) {
        if (stl.triangles == kMostTriangles) refuse_count(file_, "more");
        read_facet(stl);
      } else {
        wrong("'facet' or 'endsolid'", word);
      }
    }
    stl.bytes += "endsolid\n";
    check_count(file_, stl.triangles);
    return stl;
  }

 private:
  void read_facet(PlainStl& stl) {
    expect("normal");
    for (int axis = 0; axis < 3; ++axis) {
      if (next().empty()) wrong("a number", {});  // any word is accepted, even "nan": normals are ignored
    }
    expect("outer");
    expect("loop");
    stl.bytes += "facet normal 0 0 0\nouter loop\n";
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      Eigen::Vector3f vertex;
      for (float& coordinate : vertex) coordinate = number();
      check_vertex(file_, stl.triangles, vertex);
      stl.bytes += "vertex";
      for (const float coordinate : vertex) append_plain(stl.bytes, coordinate);
      stl.bytes += '\n';
    }
    expect("endloop");
    expect("endfacet");
    stl.bytes += "endloop\nendfacet\n";
    ++stl.triangles;
  }

  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  static bool is(std::string_view word, std::string_view lower) {
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
  }

  void expect(std::string_view lower) {
    const std::string_view word = next();
    if (!is(word, lower)) wrong("'" + std::string(lower) + "'", word);
  }

  float number() {
    const std::string_view word = next();
    const std::optional<float> value = parsed_float(word);
    if (!value) wrong("a number", word);
    return *value;
  }

  [[noreturn]] void wrong(const std::string& wanted, std::string_view word) const {
    if (word.empty()) refuse(file_, "truncated: the ASCII STL ends where " + wanted + " is needed");
    throw InputError(file_.string() + ":" + std::to_string(line_) + ": not an ASCII STL: " + wanted +
                     " is needed, not '" + shown(word) + "'");
  }

  const std::filesystem::path& file_;
  const std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

[[noreturn]] void refuse_form(const std::filesystem::path& file, std::string_view bytes) {
  if (bytes.size() < kBinaryHead) refuse(file, "truncated: too short for an STL file");
  const std::size_t promised = promised_triangles(bytes);
  const std::string state = bytes.size() < binary_size(promised) ? "truncated, or not an STL file" : "not an STL file";
  refuse(file, state + ": its head promises " + std::to_string(promised) + " triangles, for which a binary STL has " +
                   std::to_string(binary_size(promised)) + " bytes, not " + std::to_string(bytes.size()));
}

PlainStl read_plain(const std::filesystem::path& file) {
  refuse_huge_binary(file);
  std::string bytes = read_file_bytes(file, kMostBytes);
  if (bytes.empty()) refuse(file, "empty; an STL file is needed");
  // Binary files may begin with "solid", too: the size of the file decides.
  if (bytes.size() >= kBinaryHead && bytes.size() == binary_size(promised_triangles(bytes))) {
    return plain_binary(file, std::move(bytes));
  }
  const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  const bool says_solid = std::string_view(bytes).substr(first).starts_with("solid") ||
                          std::string_view(bytes).substr(first).starts_with("SOLID");
  if (!says_solid || bytes.find('\0') != std::string::npos) refuse_form(file, bytes);
  return AsciiStl(file, bytes).plain();
}

void append(const std::filesystem::path& file, const aiMesh& part, TriangleMesh& mesh) {
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) refuse(file, "holds a face that is not a triangle");
    std::array<std::uint32_t, 3> triangle{};
    for (unsigned i = 0; i < 3; ++i) {
      if (face.mIndices[i] >= part.mNumVertices) refuse(file, "holds a triangle without its vertices");
      const aiVector3D& v = part.mVertices[face.mIndices[i]];
      const Eigen::Vector3f vertex(v.x, v.y, v.z);
      check_vertex(file, mesh.triangles.size(), vertex);
      triangle[i] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(vertex);
    }
    mesh.triangles.push_back(triangle);
  }
}

TriangleMesh read_stl(const std::filesystem::path& file) {
  const PlainStl stl = read_plain(file);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(stl.bytes.data(), stl.bytes.size(), 0, "stl");
  if (!scene) refuse(file, std::string("not a readable STL file: ") + importer.GetErrorString());
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * stl.triangles);
  mesh.triangles.reserve(stl.triangles);
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(file, *scene->mMeshes[i], mesh);
  if (mesh.triangles.size() != stl.triangles) {
    refuse(file, "malformed: " + std::to_string(stl.triangles) + " triangles are announced, " +
                     std::to_string(mesh.triangles.size()) + " could be read");
  }
  return mesh;
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& file) {
  std::string extension = file.extension();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (const auto format = model_format(extension)) return read_model(file, *format);
  if (extension == ".stl") return read_stl(file);
  try {
    return read_stl(file);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) +
                     " (a mesh is read as STL unless its name ends with .obj, .ply, .dae, .glb or .gltf)");
  }
}

std::string to_stl(const TriangleMesh& mesh) {
  std::string bytes(kBinaryHead, '\0');
  const std::string_view title = "binary STL, metres, written by skein";
  std::copy(title.begin(), title.end(), bytes.begin());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(bytes.data() + kBinaryHead - sizeof count, &count, sizeof count);
  bytes.reserve(binary_size(mesh.triangles.size()));
  const auto append = [&](const Eigen::Vector3f& v) {
    bytes.append(reinterpret_cast<const char*>(v.data()), 3 * sizeof(float));
  };
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3f, 3> corners;
    std::transform(triangle.begin(), triangle.end(), corners.begin(), [&](auto i) { return mesh.vertices.at(i); });
    append((corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized());
    for (const Eigen::Vector3f& corner : corners) append(corner);
    bytes.append(kBinaryTriangle - 4 * 3 * sizeof(float), '\0');
  }
  return bytes;
}

}  // namespace skein::sim
