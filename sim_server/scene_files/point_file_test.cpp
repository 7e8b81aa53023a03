#include "sim_server/scene_files/point_file.hpp"

#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "sim_server/scene_files/scratch_files.hpp"

namespace skein::sim {
namespace {

using PointFile = ScratchFiles;

constexpr std::size_t kPoints = 9;

Eigen::Vector3f position(std::size_t i) {
  const auto x = static_cast<float>(i);
  return {x, -2 * x, 0.125F + x};
}
Eigen::Vector3f normal(std::size_t i) {
  return i % 2 ? Eigen::Vector3f(0.6F, 0.0F, -0.8F) : Eigen::Vector3f(0.0F, 1.0F, 0.0F);
}

void expect_points(const std::vector<InterestPoint>& points) {
  ASSERT_EQ(points.size(), kPoints);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(points[i].p_W.isApprox(position(i), 1e-5F)) << i;
    EXPECT_TRUE(points[i].n_W.isApprox(normal(i), 1e-5F)) << i;
  }
}

/// As the benchmark's files are: normals first, a padding field, 28 bytes a point.
std::string padded(const std::string& padding_count = "4") {
  std::string bytes =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
      "FIELDS normal_x normal_y normal_z x y z _\n"
      "SIZE 4 4 4 4 4 4 1\nTYPE F F F F F F U\nCOUNT 1 1 1 1 1 1 " +
      padding_count + "\nWIDTH 9\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 9\nDATA binary\n";
  for (std::size_t i = 0; i < kPoints; ++i) {
    for (const Eigen::Vector3f& vector : {normal(i), position(i)}) {
      for (int axis = 0; axis < 3; ++axis) bytes.append(reinterpret_cast<const char*>(&vector[axis]), 4);
    }
    bytes.append(static_cast<std::size_t>(std::stoi(padding_count)), '\x7f');
  }
  return bytes;
}

std::string ascii(const std::string& first_number = "0") {
  std::ostringstream text;
  text << "VERSION .7\nFIELDS x y z normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\n"
          "WIDTH 3\nHEIGHT 3\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 9\nDATA ascii\n";
  for (std::size_t i = 0; i < kPoints; ++i) {
    text << (i == 0 ? first_number : std::to_string(position(i).x())) << ' ' << position(i).y() << ' '
         << position(i).z() << ' ' << normal(i).x() << ' ' << normal(i).y() << ' ' << normal(i).z() << '\n';
  }
  return text.str();
}

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Field after field instead of point after point, doubles among the floats, in LZF (here without any repetition: a
/// byte n - 1, then n bytes as they are).
std::string compressed() {
  std::string plain;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < kPoints; ++i) append_bytes(plain, static_cast<double>(position(i)[axis]));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < kPoints; ++i) append_bytes(plain, normal(i)[axis]);
  }
  std::string packed;
  for (std::size_t at = 0; at < plain.size(); at += 32) {
    const std::string piece = plain.substr(at, 32);
    packed += static_cast<char>(piece.size() - 1);
    packed += piece;
  }
  std::string bytes =
      "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z\nSIZE 8 8 8 4 4 4\nTYPE F F F F F F\n"
      "COUNT 1 1 1 1 1 1\nWIDTH 9\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 9\n"
      "DATA binary_compressed\n";
  append_bytes(bytes, static_cast<std::uint32_t>(packed.size()));
  append_bytes(bytes, static_cast<std::uint32_t>(plain.size()));
  return bytes + packed;
}

std::string with(std::string bytes, const std::string& old, const std::string& replacement) {
  return bytes.replace(bytes.find(old), old.size(), replacement);
}

TEST_F(PointFile, ReadsWhateverLayoutThePointsHave) {
  expect_points(read_points(write("padded.pcd", padded())));
  expect_points(read_points(write("padded.pcd", padded("21"))));
  expect_points(read_points(write("ascii.pcd", ascii())));
  expect_points(read_points(write("compressed.pcd", compressed())));
}

TEST_F(PointFile, NormalsGetUnitLength) {
  const auto points = read_points(write("long.pcd", with(ascii(), " 0 1 0\n", " 0 5 0\n")));
  EXPECT_EQ(points.at(0).n_W, Eigen::Vector3f(0, 1, 0));
}

TEST_F(PointFile, SaysWhatIsWrong) {
  const auto wrong = [&](const std::string& bytes) { return complaint(read_points, write("x.pcd", bytes)); };
  const auto expect = [&](const std::string& bytes, const std::string& part) {
    const std::string message = wrong(bytes);
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("x.pcd"), std::string::npos) << message;
  };
  EXPECT_NE(complaint(read_points, folder_ / "none.pcd").find("no such file"), std::string::npos);
  expect("", "not a PCD file");
  expect("solid mesh\n", "not a PCD file");
  expect(padded().substr(0, padded().size() - 1), "truncated: 252 bytes of data are needed, 251 are there");
  expect(with(padded(), "normal_z", "curvature"), "has no field 'normal_z'");
  expect(with(padded(), "TYPE F", "TYPE U"), "the field 'normal_x' must be one float");
  expect(with(padded(), "SIZE 4 4 4 4 4 4 1", "SIZE 4 4 4 4 4 4"),
         "x.pcd:4: SIZE: must have one value for each of FIELDS");
  expect(with(padded(), "SIZE 4", "SIZE 3"), "x.pcd:4: SIZE: field 'normal_x' cannot have 3 bytes");
  expect(with(padded(), "COUNT 1", "COUNT 0"), "x.pcd:6: COUNT: must be at least 1");
  expect(with(padded(), "VIEWPOINT", "VEWPOINT"), "x.pcd:9: not a PCD file: its header has no such line");
  expect(with(padded(), "WIDTH 9", "WIDTH 8"), "x.pcd:10: POINTS: must be WIDTH times HEIGHT");
  expect(with(padded(), "POINTS 9", "POINTS 4000000000"),
         "x.pcd:10: POINTS: must be a whole number within [0, 5000000]");
  expect(with(padded(), "POINTS 9", "POINTS nine"), "x.pcd:10: POINTS: must be a whole number");
  expect(with(with(padded(), "POINTS 9", "POINTS 0"), "WIDTH 9", "WIDTH 0"), "POINTS: must be at least 1");
  expect(with(padded(), "DATA binary", "DATA base64"), "x.pcd:11: DATA: must be ascii, binary or binary_compressed");
  expect(with(padded(), "DATA binary", "DATA binary_compressed"), "malformed");
  expect(with(padded(), "HEIGHT 1\n", ""), "HEIGHT: this line of the PCD header is missing");
  expect(with(padded(), "HEIGHT 1", "WIDTH 9"), "WIDTH: is given twice");
  expect(ascii("nan"), "point 0 has a number that is not finite");
  expect(ascii("abc"), "x.pcd:10: 'abc' is not a number");
  expect(ascii("1 2"), "x.pcd:10: must have 6 numbers, not 7");
  expect(ascii().substr(0, ascii().size() - 25), "x.pcd");
  expect(with(ascii(), " 0 1 0\n", " 0 0 0\n"), "point 0 has a normal of no direction");
}

TEST_F(PointFile, DamageIsHarmless) {
  expect_only_input_errors(padded(), read_points);
  expect_only_input_errors(ascii(), read_points);
  expect_only_input_errors(compressed(), read_points);
}

TEST_F(PointFile, ReadsTheOfficialPoints) {
  const char* assets = std::getenv("SKEIN_ASSETS");
  if (!assets) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  const std::filesystem::path models = std::filesystem::path(assets) / "models";
  EXPECT_EQ(read_points(models / "mbs" / "mbs_interest_points.pcd").size(), 3973u);
  EXPECT_EQ(read_points(models / "crane" / "crane_interest_points.pcd").size(), 4935u);
  const auto points = read_points(models / "crane" / "crane_interest_points_on_meshes.pcd");
  EXPECT_EQ(points.size(), 1481u);
  for (const InterestPoint& point : points) EXPECT_NEAR(point.n_W.norm(), 1.0F, 1e-5F);
}

}  // namespace
}  // namespace skein::sim
