#include "scenes/files/mesh_file.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>
#include <vector>

#include "scenes/files/scratch_files.hpp"

namespace skein::sim {
namespace {

using MeshFile = ScratchFiles;
using Triangle = std::array<Eigen::Vector3f, 3>;

const std::vector<Triangle> kTriangles = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                          {{{0, 0, 1.5F}, {1, 0, -2.25F}, {0, 1, 1e-3F}}},
                                          {{{10, 20, 30}, {11, 20, 30}, {10, 21, 30}}}};

void append_bytes(std::string& bytes, const auto& value) {
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

TEST_F(MeshFile, TheContentDecidesOnTheFormatNotTheName) {
  expect_triangles(read_mesh(write("mesh.dat", binary_stl(kTriangles, "solid, says this binary file"))));
}

TEST_F(MeshFile, AnErrorSaysWhatIsWrong) {
  const auto wrong = [&](const std::string& bytes) { return complaint(read_mesh, write("x.stl", bytes)); };
  const std::string binary = binary_stl(kTriangles);
  const std::string ascii = ascii_stl(kTriangles);
  EXPECT_NE(complaint(read_mesh, folder_ / "none.stl").find("none.stl: no such file"), std::string::npos);
  EXPECT_NE(complaint(read_mesh, folder_).find("not a regular file"), std::string::npos);
  EXPECT_NE(wrong("").find("empty"), std::string::npos);
  EXPECT_NE(wrong("not a mesh").find("too short"), std::string::npos);
  EXPECT_NE(wrong(binary_stl({})).find("has no triangles"), std::string::npos);
  EXPECT_NE(wrong("solid nothing\nendsolid nothing\n").find("has no triangles"), std::string::npos);
  EXPECT_NE(wrong(binary.substr(0, binary.size() - 60)).find("truncated, or not an STL file: its head promises 3"),
            std::string::npos);
  EXPECT_NE(wrong(ascii.substr(0, ascii.size() - 40)).find("truncated"), std::string::npos);
  EXPECT_NE(wrong(binary + "more").find("a binary STL has 234 bytes, not 238"), std::string::npos);
  const std::string says_solid = binary_stl(kTriangles, "solid, but binary");
  EXPECT_NE(wrong(says_solid.substr(0, says_solid.size() - 1)).find("truncated, or not an STL file"),
            std::string::npos);
  auto bad = kTriangles;
  bad[1][2].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(wrong(binary_stl(bad)).find("triangle 1 has a vertex that is not finite"), std::string::npos);
  bad[1][2].y() = std::numeric_limits<float>::infinity();
  EXPECT_NE(wrong(binary_stl(bad)).find("triangle 1 has a vertex that is not finite"), std::string::npos);
}

TEST_F(MeshFile, RefusesAnAbsurdNumberOfTriangles) {
  for (const std::uint32_t count : {2'000'001u, 10'000'000u}) {
    std::string bytes = binary_stl({});
    std::memcpy(bytes.data() + 80, &count, sizeof count);
    const auto file = write("huge.stl", bytes);
    std::filesystem::resize_file(file, 84 + 50ull * count);  // sparse
    EXPECT_NE(complaint(read_mesh, file).find("has " + std::to_string(count) + " triangles, more than the 2000000"),
              std::string::npos);
  }
}

TEST_F(MeshFile, AsciiMayBeWrittenInManyWays) {
  const std::string text =
      "\n SOLID facet of a house\r\n"
      "FACET NORMAL nan nan -nan(ind)\r\nouter loop\r\nvertex +0 0 0\r\nvertex 1.0E0 0 1e-60\r\n"
      "vertex -0.0 1e0 0\r\nendloop\r\nendfacet\r\nendsolid\r\nsolid another\nendsolid another\n";
  const TriangleMesh mesh = read_mesh(write("a.stl", text));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[1], Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3f(0, 1, 0));
}

/// Numbers in all notations, with integer and decimal parts of 64 bits and more.
TEST_F(MeshFile, AsciiNumbersAreReadToOneUnitInTheLastPlace) {
  for (const char* number :
       {"0.1", "-0.1", "1.23456789e-3", "-98765.4321", "123456789012345678901234567890e-26",
        "1000000000000000000000e-20", "0.0000000000000000000000000000123e30", "99999.99",
        "3.14159265358979323846264338327950288", "1E+4", "7.", ".5", "0.001e0000000000000000000000001", "2.5e-7"}) {
    std::string text = ascii_stl({kTriangles[0]});
    text.replace(text.find("vertex 1 0 0"), 12, std::string("vertex 1 ") + number + " 0");
    const float expected = std::strtof(number, nullptr), read = read_mesh(write("n.stl", text)).vertices.at(1).y();
    EXPECT_GE(read, std::nextafter(expected, -1e9F)) << number;
    EXPECT_LE(read, std::nextafter(expected, 1e9F)) << number;
  }
}

TEST_F(MeshFile, HeaderAndAttributesOfABinaryFileAreIgnored) {
  using namespace std::string_literals;
  for (const std::string& head : {"\xef\xbb\xbf with a byte order mark"s, "\xff\xfe"s, "\xff\xfe\0\0"s, "\xfe\xff"s,
                                  std::string(74, ' ') + "COLOR=", "COLOR=\xff\xff\xff\xff"s}) {
    std::string bytes = binary_stl(kTriangles, head);
    for (std::size_t end = 84 + 50; end <= bytes.size(); end += 50) bytes.replace(end - 2, 2, "\xff\xff");
    expect_triangles(read_mesh(write("h.stl", bytes)));
  }
}

TEST_F(MeshFile, AnErrorInAsciiNamesItsLine) {
  const std::string ascii = ascii_stl(kTriangles);
  const auto wrong = [&](const std::string& old, const std::string& replacement) {
    std::string text = ascii;
    return complaint(read_mesh, write("x.stl", text.replace(text.find(old), old.size(), replacement)));
  };
  EXPECT_NE(wrong("vertex 1 0 0", "vertex 1 0,5 0").find("x.stl:5: not an ASCII STL: a number is needed, not '0,5'"),
            std::string::npos);
  EXPECT_NE(wrong("vertex 1 0 0", "vertex 1 0").find("x.stl:6: not an ASCII STL: a number is needed, not 'vertex'"),
            std::string::npos);
  EXPECT_NE(wrong("    endloop", "      vertex 1 1 1\n    endloop").find("'endloop' is needed, not 'vertex'"),
            std::string::npos);
  EXPECT_NE(wrong("vertex 1 0 0", "vertex nan 0 0").find("triangle 0 has a vertex that is not finite"),
            std::string::npos);
  EXPECT_NE(wrong("vertex 1 0 0", "vertex 1e39 0 0").find("triangle 0 has a vertex that is not finite"),
            std::string::npos);
  EXPECT_NE(wrong("vertex 1 0 0", "vertex 2e5 0 0").find("triangle 0 has a vertex farther than 100 km"),
            std::string::npos);
}

TEST_F(MeshFile, TrianglesWithoutAreaAreKept) {
  auto triangles = kTriangles;
  triangles[1] = {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  triangles[2] = {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}};
  EXPECT_EQ(read_mesh(write("d.stl", binary_stl(triangles))).triangles.size(), 3u);
}

TEST_F(MeshFile, AWrittenMeshReadsBackBitForBit) {
  TriangleMesh shared{{{0, 0, 0}, {1e-30F, -0.0F, 3}, {0.1F, 2, 3}, {4, 5, 6}}, {{2, 1, 0}, {1, 3, 2}, {0, 0, 0}}};
  const TriangleMesh read = read_mesh(write("m.stl", to_stl(shared)));
  ASSERT_EQ(read.triangles.size(), shared.triangles.size());
  for (std::size_t t = 0; t < read.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3f &a = read.vertices[read.triangles[t][corner]],
                            &b = shared.vertices[shared.triangles[t][corner]];
      EXPECT_EQ(std::memcmp(a.data(), b.data(), sizeof a), 0) << t;
    }
  }
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
