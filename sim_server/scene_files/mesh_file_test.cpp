#include "sim_server/scene_files/mesh_file.hpp"

#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>
#include <vector>

#include "sim_server/scene_files/scratch_files.hpp"

namespace skein::sim {
namespace {

using MeshFile = ScratchFiles;
using Triangle = std::array<Eigen::Vector3f, 3>;

const std::vector<Triangle> kTriangles = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                          {{{0, 0, 1.5F}, {1, 0, -2.25F}, {0, 1, 1e-3F}}},
                                          {{{10, 20, 30}, {11, 20, 30}, {10, 21, 30}}}};

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string binary_stl(const std::vector<Triangle>& triangles, const std::string& head = "made by a test") {
  std::string bytes = head;
  bytes.resize(80);
  append_bytes(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    bytes.append(12, '\0');  // no normal, as in the benchmark's files
    for (const Eigen::Vector3f& vertex : triangle) {
      for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, vertex[axis]);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string ascii_stl(const std::vector<Triangle>& triangles) {
  std::ostringstream text;
  text << "solid test\n";
  for (const Triangle& triangle : triangles) {
    text << "  facet normal 0 0 0\n    outer loop\n";
    for (const Eigen::Vector3f& v : triangle) {
      text << "      vertex " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid test\n";
  return text.str();
}

void expect_triangles(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.triangles.size(), kTriangles.size());
  for (std::size_t i = 0; i < kTriangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      EXPECT_TRUE(mesh.vertices.at(mesh.triangles[i][corner]).isApprox(kTriangles[i][corner], 1e-6F)) << i;
    }
  }
}

TEST_F(MeshFile, ReadsBinaryAndAscii) {
  expect_triangles(read_mesh(write("b.stl", binary_stl(kTriangles))));
  expect_triangles(read_mesh(write("a.stl", ascii_stl(kTriangles))));
}

TEST_F(MeshFile, GoesByTheContentNotByTheName) {
  expect_triangles(read_mesh(write("mesh.dat", binary_stl(kTriangles, "solid, says this binary file"))));
}

TEST_F(MeshFile, SaysWhatIsWrong) {
  const auto wrong = [&](const std::string& bytes) { return complaint(read_mesh, write("x.stl", bytes)); };
  const std::string binary = binary_stl(kTriangles);
  const std::string ascii = ascii_stl(kTriangles);
  EXPECT_NE(complaint(read_mesh, folder_ / "none.stl").find("none.stl: no such file"), std::string::npos);
  EXPECT_NE(complaint(read_mesh, folder_).find("not a regular file"), std::string::npos);
  EXPECT_NE(wrong("").find("empty"), std::string::npos);
  EXPECT_NE(wrong("not a mesh").find("too short"), std::string::npos);
  EXPECT_NE(wrong(binary_stl({})).find("has no triangles"), std::string::npos);
  EXPECT_NE(wrong("solid nothing\nendsolid nothing\n").find("has no triangles"), std::string::npos);
  EXPECT_NE(wrong(binary.substr(0, binary.size() - 60)).find("truncated: its head promises 3 triangles"),
            std::string::npos);
  EXPECT_NE(wrong(ascii.substr(0, ascii.size() - 40)).find("truncated"), std::string::npos);
  EXPECT_NE(wrong(binary + "more").find("not an STL file"), std::string::npos);
  auto bad = kTriangles;
  bad[1][2].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(wrong(binary_stl(bad)).find("triangle 1 has a vertex that is not finite"), std::string::npos);
  bad[1][2].y() = std::numeric_limits<float>::infinity();
  EXPECT_NE(wrong(binary_stl(bad)).find("triangle 1 has a vertex that is not finite"), std::string::npos);
}

TEST_F(MeshFile, RefusesAnAbsurdNumberOfTriangles) {
  std::string bytes = binary_stl({});
  const std::uint32_t count = 5'000'001;
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  const auto file = write("huge.stl", bytes);
  std::filesystem::resize_file(file, 84 + 50ull * count);  // sparse
  EXPECT_NE(complaint(read_mesh, file).find("more than the 5000000"), std::string::npos);
}

TEST_F(MeshFile, DamageIsHarmless) {
  expect_only_input_errors(binary_stl(kTriangles), read_mesh);
  expect_only_input_errors(ascii_stl(kTriangles), read_mesh);
}

TEST_F(MeshFile, ReadsTheOfficialMeshes) {
  const char* assets = std::getenv("SKEIN_ASSETS");
  if (!assets) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  const std::filesystem::path models = std::filesystem::path(assets) / "models";
  const TriangleMesh mbs = read_mesh(models / "mbs" / "mbs.stl");
  EXPECT_EQ(mbs.triangles.size(), 67956u);
  Eigen::AlignedBox3f extent;
  for (const auto& vertex : mbs.vertices) extent.extend(vertex);
  EXPECT_NEAR(extent.sizes().x(), 142.0F, 1.0F);
  EXPECT_NEAR(extent.sizes().y(), 65.0F, 1.0F);
  EXPECT_NEAR(extent.sizes().z(), 60.0F, 1.0F);
  EXPECT_FALSE(read_mesh(models / "crane" / "construction_crane_1.stl").triangles.empty());
  EXPECT_FALSE(read_mesh(models / "crane" / "construction_crane_2.stl").triangles.empty());
}

}  // namespace
}  // namespace skein::sim
