#include "scenes/files/point_file.hpp"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "core/files/file_bytes.hpp"
#include "scenes/files/scratch_files.hpp"

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

void append_field(std::string& bytes, const auto& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Packed data with their sizes.
std::string sized(const std::string& packed, std::size_t unpacked) {
  std::string bytes;
  append_field(bytes, static_cast<std::uint32_t>(packed.size()));
  append_field(bytes, static_cast<std::uint32_t>(unpacked));
  return bytes + packed;
}

/// Field after field instead of point after point, doubles among the floats, in LZF (here without any repetition: a
/// byte n - 1, then n bytes as they are).
/// @param padding  bytes of it that come first in the data, of each point.
std::string compressed(std::size_t padding = 0) {
  std::string plain(kPoints * padding, '\x7f');
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < kPoints; ++i) append_field(plain, static_cast<double>(position(i)[axis]));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < kPoints; ++i) append_field(plain, normal(i)[axis]);
  }
  std::string packed;
  for (std::size_t at = 0; at < plain.size(); at += 32) {
    const std::string piece = plain.substr(at, 32);
    packed += static_cast<char>(piece.size() - 1);
    packed += piece;
  }
  return "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z\nSIZE 8 8 8 4 4 4\nTYPE F F F F F F\n"
         "COUNT 1 1 1 1 1 1\nWIDTH 9\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 9\n"
         "DATA binary_compressed\n" +
         sized(packed, plain.size());
}

/// One point of 24 bytes, packed by hand. @param stream  of LZF.
std::string packed_by_hand(std::initializer_list<int> stream, std::size_t unpacked = 24) {
  std::string packed;
  for (const int byte : stream) packed += static_cast<char>(byte);
  return "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\n"
         "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary_compressed\n" +
         sized(packed, unpacked);
}

std::string with(std::string bytes, const std::string& old, const std::string& replacement) {
  return bytes.replace(bytes.find(old), old.size(), replacement);
}

TEST_F(PointFile, ReadsPointsInEachLayout) {
  expect_points(read_points(write("padded.pcd", padded())));
  expect_points(read_points(write("padded.pcd", padded("21"))));
  expect_points(read_points(write("ascii.pcd", ascii())));
  expect_points(read_points(write("compressed.pcd", compressed())));
}

TEST_F(PointFile, NormalsGetUnitLength) {
  const auto points = read_points(write("long.pcd", with(ascii(), " 0 1 0\n", " 0 5 0\n")));
  EXPECT_EQ(points.at(0).n_W, Eigen::Vector3f(0, 1, 0));
}

TEST_F(PointFile, AnErrorSaysWhatIsWrong) {
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
  expect(with(ascii(), "FIELDS x y z", "FIELDS x y y"), "x.pcd:2: FIELDS: 'y' is named twice");
  expect(ascii("1e6"), "point 0 is farther than 100 km");
  expect(ascii("nan"), "point 0 has a number that is not finite");
  expect(ascii("+-5"), "x.pcd:10: '+-5' is not a number");
  expect(ascii("abc"), "x.pcd:10: 'abc' is not a number");
  expect(ascii("\x1b[31mabc"), "x.pcd:10: '?[31mabc' is not a number");
  expect(with(padded(), "DATA binary", "DATA \x1b" + std::string(99, 'x')), "not '?" + std::string(39, 'x') + "'");
  expect(with(padded(), "POINTS 9", "POINTS \x1b" + std::string(99, '9')), "not '?" + std::string(39, '9') + "'");
  expect(ascii("1 2"), "x.pcd:10: must have 6 numbers, not 7");
  expect(ascii().substr(0, ascii().size() - 25), "x.pcd");
  expect(with(ascii(), " 0 1 0\n", " 0 0 0\n"), "point 0 has a normal of no direction");
}

TEST_F(PointFile, FieldsMayStandInAnyOrderAmongOthers) {
  const std::string mixed =
      "VERSION 0.7\r\nFIELDS rgb normal_z x histogram y normal_x z normal_y\r\nSIZE 4 4 8 2 4 4 4 4\r\n"
      "TYPE U F F I F F F F\r\nCOUNT 1 1 1 3 1 1 1 1\r\nWIDTH 1\r\nHEIGHT 1\r\nVIEWPOINT 0 0 0 1 0 0 0\r\n"
      "POINTS 1\r\nDATA ";
  std::string binary = mixed + "binary\n";
  append_field(binary, std::uint32_t{7});
  append_field(binary, -0.8F);
  append_field(binary, 1.5);
  binary.append(6, '\x7f');
  for (const float number : {2.5F, 0.6F, 3.5F, 0.0F}) append_field(binary, number);
  const std::string text = mixed + "ascii\r\n4294967295 -0.8 +1.5 -1 -2 -3 2.5 0.6 3.5 0\r\n\r\n";
  for (const std::string& bytes : {binary, text}) {
    const auto points = read_points(write("mixed.pcd", bytes));
    ASSERT_EQ(points.size(), 1u);
    EXPECT_EQ(points[0].p_W, Eigen::Vector3f(1.5F, 2.5F, 3.5F));
    EXPECT_EQ(points[0].n_W, Eigen::Vector3f(0.6F, 0.0F, -0.8F));
  }
}

TEST_F(PointFile, PackedDataMayHaveTheirPaddingOrNot) {
  for (const std::size_t padding : {0u, 12u}) {
    const std::string named =
        with(with(with(compressed(padding), "FIELDS x", "FIELDS _ x"), "SIZE 8", "SIZE 1 8"), "TYPE F", "TYPE U F");
    expect_points(read_points(write("named.pcd", with(named, "COUNT 1", "COUNT 12 1"))));
  }
}

/// After a byte n below 32, n + 1 literal bytes follow. Any other byte begins a repetition: it has the length in its
/// upper 3 bits (7: one more byte of length follows), and the distance in its lower 5 bits and the last byte.
TEST_F(PointFile, PackedDataMayRepeatThemselves) {
  const auto points = read_points(write("r.pcd", packed_by_hand({3, 0, 0, 0x80, 0x3f, 7 << 5, 11, 3})));  // 20 times
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].p_W, Eigen::Vector3f(1, 1, 1));
  EXPECT_TRUE(points[0].n_W.isApprox(Eigen::Vector3f(1, 1, 1).normalized()));
}

TEST_F(PointFile, MalformedPackedDataAreRefused) {
  const auto expect = [&](const std::string& bytes, const std::string& part) {
    const std::string message = complaint(read_points, write("x.pcd", bytes));
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  constexpr int kLong = 7 << 5;
  expect(packed_by_hand({}), "malformed: the data do not unpack");
  expect(packed_by_hand({3, 0, 0, 0x80, 0x3f, kLong, 11, 4}), "do not unpack");        // before the beginning
  expect(packed_by_hand({3, 0, 0, 0x80, 0x3f, kLong, 12, 3}), "do not unpack");        // more than announced
  expect(packed_by_hand({3, 0, 0, 0x80, 0x3f, kLong, 10, 3}), "do not unpack");        // less
  expect(packed_by_hand({3, 0, 0, 0x80, 0x3f, kLong, 11, 3, 0, 0}), "do not unpack");  // and then more
  expect(packed_by_hand({3, 0, 0, 0x80, 0x3f, kLong, 11}), "do not unpack");           // a reference cut short
  expect(packed_by_hand({3, 0, 0, 0x80, 0x3f, kLong}), "do not unpack");               // its length
  expect(packed_by_hand({3, 0, 0, 0x80, 0x3f, 1 << 5}), "do not unpack");              // its distance
  expect(packed_by_hand({31, 0, 0}), "do not unpack");                                 // a run beyond the end
  expect(packed_by_hand({3, 0, 0, 0x80, 0x3f, kLong, 11, 3}, 25),
         "malformed: the compressed data unpack to 25 bytes, "
         "where the header needs 24");
  // The announced size is 1000 times what LZF can achieve.
  const std::string many =
      with(with(packed_by_hand({0, 0}, 24'000'000), "WIDTH 1", "WIDTH 1000000"), "POINTS 1", "POINTS 1000000");
  expect(many, "malformed: the data do not unpack");
  expect(many.substr(0, many.size() - 1), "truncated: 2 bytes of compressed data are needed, 1 are there");
  expect(many.substr(0, many.size() - 3), "truncated: the sizes of the compressed data are missing");
}

TEST_F(PointFile, WrittenPointsReadBackBitForBit) {
  std::vector<InterestPoint> points;
  for (std::size_t i = 0; i < kPoints; ++i) points.push_back({position(i) * 0.1F, normal(i)});
  points[2].n_W *= 1.000002F;
  points[3].p_W.x() = -0.0F;
  const auto read = read_points(write("p.pcd", to_pcd(points)));
  ASSERT_EQ(read.size(), points.size());
  EXPECT_EQ(std::memcmp(read.data(), points.data(), points.size() * sizeof points[0]), 0);
}

TEST_F(PointFile, WrittenPointsHaveTheHeaderOfTheBenchmarksFile) {
  const char* assets = std::getenv("SKEIN_ASSETS");
  if (!assets) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  const auto file = std::filesystem::path(assets) / "models" / "mbs" / "mbs_interest_points.pcd";
  const std::string original = read_file_bytes(file, 1 << 20), written = to_pcd(read_points(file));
  EXPECT_LE(written.size(), original.size());  // PCL leaves some bytes behind the data
  EXPECT_EQ(written.substr(0, written.find("binary\n")), original.substr(0, original.find("binary\n")));
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
