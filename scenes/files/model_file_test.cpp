#include "scenes/files/model_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/files/box_file.hpp"
#include "scenes/files/mesh_file.hpp"
#include "scenes/files/scratch_files.hpp"
#include "scenes/files/small_models.hpp"

namespace skein::sim {
namespace {

using Corners = std::vector<std::array<Eigen::Vector3f, 3>>;

TriangleMesh box_mesh() { return box_surface({"b", {1, 2, 3}, {4, 6, 8}, Matrix3d::Identity()}); }

Corners corners(const TriangleMesh& mesh) {
  Corners all;
  for (const auto& [a, b, c] : mesh.triangles) all.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  return all;
}

/// The corners, each moved by a function.
Corners moved(Corners all, const auto& move) {
  for (auto& triangle : all) {
    for (Eigen::Vector3f& corner : triangle) corner = move(corner);
  }
  return all;
}

void expect_near(const Corners& read, const Corners& expected) {
  ASSERT_EQ(read.size(), expected.size());
  for (std::size_t t = 0; t < read.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((read[t][i] - expected[t][i]).norm(), 1e-5F) << t;
  }
}

class ModelFile : public ScratchFiles {
 protected:
  TriangleMesh read(const std::string& name, const std::string& bytes) const { return read_mesh(write(name, bytes)); }

  /// The complaint about a file that has `replacement` instead of `old`.
  std::string wrong(const std::string& name, std::string bytes, const std::string& old = "",
                    const std::string& replacement = "") const {
    const std::size_t at = bytes.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return complaint(read_mesh, write(name, bytes.replace(at, old.size(), replacement)));
  }
};

TEST_F(ModelFile, EveryFormatGivesTheTrianglesOfTheStl) {
  namespace models = small_models;
  const TriangleMesh box = box_mesh();
  const Corners expected = corners(read("box.stl", to_stl(box)));
  EXPECT_EQ(corners(read("box.obj", models::obj(box))), expected);
  EXPECT_EQ(corners(read("ascii.ply", models::ascii_ply(box))), expected);
  EXPECT_EQ(corners(read("little.ply", models::binary_ply(box, false))), expected);
  EXPECT_EQ(corners(read("big.ply", models::binary_ply(box, true))), expected);
  EXPECT_EQ(corners(read("box.dae", models::dae(box))), expected);
  EXPECT_EQ(corners(read("box.glb", models::glb(box))), expected);
  EXPECT_EQ(corners(read("box.gltf", models::gltf(box))), expected);
  EXPECT_EQ(corners(read("BOX.GLB", models::glb(box))), expected) << "extensions may have any case";
}

TEST_F(ModelFile, VerticesAreNotSharedAsInStl) {
  const TriangleMesh mesh = read("box.glb", small_models::glb(box_mesh()));
  ASSERT_EQ(mesh.vertices.size(), 3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_EQ(mesh.triangles[t], (std::array{3 * t, 3 * t + 1, 3 * t + 2}));
  }
}

/// Also for unusual triangles: without area, with one vertex three times, with the vertices of another triangle.
TEST_F(ModelFile, AllTrianglesStayInTheirOrder) {
  const TriangleMesh odd{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0.1F, -1e-7F, 12345.678F}},
                         {{0, 1, 2}, {0, 1, 3}, {4, 4, 4}, {0, 1, 2}, {2, 1, 0}, {4, 2, 0}}};
  const Corners expected = corners(odd);
  for (const bool big_endian : {false, true}) {
    EXPECT_EQ(corners(read("odd.ply", small_models::binary_ply(odd, big_endian))), expected) << "to the bit";
  }
  EXPECT_EQ(corners(read("odd.glb", small_models::glb(odd))), expected) << "to the bit";
  const auto near = [&](const Corners& all) {
    ASSERT_EQ(all.size(), expected.size());
    for (std::size_t t = 0; t < all.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(all[t][i].isApprox(expected[t][i], 1e-5F)) << t;
    }
  };
  near(corners(read("odd.obj", small_models::obj(odd))));
  near(corners(read("odd.dae", small_models::dae(odd))));
}

TEST_F(ModelFile, NodesAreTurnedScaledMirroredAndInstanced) {
  const Corners box = corners(box_mesh());
  const float s = std::sqrt(0.5F);
  // Turned by 90 degrees about the axis that is up, then lifted by 10.
  const std::string gltf_node = "{\"mesh\": 0, \"translation\": [0, 10, 0], \"rotation\": [0, " + std::to_string(s) +
                                ", 0, " + std::to_string(s) + "], \"scale\": [2, 2, 2], \"children\": [1]}, ";
  const auto turned = [](const Eigen::Vector3f& p) { return Eigen::Vector3f(-2 * p.y(), 2 * p.x(), 2 * p.z() + 10); };
  const auto mirrored = [&](const Eigen::Vector3f& p) { return turned({-p.x(), p.y(), p.z()}); };
  Corners expected = moved(box, turned);
  const Corners second = moved(box, mirrored);
  expected.insert(expected.end(), second.begin(), second.end());
  expect_near(
      corners(read("node.glb", small_models::glb(box_mesh(), gltf_node + "{\"mesh\": 0, \"scale\": [-1, 1, 1]}"))),
      expected);
  const std::string instance = "<instance_geometry url=\"#g\"/>";
  expect_near(corners(read("node.dae", small_models::dae(box_mesh(),
                                                         "<node><translate>0 0 1000</translate>"
                                                         "<rotate>0 0 1 90</rotate><scale>2 2 2</scale>" +
                                                             instance + "<node><scale>-1 1 1</scale>" + instance +
                                                             "</node></node>"))),
              expected);
}

TEST_F(ModelFile, AGltfFileNeedNotNameItsScene) {
  const TriangleMesh box = box_mesh();
  std::string text = small_models::gltf(box, "{\"children\": [1]}, {\"mesh\": 0}, {\"mesh\": 0}");
  const std::string named = "\"scene\": 0, ", scenes = "\"scenes\": [{\"nodes\": [0]}],";
  text.erase(text.find(named), named.size());
  EXPECT_EQ(corners(read("first.gltf", text)), corners(box)) << "the first scene is read";
  text.erase(text.find(scenes), scenes.size());
  EXPECT_EQ(corners(read("all.gltf", text)).size(), 2 * box.triangles.size()) << "all nodes are read, each once";
}

TEST_F(ModelFile, ColladaMayHaveAnyAxisUp) {
  const Corners box = corners(box_mesh());
  const auto with = [&](const std::string& up) {
    std::string text = small_models::dae(box_mesh());
    const std::string old = "<up_axis>Z_UP</up_axis>";
    return corners(read("up.dae", text.replace(text.find(old), old.size(), up)));
  };
  const auto y_up = [](const Eigen::Vector3f& p) { return Eigen::Vector3f(p.x(), -p.z(), p.y()); };
  expect_near(with("<up_axis>Y_UP</up_axis>"), moved(box, y_up));
  expect_near(with(""), moved(box, y_up));
  for (const auto& triangle : with("<up_axis>X_UP</up_axis>")) {
    for (const auto& corner : triangle) EXPECT_TRUE(corner.z() > -1.001F && corner.z() < 3.001F) << "x of the box";
  }
}

TEST_F(ModelFile, PolygonsAreDividedAndPointsAndLinesLeftOut) {
  const std::string vertices = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\n";
  const TriangleMesh house = read("h.obj", vertices + "p 1\nl 1 2\nf -5 -4 \\\n-3 -2 -1 # a house\nf 1 2 3 5\n");
  EXPECT_EQ(house.triangles.size(), 5u);
  double area = 0.0;
  for (const auto& [a, b, c] : corners(house)) area += 0.5 * double{(b - a).cross(c - a).norm()};
  EXPECT_NEAR(area, 5.0 + 4.0, 1e-6);
}

TEST_F(ModelFile, AnObjMayHaveAByteOrderMarkAndWindowsLines) {
  const TriangleMesh mesh = read("m.obj",
                                 "\xef\xbb\xbfv 0 0 0\r\nv 1. -.5 1E-01\r\n\tv  0 1 0  0.5 0.5 0.5 # grey\r\n"
                                 "usemtl a b\r\ns off\r\nf 1// \\\r\n2// 3//\r\n");
  EXPECT_EQ(corners(mesh),
            (Corners{{Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, -0.5F, 0.1F), Eigen::Vector3f(0, 1, 0)}}));
}

/// As MeshLab and CloudCompare write it.
TEST_F(ModelFile, APlyMayHaveDoublesAndOtherElements) {
  const std::string ply =
      "ply\r\nformat ascii 1.0\r\nobj_info of a scan\r\nelement vertex 3\r\nproperty double x\r\nproperty double y\r\n"
      "property double z\r\nproperty float nx\r\nelement face 1\r\nproperty list uchar uint vertex_index\r\n"
      "property list uchar float texcoord\r\nelement edge 1\r\nproperty int vertex1\r\nend_header\r\n"
      "0 0 0 nan\r\n1. 0 0 -nan(ind)\r\n0 1 1e-1 1\r\n3 0 1 2 2 .5 .5\r\n0\r\n";
  EXPECT_EQ(corners(read("m.ply", ply)),
            (Corners{{Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 1, 0.1F)}}));
}

TEST_F(ModelFile, AColladaFileMayHaveEmptyObjectsAndSpacesInTexts) {
  const Corners box = corners(box_mesh());
  const auto with = [&](const std::string& up) {
    std::string text = small_models::dae(box_mesh(),
                                         "<node><instance_geometry url=\"#e\"/></node>"
                                         "<node id=\"n\"><instance_geometry url=\"#g\"/></node>");
    const std::string first = "<library_geometries>";
    text.insert(
        text.find(first) + first.size(),
        "<geometry id=\"e\"><mesh><source id=\"ep\"><float_array id=\"ea\" count=\"0\"/><technique_common>"
        "<accessor source=\"#ea\" count=\"0\" stride=\"3\"><param name=\"X\" type=\"float\"/></accessor>"
        "</technique_common></source><vertices id=\"ev\"><input semantic=\"POSITION\" source=\"#ep\"/></vertices>"
        "<polylist count=\"0\"><input semantic=\"VERTEX\" source=\"#ev\" offset=\"0\"/><vcount></vcount><p></p>"
        "</polylist></mesh></geometry>");
    return corners(read("m.dae", text.replace(text.find("Z_UP"), 4, up)));
  };
  expect_near(with("Z_UP"), box);
  expect_near(with("\n  Z_UP\n"), box);
}

/// If primitives share vertices, the reader gives each only those that it uses. Otherwise a small file could need much
/// memory.
TEST_F(ModelFile, PrimitivesOfGltfMayShareTheVerticesOfAModel) {
  TriangleMesh mesh{std::vector<Eigen::Vector3f>(20'000, {1, 2, 3}), {{19'999, 0, 1}}};
  mesh.vertices[1] = {4, 5, 6};
  std::string text = small_models::gltf(mesh);
  const std::string one = "{\"attributes\": {\"POSITION\": 0}, \"indices\": 1, \"material\": 0}";
  std::string more;
  for (int i = 0; i < 99; ++i) more += one + ", ";
  text.insert(text.find(one), more);
  EXPECT_EQ(corners(read("m.gltf", text)), Corners(100, corners(mesh).front()));
}

TEST_F(ModelFile, AnErrorListsTheAcceptedExtensions) {
  for (const char* name : {"box.fbx", "box", "box.stl.bak", ".obj"}) {
    EXPECT_NE(wrong(name, small_models::obj(box_mesh())).find("unless its name ends with .obj, .ply, .dae, .glb or"),
              std::string::npos)
        << name;
  }
}

/// Each line: what to replace in a sound file, by what, and a part of the message.
using Mistakes = std::vector<std::array<std::string, 3>>;

TEST_F(ModelFile, AnErrorSaysWhatIsWrongInObjAndPly) {
  const std::string obj = small_models::obj(box_mesh());
  const Mistakes in_obj = {
      {"v -1 -1 -1", "v -1 0,5 -1", "x.obj:6: not a readable OBJ: a number is needed, not '0,5'"},
      {"v -1 -1 -1", "v -1 -1", "a vertex needs three numbers"},
      {"v -1 -1 -1", "v -1 nan -1", "not finite, or farther than 100 km"},
      {"v -1 -1 -1", "v -1 2e5 -1", "not finite, or farther than 100 km"},
      {"/1/1", "9/1/1", "a vertex that does not precede it"},
      {"/1/1", "x/1/1", "the number of a vertex is needed"},
      {"\nf ", "\nf 1 2\nf ", "at least three vertices"},
  };
  for (const auto& [old, replacement, message] : in_obj) {
    EXPECT_NE(wrong("x.obj", obj, old, replacement).find(message), std::string::npos) << message;
  }
  EXPECT_NE(wrong("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\n").find("has no triangles"), std::string::npos);
  const std::string ply = small_models::ascii_ply(box_mesh());
  const Mistakes in_ply = {
      {"ply\n", "PLY\n", "does not begin with 'ply'"},
      {"float x", "float u", "need the properties x, y and z"},
      {"float x", "floot x", "unknown type 'floot'"},
      {"format ascii", "format binary_little_endian", "not a readable PLY"},
      {"vertex_indices", "corners", "no list 'vertex_indices'"},
      {"element face 12", "element face 13", "truncated"},
      {"element face 12", "element face 99999999999", "promises more than the file can hold"},
      {"\n3 0 ", "\n3 990 ", "a vertex that the file does not have"},
  };
  for (const auto& [old, replacement, message] : in_ply) {
    EXPECT_NE(wrong("x.ply", ply, old, replacement).find(message), std::string::npos) << message;
  }
  const std::string bare =
      "ply\nformat ascii 1.0\nelement vertex 3\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "3 0 1 2\n";
  EXPECT_NE(wrong("x.ply", bare).find("its vertices need the properties x, y and z"), std::string::npos);
}

TEST_F(ModelFile, AnErrorSaysWhatIsWrongInColladaAndGltf) {
  const std::string dae = small_models::dae(box_mesh());
  const std::string node = "<node id=\"n\">";
  const Mistakes in_dae = {
      {"</COLLADA>", "", "not a readable COLLADA file"},
      {"meter=\"0.01\"", "meter=\"0\"", "not a positive number of metres"},
      {"meter=\"0.01\"", "meter=\"1e6\"", "farther than 100 km"},
      {"count=\"24\"", "count=\"25\"", "must be a whole number below 25"},
      {"count=\"8\"", "count=\"9\"", "more numbers than its float_array has"},
      {node, node + "<instance_node url=\"#n\"/>", "or contain each other"},
      {"url=\"#g\"", "url=\"other.dae#g\"", "needs another file"},
      {"url=\"#g\"", "url=\"#h\"", "'#h', but no geometry has this id"},
      {node, node + "<instance_node url=\"#h\"/>", "'#h', but no node has this id"},
      {"<instance_geometry url=\"#g\"/>", "", "has no triangles"},
      {node, node + "<instance_controller url=\"#c\"/>", "export without them"},
  };
  for (const auto& [old, replacement, message] : in_dae) {
    EXPECT_NE(wrong("x.dae", dae, old, replacement).find(message), std::string::npos) << message;
  }
  const std::string gltf = small_models::gltf(box_mesh());
  const Mistakes in_gltf = {
      {"\"2.0\"", "\"1.0\"", "version '1.0' instead of 2.0"},
      {"{\"asset\"", "{asset", "not a JSON object"},
      {"\"scene\": 0", "\"scene\": 1", "'scene' must be a whole number below 1"},
      {"\"count\": 8", "\"count\": 9999", "truncated"},
      {"\"count\": 8", "\"count\": 7", "a vertex that the file does not have"},
      {"5126", "5123", "positions must be floats"},
      {"{\"mesh\": 0}", "{\"mesh\": 0, \"children\": [0]}", "two parents"},
      {"{\"mesh\": 0}", "{\"mesh\": 0, \"scale\": [1, 1]}", "the scale of a node must have 3 finite numbers"},
      {"{\"mesh\": 0}", "{\"mesh\": 0, \"scale\": [1, 1, 1e9]}", "farther than 100 km"},
      {"\"scene\"", "\"extensionsUsed\": [\"KHR_draco_mesh_compression\"], \"scene\"", "export without it"},
      {"data:", "box.bin?", "in another file, 'box.bin?application"},
  };
  for (const auto& [old, replacement, message] : in_gltf) {
    EXPECT_NE(wrong("x.gltf", gltf, old, replacement).find(message), std::string::npos) << message;
  }
  const std::string glb = small_models::glb(box_mesh());
  EXPECT_NE(wrong("x.glb", glb.substr(0, glb.size() - 4)).find("truncated, or damaged"), std::string::npos);
  EXPECT_NE(wrong("x.glb", "").find("empty; a mesh is needed"), std::string::npos);
  EXPECT_NE(complaint(read_mesh, folder_ / "none.glb").find("none.glb: no such file"), std::string::npos);
}

}  // namespace
}  // namespace skein::sim
