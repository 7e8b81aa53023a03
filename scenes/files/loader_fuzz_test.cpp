// Fuzz test of the readers of scene files: the test damages files at random, with a fixed seed. Whatever a file
// contains, its reader must return valid data or throw an InputError that names the file. It must not throw another
// exception, crash, hang, or use more memory than Kind says.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <vector>

#include "core/math/random_stream.hpp"
#include "scenes/files/box_file.hpp"
#include "scenes/files/limits.hpp"
#include "scenes/files/mesh_file.hpp"
#include "scenes/files/point_file.hpp"
#include "scenes/files/scratch_files.hpp"
#include "scenes/files/small_models.hpp"
#include "tests/support/counted_memory.hpp"

namespace skein::sim {
namespace {

constexpr std::uint64_t kRounds = 500;            ///< damaged variants of each file of the corpus
constexpr std::size_t kMostMemory = 1024 * 1024;  ///< [bytes] in use at once while a file of a few kB is read
/// The same for OBJ and PLY: Assimp reads them through a buffer of up to 16 MB, whatever the size of the file.
constexpr std::size_t kMostMemoryWithBuffer = 20 * kMostMemory;

std::string text_bytes(const auto& value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }

TriangleMesh small_mesh() { return box_surface({"b", {1, 2, 3}, {4, 5, 6}, Matrix3d::Identity()}); }

std::string small_ascii_stl() {
  std::string text = "solid small\n";
  for (const char* z : {"0", "1.5", "-2e-3", "+7"}) {
    text += std::string("facet normal 0 0 1\n outer loop\n  vertex 0 0 ") + z + "\n  vertex 1 0 " + z +
            "\n  vertex 0 1 " + z + "\n endloop\nendfacet\n";
  }
  return text + "endsolid small\n";
}

std::vector<InterestPoint> small_points() {
  std::vector<InterestPoint> points;
  for (int i = 0; i < 20; ++i) points.push_back({{0.5F * i, -1.0F * i, 3.25F}, {0.6F, 0.0F, -0.8F}});
  return points;
}

std::string pcd_header(const std::string& data, const std::string& more_fields = "") {
  const std::string more_ones = more_fields.empty() ? "" : " 4", more_types = more_fields.empty() ? "" : " U";
  return "VERSION 0.7\nFIELDS x y z normal_x normal_y normal_z" + more_fields + "\nSIZE 4 4 4 4 4 4" + more_ones +
         "\nTYPE F F F F F F" + more_types + "\nWIDTH 20\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 20\nDATA " + data +
         "\n";
}

std::string ascii_pcd() {
  std::string text = pcd_header("ascii", " rgb");
  for (const InterestPoint& point : small_points()) {
    text += std::to_string(point.p_W.x()) + " " + std::to_string(point.p_W.y()) + " 3.25 0.6 0 -0.8 4294967295\n";
  }
  return text;
}

/// A minimal LZF compressor: encodes long runs of one byte value as back references, and all other bytes as literals.
std::string pack(const std::string& plain) {
  std::string packed;
  for (std::size_t at = 0; at < plain.size();) {
    std::size_t same = 0;
    while (at > 0 && at + same < plain.size() && same < 264 && plain[at + same] == plain[at - 1]) ++same;
    if (same > 8) {
      packed += {static_cast<char>(7 << 5), static_cast<char>(same - 9), '\0'};
    } else {
      same = 1;
      packed += {'\0', plain[at]};
    }
    at += same;
  }
  return packed;
}

std::string packed_pcd() {
  std::string plain;
  for (std::size_t column = 0; column < 6; ++column) {
    for (const InterestPoint& point : small_points()) {
      plain += text_bytes(column < 3 ? point.p_W[static_cast<int>(column)] : point.n_W[static_cast<int>(column) - 3]);
    }
  }
  const std::string packed = pack(plain);
  return pcd_header("binary_compressed") + text_bytes(static_cast<std::uint32_t>(packed.size())) +
         text_bytes(static_cast<std::uint32_t>(plain.size())) + packed;
}

std::string boxes() {
  Matrix3d R = Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return to_box_description({{"box1", {1, 2, 3}, {4, 5, 6}, R}, {"box2", {0, 0, 9}, {1, 1, 1}, Matrix3d::Identity()}});
}

void load_mesh(const std::filesystem::path& file) {
  const TriangleMesh mesh = read_mesh(file);
  EXPECT_FALSE(mesh.triangles.empty());
  EXPECT_EQ(mesh.vertices.size(), 3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) EXPECT_LT(vertex, mesh.vertices.size());
  }
  for (const auto& vertex : mesh.vertices) EXPECT_LE(vertex.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), kFarthest);
}

void load_points(const std::filesystem::path& file) {
  const std::vector<InterestPoint> points = read_points(file);
  EXPECT_FALSE(points.empty());
  for (const InterestPoint& point : points) {
    EXPECT_LE(point.p_W.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), kFarthest);
    EXPECT_NEAR(point.n_W.norm(), 1.0F, 2e-5F);
  }
}

void load_boxes(const std::filesystem::path& file) {
  const std::vector<OrientedBox> all = read_boxes(file);
  EXPECT_FALSE(all.empty());
  for (const OrientedBox& box : all) {
    EXPECT_LE(box.center.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), kFarthest);
    EXPECT_LE(box.size.maxCoeff<Eigen::PropagateNaN>(), kFarthest);
    EXPECT_GT(box.size.minCoeff<Eigen::PropagateNaN>(), 0.0);
    EXPECT_LT((box.R_WO.transpose() * box.R_WO - Matrix3d::Identity()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
              1e-12);
    EXPECT_GT(box.R_WO.determinant(), 0.0);
  }
}

struct Kind {
  std::string name;
  std::string intact;
  std::function<void(const std::filesystem::path&)> load;
  std::string extension = "";  ///< from which the reader of meshes knows the format
  std::size_t most_memory = kMostMemory;
};

std::vector<Kind> corpus() {
  namespace models = small_models;
  const TriangleMesh mesh = small_mesh();
  return {{"binary STL", to_stl(mesh), load_mesh, ".stl"},
          {"ASCII STL", small_ascii_stl(), load_mesh, ".stl"},
          {"binary PCD", to_pcd(small_points()), load_points},
          {"ASCII PCD", ascii_pcd(), load_points},
          {"packed PCD", packed_pcd(), load_points},
          {"boxes", boxes(), load_boxes},
          {"OBJ", models::obj(mesh), load_mesh, ".obj", kMostMemoryWithBuffer},
          {"ASCII PLY", models::ascii_ply(mesh), load_mesh, ".ply", kMostMemoryWithBuffer},
          {"binary PLY", models::binary_ply(mesh, false), load_mesh, ".ply", kMostMemoryWithBuffer},
          {"COLLADA", models::dae(mesh), load_mesh, ".dae"},
          {"binary glTF", models::glb(mesh), load_mesh, ".glb"},
          {"glTF", models::gltf(mesh), load_mesh, ".gltf"}};
}

constexpr std::array<const char*, 18> kTokens = {
    "nan",   "-inf",  "1e308", "-1e39",       "1e-400", "0",  "-1",          "4294967295", "18446744073709551616",
    "solid", "facet", "DATA",  "\nPOINTS 20", "1,5",    "[[", "{a: *b, <<:", "0x1p9",      "binary_compressed"};
constexpr std::array<std::uint32_t, 8> kWords = {0,          1,          0x7fffffff, 0xffffffff,
                                                 0x7fc00000, 0x7f800000, 0x7f7fffff, 5'000'001};

class Damage {
 public:
  Damage(std::uint64_t kind, std::uint64_t round) : random_(1, "loader_fuzz", kind, round) {}

  std::string apply(std::string bytes, const std::vector<Kind>& all) {
    for (std::uint64_t damages = 1 + below(4); damages > 0 && !bytes.empty(); --damages) once(bytes, all);
    return bytes;
  }

 private:
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_.bits() % end); }

  /// A random position. Half of the draws take it from the first 256 bytes only, where the headers are.
  std::size_t place(const std::string& bytes) { return below(below(2) ? bytes.size() : std::min(bytes.size(), 256ul)); }

  void once(std::string& bytes, const std::vector<Kind>& all) {
    const std::size_t at = place(bytes), length = below(60);
    switch (below(9)) {
      case 0:  // flips one bit
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:  // truncates the file
        bytes.resize(at);
        break;
      case 2:  // deletes a piece
        bytes.erase(at, length);
        break;
      case 3: {  // inserts a piece of the same file, or of another file of the corpus
        const std::string& other = below(2) ? bytes : all[below(all.size())].intact;
        bytes.insert(at, other.substr(below(other.size()), length));
        break;
      }
      case 4:  // overwrites one byte with a random value
        bytes[at] = static_cast<char>(random_.bits());
        break;
      case 5:  // overwrites one byte with a digit
        bytes[at] = static_cast<char>('0' + below(10));
        break;
      case 6: {  // overwrites four bytes with a special number
        const std::uint32_t word = kWords[below(kWords.size())];
        if (at + sizeof word <= bytes.size()) std::memcpy(&bytes[at], &word, sizeof word);
        break;
      }
      case 7:  // appends copies of one byte
        bytes.append(length * below(40), bytes[at]);
        break;
      default: {  // replaces a word after this place with a special one
        const std::size_t begin = bytes.find_first_of(" \n,[", at);
        if (begin == std::string::npos) break;
        const std::size_t end = std::min(bytes.find_first_of(" \n,]", begin + 1), bytes.size());
        bytes.replace(begin + 1, end - begin - 1, kTokens[below(kTokens.size())]);
      }
    }
  }

  RandomStream random_;
};

class LoaderFuzz : public ScratchFiles {
 protected:
  /// Writes `bytes` to a file and loads it. Fails the test if the reader breaks one of the rules at the top of this
  /// source file. @returns whether the reader accepted the file.
  bool survives(const Kind& kind, const std::string& bytes) {
    const auto file = write("damaged" + kind.extension, bytes);
    const test::CountedMemory memory;
    bool accepted = true;
    try {
      kind.load(file);
    } catch (const InputError& error) {
      accepted = false;
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
    EXPECT_LT(memory.peak(), kind.most_memory);
    std::filesystem::remove(file);  // some file systems wait for the disk when a file is overwritten
    return accepted;
  }
};

TEST_F(LoaderFuzz, IntactFilesLoad) {
  for (const Kind& kind : corpus()) EXPECT_TRUE(survives(kind, kind.intact)) << kind.name;
}

TEST_F(LoaderFuzz, DamagedFilesLoadOrAreRefused) {
  const std::vector<Kind> all = corpus();
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::uint64_t accepted = 0;
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      SCOPED_TRACE(all[k].name + ", round " + std::to_string(round));
      accepted += survives(all[k], Damage(k, round).apply(all[k].intact, all));
      if (HasFailure()) return;
    }
    // If a reader refused, or accepted, nearly all damaged files, this test would say little about it.
    EXPECT_GT(accepted, kRounds / 50) << all[k].name;
    EXPECT_LT(accepted, kRounds / 2) << all[k].name;
  }
}

TEST_F(LoaderFuzz, EveryTruncatedFileIsRefusedOrReadAsValidData) {
  for (const Kind& kind : corpus()) {
    for (std::size_t size = 0; size < kind.intact.size(); ++size) {
      SCOPED_TRACE(kind.name + ", first " + std::to_string(size) + " bytes");
      survives(kind, kind.intact.substr(0, size));
      if (HasFailure()) return;
    }
  }
}

/// A header that announces far more data than the file holds must not make a reader allocate memory for that data.
TEST_F(LoaderFuzz, HugeAnnouncedSizesNeedNoMemory) {
  std::string stl = to_stl(small_mesh());
  for (const std::uint32_t count : {2'000'000u, 10'000'000u, 4'294'967'295u}) {
    std::memcpy(&stl[80], &count, sizeof count);
    EXPECT_FALSE(survives({"STL", stl, load_mesh, ".stl"}, stl));
  }
  const auto with = [](std::string text, const std::string& old, const std::string& replacement) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += replacement.size()) {
      text.replace(at, old.size(), replacement);
    }
    return text;
  };
  for (const std::string& pcd : {to_pcd(small_points()), ascii_pcd(), packed_pcd()}) {
    for (const char* many : {" 5000000\n", " 4294967296\n", " 18446744073709551615\n"}) {
      std::string huge = with(pcd, " 20\n", many);
      EXPECT_FALSE(survives({"PCD", huge, load_points}, huge)) << many;
    }
  }
  // Here the header and the compressed data agree: both announce 4.16 GB of unpacked data.
  std::string packed = with(packed_pcd(), " 20\n", " 5000000\n");
  packed = with(packed, "FIELDS x", "FIELDS a x");
  packed = with(with(packed, "SIZE 4", "SIZE 8 4"), "TYPE F", "TYPE U F");
  packed = with(packed, "WIDTH", "COUNT 101 1 1 1 1 1 1\nWIDTH");
  const std::uint32_t unpacked = 5'000'000u * (101 * 8 + 24);
  std::memcpy(&packed[packed.find("compressed\n") + 15], &unpacked, sizeof unpacked);
  EXPECT_FALSE(survives({"PCD", packed, load_points}, packed));
}

}  // namespace
}  // namespace skein::sim
