#include "scenes/files/box_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "core/math/random_stream.hpp"
#include "scenes/files/mesh_file.hpp"
#include "scenes/files/scratch_files.hpp"

namespace skein::sim {
namespace {

using BoxFile = ScratchFiles;

const std::string kBoxes = R"(# two boxes
tower:
  center: [1, 2, 3]
  size: [4, 6, 8]
  orientation:
    [0.6, -0.8, 0, 100,
     0.8,  0.6, 0, 200,
     0,    0,   1, 300,
     0,    0,   0, 1]
deck:
  center: [0, 0, 50]
  size: [100, 20, 5]
  orientation: [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 50,  0, 0, 0, 1]
)";

std::string with(const std::string& old, const std::string& replacement) {
  std::string text = kBoxes;
  return text.replace(text.find(old), old.size(), replacement);
}

TEST_F(BoxFile, ReadsBoxesInTheFilesOrder) {
  const auto boxes = read_boxes(write("b.yaml", kBoxes));
  ASSERT_EQ(boxes.size(), 2u);
  EXPECT_EQ(boxes[0].name, "tower");
  EXPECT_EQ(boxes[0].center, Vector3d(1, 2, 3));  // not the matrix's translation
  EXPECT_EQ(boxes[0].size, Vector3d(4, 6, 8));
  EXPECT_TRUE(boxes[0].R_WO.col(0).isApprox(Vector3d(0.6, 0.8, 0), 1e-12));
  EXPECT_TRUE(boxes[0].contains(Vector3d(1, 2, 3) + 1.99 * Vector3d(0.6, 0.8, 0)));
  EXPECT_FALSE(boxes[0].contains(Vector3d(1, 2, 3) + 2.01 * Vector3d(0.6, 0.8, 0)));
  EXPECT_EQ(boxes[1].name, "deck");
  EXPECT_EQ(boxes[1].R_WO, Matrix3d::Identity());
}

TEST_F(BoxFile, RotationsAreOrthonormal) {
  const auto boxes = read_boxes(write("b.yaml", with("0.6, -0.8, 0, 100", "0.60003, -0.79998, 0.00002, 0")));
  EXPECT_LT((boxes[0].R_WO.transpose() * boxes[0].R_WO - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(boxes[0].R_WO.determinant(), 1.0, 1e-14);
}

TEST_F(BoxFile, AnErrorSaysWhatIsWrong) {
  const auto wrong = [&](const std::string& text) { return complaint(read_boxes, write("x.yaml", text)); };
  EXPECT_NE(complaint(read_boxes, folder_ / "none.yaml").find("no such file"), std::string::npos);
  EXPECT_NE(wrong("").find("no boxes"), std::string::npos);
  EXPECT_NE(wrong(with("[1, 2, 3]", "[1, two, 3]")).find("x.yaml:3: tower.center[1]: must be a number"),
            std::string::npos);
  EXPECT_NE(wrong(with("[1, 2, 3]", "[1, 2]")).find("tower.center: must be a list of 3 numbers"), std::string::npos);
  EXPECT_NE(wrong(with("[4, 6, 8]", "[4, -6, 8]")).find("x.yaml:4: tower.size[1]: must be"), std::string::npos);
  EXPECT_NE(wrong(with("  center: [0, 0, 50]\n", "")).find("missing key 'deck.center'"), std::string::npos);
  EXPECT_NE(wrong(with("orientation: [1, 0, 0, 0,  0", "orientation: [0")).find("a list of 16 numbers, not of 12"),
            std::string::npos);
  EXPECT_NE(wrong(with("[1, 0, 0, 0,", "[2, 0, 0, 0,")).find("deck.orientation: the upper left 3x3"),
            std::string::npos);
  EXPECT_NE(wrong(with("[1, 0, 0, 0,", "[-1, 0, 0, 0,")).find("right-handed"), std::string::npos);
  EXPECT_NE(wrong(with("50,  0, 0, 0, 1]", "0,  0, 0, 50, 1]")).find("row-major"), std::string::npos);
  EXPECT_NE(wrong(with("deck", "tower")).find("duplicate key 'tower'"), std::string::npos);
  EXPECT_NE(wrong(with("size: [100", "sise: [100")).find("did you mean 'size'?"), std::string::npos);
}

TEST_F(BoxFile, AnErrorSaysWhyAMatrixIsNoRotation) {
  const auto wrong = [&](const std::string& row) {
    return complaint(read_boxes, write("x.yaml", with("[1, 0, 0, 0,  0, 1, 0, 0,", row)));
  };
  EXPECT_NE(wrong("[1, 0.1, 0, 0,  0, 1, 0, 0,").find("lengths 1, 1.00499, 1 where 1 is needed, and products"),
            std::string::npos);
  EXPECT_NE(wrong("[1, 0.1, 0, 0,  0, 1, 0, 0,").find(" 0.1, 0, 0 where 0 is needed"), std::string::npos);
  EXPECT_NE(wrong("[0, 0, 0, 0,  0, 0, 0, 0,").find("lengths 0, 0, 1"), std::string::npos);
  EXPECT_NE(wrong("[0, 1, 0, 0,  1, 0, 0, 0,")
                .find("x.yaml:13: deck.orientation: the upper left 3x3 must be "
                      "right-handed: its determinant is -1"),
            std::string::npos);
}

TEST_F(BoxFile, WrittenBoxesReadBackBitForBit) {
  std::vector<OrientedBox> boxes;
  for (int i = 0; i < 20; ++i) {
    RandomStream random(1, "boxes", static_cast<std::uint64_t>(i));
    const auto draw = [&](double least, double most) {
      return Vector3d(random.uniform(least, most), random.uniform(least, most), random.uniform(least, most));
    };
    const double angle = random.uniform(-3.0, 3.0);
    const Vector3d axis = i % 2 ? Vector3d(Vector3d::UnitZ()) : Vector3d(draw(-1.0, 1.0).normalized());
    boxes.push_back({"box " + std::to_string(i) + (i % 3 ? "" : ": no"), draw(-50.0, 50.0), draw(1e-3, 100.0),
                     Eigen::AngleAxisd(angle, axis).toRotationMatrix()});
  }
  const auto read = read_boxes(write("b.yaml", to_box_description(boxes)));
  ASSERT_EQ(read.size(), boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_EQ(read[i].name, boxes[i].name);
    EXPECT_EQ(read[i].center, boxes[i].center);
    EXPECT_EQ(read[i].size, boxes[i].size);
    EXPECT_EQ(read[i].R_WO, boxes[i].R_WO) << i;
  }
}

TEST_F(BoxFile, TheSurfaceIsClosedAndOutward) {
  const OrientedBox box{"b", {1, 2, 3}, {4, 5, 6}, Eigen::AngleAxisd(0.7, Vector3d::UnitX()).toRotationMatrix()};
  const TriangleMesh mesh = box_surface(box);
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume +=
        mesh.vertices[a].cast<double>().dot(mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>())) /
        6.0;
  }
  EXPECT_NEAR(volume, 4.0 * 5.0 * 6.0, 1e-3);
}

/// The meshes box*.stl beside the official file show where the boxes really are.
TEST_F(BoxFile, OfficialBoxesStandWhereTheirMeshesDo) {
  const char* assets = std::getenv("SKEIN_ASSETS");
  if (!assets) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  for (const char* scene : {"mbs", "crane"}) {
    const auto folder = std::filesystem::path(assets) / "models" / scene / "bounding_boxes";
    const auto boxes = read_boxes(folder / "box_description.yaml");
    EXPECT_EQ(boxes.size(), scene == std::string("mbs") ? 4u : 15u);
    for (const OrientedBox& box : boxes) {
      for (const Eigen::Vector3f& vertex : read_mesh(folder / (box.name + ".stl")).vertices) {
        const Vector3d p_O = box.R_WO.transpose() * (vertex.cast<double>() - box.center);
        EXPECT_TRUE((p_O.cwiseAbs() - 0.5 * box.size).cwiseAbs().maxCoeff() < 1e-3) << scene << ' ' << box.name;
      }
    }
  }
}

}  // namespace
}  // namespace skein::sim
