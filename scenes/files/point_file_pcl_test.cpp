// Our reader of point files against PCL's, bit for bit: drawn clouds as PCL writes them, and the benchmark's files.
#include <pcl/PCLPointCloud2.h>
#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "core/math/random_stream.hpp"
#include "scenes/files/point_file.hpp"
#include "scenes/files/scratch_files.hpp"

namespace skein::sim {
namespace {

using PointFilePcl = ScratchFiles;
using Field = pcl::PCLPointField;

constexpr std::uint64_t kClouds = 300;
constexpr std::array<const char*, 6> kNeeded = {"x", "y", "z", "normal_x", "normal_y", "normal_z"};
constexpr std::array kTypes = {Field::INT8,   Field::UINT8, Field::INT16,  Field::UINT16,  Field::INT32,
                               Field::UINT32, Field::INT64, Field::UINT64, Field::FLOAT32, Field::FLOAT64};

/// A cloud with the needed fields, floats or doubles, among others of all types and sizes, in any order and with gaps
/// between them. Fields that no reader asks for have any bits, NaN too.
class DrawnCloud {
 public:
  explicit DrawnCloud(std::uint64_t seed) : draw_(seed, "point_file_pcl_test", 0) {
    cloud_.width = 1 + below(40);
    cloud_.height = 1 + below(3);
    draw_fields();
    for (std::size_t i = 0; i < points() * cloud_.point_step; ++i) cloud_.data.push_back(draw_.bits() & 0xff);
    for (std::size_t i = 0; i < points(); ++i) {
      for (const char* name : kNeeded) put(i, name, draw_number());
      put(i, "normal_y", draw_.uniform(0.1, 2));  // a normal has a direction
    }
  }

  std::size_t points() const { return std::size_t{cloud_.width} * cloud_.height; }
  std::size_t below(std::size_t end) { return draw_.bits() % end; }
  const pcl::PCLPointCloud2& cloud() const { return cloud_; }

  void put(std::size_t point, const char* name, double value) {
    const Field& field = cloud_.fields.at(pcl::getFieldIndex(cloud_, name));
    std::uint8_t* to = &cloud_.data[point * cloud_.point_step + field.offset];
    const auto narrow = static_cast<float>(value);
    if (field.datatype == Field::FLOAT64) {
      std::memcpy(to, &value, sizeof value);
    } else {
      std::memcpy(to, &narrow, sizeof narrow);
    }
  }

 private:
  void draw_fields() {
    for (const char* name : kNeeded) add_field(name, below(3) ? Field::FLOAT32 : Field::FLOAT64, 1);
    const std::size_t others = below(6);
    for (std::size_t i = 0; i < others; ++i) {
      add_field("other" + std::to_string(i), kTypes[below(kTypes.size())], 1 + below(4));
    }
    for (std::size_t i = cloud_.fields.size(); i > 1; --i) std::swap(cloud_.fields[i - 1], cloud_.fields[below(i)]);
    for (Field& field : cloud_.fields) {
      if (below(4) == 0) cloud_.point_step += 1 + below(8);  // a gap
      field.offset = cloud_.point_step;
      cloud_.point_step += field.count * pcl::getFieldSize(field.datatype);
    }
    cloud_.row_step = cloud_.point_step * cloud_.width;
  }

  void add_field(const std::string& name, std::uint8_t type, std::size_t count) {
    Field field;
    field.name = name;
    field.datatype = type;
    field.count = count;
    cloud_.fields.push_back(field);
  }

  /// A random number of any size that a scene may have; some are too small for a normal float.
  double draw_number() {
    const double exponent = draw_.uniform(-44, 5);
    return draw_.uniform(-1, 1) * std::pow(10.0, below(3) ? draw_.uniform(-2, 5) : exponent);
  }

  RandomStream draw_;
  pcl::PCLPointCloud2 cloud_;
};

template <class T>
T as(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// The numbers of a cloud as our reader has to give them: normals of unit length.
std::vector<InterestPoint> points_of(const pcl::PCLPointCloud2& cloud) {
  std::vector<InterestPoint> points(std::size_t{cloud.width} * cloud.height);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<float, kNeeded.size()> numbers{};
    for (std::size_t k = 0; k < kNeeded.size(); ++k) {
      const Field& field = cloud.fields.at(pcl::getFieldIndex(cloud, kNeeded[k]));
      const std::uint8_t* bytes = &cloud.data[i * cloud.point_step + field.offset];
      numbers[k] = field.datatype == Field::FLOAT64 ? static_cast<float>(as<double>(bytes)) : as<float>(bytes);
    }
    points[i] = {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
    const float length = points[i].n_W.norm();
    if (std::abs(length - 1.0F) > 1e-5F) points[i].n_W /= length;
  }
  return points;
}

void expect_same_bits(const std::vector<InterestPoint>& ours, const std::vector<InterestPoint>& theirs) {
  ASSERT_EQ(ours.size(), theirs.size());
  EXPECT_EQ(std::memcmp(ours.data(), theirs.data(), ours.size() * sizeof ours[0]), 0);
}

std::vector<InterestPoint> read_by_pcl(const std::filesystem::path& file) {
  pcl::PCLPointCloud2 cloud;
  EXPECT_EQ(pcl::io::loadPCDFile(file, cloud), 0);
  return points_of(cloud);
}

constexpr std::array kEncodings = {"ascii", "binary", "binary_compressed"};

std::filesystem::path write_by_pcl(const std::filesystem::path& folder, const std::string& encoding,
                                   const pcl::PCLPointCloud2& cloud, int digits) {
  const std::filesystem::path file = folder / (encoding + ".pcd");
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf upright = Eigen::Quaternionf::Identity();
  pcl::PCDWriter writer;
  if (encoding == "ascii") {
    writer.writeASCII(file, cloud, origin, upright, digits);
  } else if (encoding == "binary") {
    writer.writeBinary(file, cloud);
  } else {
    writer.writeBinaryCompressed(file, cloud);
  }
  return file;
}

TEST_F(PointFilePcl, DrawnCloudsAreReadAsPclReadsThem) {
  for (std::uint64_t seed = 1; seed <= kClouds && !HasFailure(); ++seed) {
    DrawnCloud drawn(seed);
    for (const std::string encoding : kEncodings) {
      SCOPED_TRACE("cloud " + std::to_string(seed) + ", " + encoding);
      const int digits = 6 + static_cast<int>(drawn.below(12));
      const std::filesystem::path file = write_by_pcl(folder_, encoding, drawn.cloud(), digits);
      const std::vector<InterestPoint> ours = read_points(file);
      expect_same_bits(ours, read_by_pcl(file));
      if (encoding != "ascii") expect_same_bits(ours, points_of(drawn.cloud()));
    }
  }
}

/// Numbers a little more than half way between two floats, by less than the precision of a double. PCL first converts
/// to double, so it does not round them up (except the first number). Some are too small for any float but 0.
TEST_F(PointFilePcl, AsciiIsRoundedAsPclRoundsIt) {
  RandomStream draw(1, "point_file_pcl_test", 1);
  for (const char* size : {"4", "8"}) {
    std::string text = std::string("VERSION 0.7\nFIELDS z x y normal_x normal_y normal_z\nSIZE 4 ") + size +
                       " 4 4 4 4\nTYPE F F F F F F\nCOUNT 1 1 1 1 1 1\nWIDTH 100\nHEIGHT 1\n" +
                       "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 100\nDATA ascii\n";
    for (int i = 0; i < 100; ++i) {
      const auto below = static_cast<float>(draw.uniform(1, 99));
      std::array<char, 80> half{};
      std::snprintf(half.data(), half.size(), "%.60f", 0.5 * (double{below} + std::nextafter(below, 100.0F)));
      text += "1 " + std::string(half.data()) + "1 " + std::to_string(draw.uniform(-9, 9)) + "e-50 0 0 1\n";
    }
    const std::filesystem::path file = write("halves.pcd", text);
    expect_same_bits(read_points(file), read_by_pcl(file));
  }
}

TEST_F(PointFilePcl, ANumberThatIsNotFiniteIsFoundInEveryEncoding) {
  for (std::uint64_t seed = 1; seed <= 30 && !HasFailure(); ++seed) {
    DrawnCloud drawn(seed);
    const std::size_t point = drawn.below(drawn.points());
    const double wrong = seed % 2 ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity();
    drawn.put(point, kNeeded[drawn.below(kNeeded.size())], wrong);
    for (const std::string encoding : kEncodings) {
      const std::string message = complaint(read_points, write_by_pcl(folder_, encoding, drawn.cloud(), 9));
      const std::string expected = "point " + std::to_string(point) + " has a number that is not finite";
      EXPECT_NE(message.find(expected), std::string::npos) << encoding << ": " << message;
    }
  }
}

TEST_F(PointFilePcl, TheBenchmarksFilesAreReadAsPclReadsThem) {
  const char* assets = std::getenv("SKEIN_ASSETS");
  if (!assets) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  const std::filesystem::path models = std::filesystem::path(assets) / "models";
  for (const char* name : {"mbs/mbs_interest_points.pcd", "crane/crane_interest_points.pcd",
                           "crane/crane_interest_points_on_meshes.pcd"}) {
    SCOPED_TRACE(name);
    expect_same_bits(read_points(models / name), read_by_pcl(models / name));
  }
}

}  // namespace
}  // namespace skein::sim
