#include "scenes/scene_export.hpp"

#include <cstring>

#include "core/scenario/scenario_reader.hpp"
#include "core/scenario/scene_families.hpp"
#include "scenes/files/box_file.hpp"
#include "scenes/files/scratch_files.hpp"
#include "scenes/scene_source.hpp"
#include "tests/support/places.hpp"

namespace skein::sim {
namespace {

namespace fs = std::filesystem;

using Triangle = std::array<Eigen::Vector3f, 3>;

std::vector<Triangle> triangles(const TriangleMesh& mesh) {
  std::vector<Triangle> all;
  for (const auto& t : mesh.triangles) all.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return all;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_bytes(const auto& a, const auto& b) { return std::memcmp(a.data(), b.data(), sizeof a) == 0; }

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_TRUE(same_bytes(triangles(a.mesh), triangles(b.mesh)));
  EXPECT_TRUE(same_bytes(a.points, b.points));
  ASSERT_EQ(a.boxes.size(), b.boxes.size());
  for (std::size_t i = 0; i < a.boxes.size(); ++i) {
    EXPECT_EQ(a.boxes[i].name, b.boxes[i].name);
    EXPECT_TRUE(same_bytes(a.boxes[i].center, b.boxes[i].center)) << a.boxes[i].name;
    EXPECT_TRUE(same_bytes(a.boxes[i].size, b.boxes[i].size)) << a.boxes[i].name;
    EXPECT_TRUE(same_bytes(a.boxes[i].R_WO, b.boxes[i].R_WO)) << a.boxes[i].name;
  }
}

class SceneExport : public ScratchFiles {
 protected:
  LoadOptions options() const {
    LoadOptions options;
    options.config_dir = source_path("config");
    return options;
  }

  /// A scenario with a scene of a family, and a fleet of two.
  Scenario scenario_of(const std::string& family, std::uint64_t scene_seed) const {
    const auto file =
        write(family + ".yaml", "scene: {family: " + family + "}\ndesired_mm_per_pixel: 1.5\nfleet:\n" +
                                    "  - {name: a, vehicle: explorer}\n" + "  - {name: b, vehicle: photographer}\n");
    LoadOptions with_seed = options();
    with_seed.scene_seed = scene_seed;
    return load_scenario(file.string(), with_seed);
  }

  /// Exports, loads and compares.
  void expect_round_trip(const Scenario& scenario) const {
    const Scene scene = load_scene(scenario);
    const fs::path out = folder_ / "export";
    write_export(scene_export(scenario, scene), out, true);
    const Scenario loaded = load_scenario((out / (scenario.name + ".yaml")).string(), options());
    expect_same(scene, load_scene(loaded));
    ASSERT_EQ(loaded.fleet.size(), scenario.fleet.size());
    for (std::size_t i = 0; i < loaded.fleet.size(); ++i) {
      EXPECT_TRUE(same_bytes(loaded.fleet[i].start, scenario.fleet[i].start));
      EXPECT_EQ(loaded.fleet[i].start_yaw, scenario.fleet[i].start_yaw);
      EXPECT_EQ(to_yaml(loaded.fleet[i].vehicle), to_yaml(scenario.fleet[i].vehicle));
    }
    EXPECT_EQ(loaded.duration_s, scenario.duration_s);
    EXPECT_EQ(loaded.desired_mm_per_pixel, scenario.desired_mm_per_pixel);
    EXPECT_EQ(loaded.station_position, scenario.station_position);
  }
};

TEST_F(SceneExport, EveryFamilyReadsBackBitForBit) {
  for (const SceneFamily& family : scene_families()) {
    for (const std::uint64_t scene_seed : {0, 3}) {
      SCOPED_TRACE(family.name + std::string(" ") + std::to_string(scene_seed));
      expect_round_trip(scenario_of(family.name, scene_seed));
    }
  }
}

TEST_F(SceneExport, OfficialScenesReadBackBitForBit) {
  if (!std::getenv("SKEIN_ASSETS")) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  for (const char* name : {"mbs", "crane"}) expect_round_trip(load_scenario(name, options()));
}

TEST_F(SceneExport, HasTheBenchmarksLayout) {
  Scenario scenario = scenario_of("towers", 0);
  scenario.name = "a b/c";  // a name that cannot be part of a path
  Scene scene;
  scene.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  scene.points = {{{1, 2, 3}, {0, 0, 1}}};
  scene.boxes = {{"box1", {1, 2, 3}, {4, 5, 6}, Matrix3d::Identity()}};
  std::vector<std::string> paths;
  for (const ExportedFile& file : scene_export(scenario, scene)) paths.push_back(file.path.string());
  EXPECT_EQ(paths, (std::vector<std::string>{"models/a_b_c/a_b_c.stl", "models/a_b_c/a_b_c_interest_points.pcd",
                                             "models/a_b_c/bounding_boxes/box_description.yaml",
                                             "models/a_b_c/bounding_boxes/box1.stl", "a_b_c.yaml"}));
}

TEST_F(SceneExport, EachBoxHasItsOwnFile) {
  Scene scene;
  scene.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (const char* name : {"a b_2", "a b", "a_b", "a/b"}) {
    scene.boxes.push_back({name, {1, 2, 3}, {4, 5, 6}, Matrix3d::Identity()});
  }
  std::vector<std::string> names;
  for (const ExportedFile& file : scene_export(scenario_of("towers", 0), scene)) {
    if (file.summary == "surface of a box") names.push_back(file.path.stem().string());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"a_b_2", "a_b", "a_b_3", "a_b_4"}));
}

TEST_F(SceneExport, ThePictureShowsStructureFarFromTheOrigin) {
  for (const double y : {0.0, 5000.0, -90'000.0}) {
    Scene scene;
    scene.mesh = box_surface({"tower", {0.0, y, 1000.0}, {2000.0, 2000.0, 2000.0}, Matrix3d::Identity()});
    const std::string svg = scene_picture_file(scenario_of("towers", 0), scene).content;
    const std::size_t from_above = svg.rfind("<g ");
    for (const std::string& view : {svg.substr(0, from_above), svg.substr(from_above)}) {
      EXPECT_NE(view.find(")\" d=\"M"), std::string::npos) << y << ": no runs of any shade in " << view;
    }
  }
}

TEST_F(SceneExport, AFileInPlaceOfAFolderIsReported) {
  write("x", "a file");
  try {
    write_export({{"x/a", "", "new"}}, folder_, true);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot be written to"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("Not a directory"), std::string::npos) << error.what();
  }
}

TEST_F(SceneExport, AnEarlierExportIsReplacedOnlyOnRequest) {
  const std::vector<ExportedFile> files = {{"x/a", "", "new"}, {"b", "", "new"}};
  write("b", "old");
  try {
    write_export(files, folder_, false);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("b exists already"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(folder_ / "x"));
  write_export(files, folder_, true);
  EXPECT_TRUE(fs::exists(folder_ / "x" / "a"));
  EXPECT_EQ(fs::file_size(folder_ / "b"), 3u);
  EXPECT_NO_THROW(write_export(files, folder_, false)) << "to write the same export again loses nothing";
  write("b", "own");
  EXPECT_THROW(write_export(files, folder_, false), InputError)
      << "the other export has files of the same size, but not the same content";
  EXPECT_THROW(write_export({{"b/c", "", "below a file"}}, folder_, false), InputError);
}

}  // namespace
}  // namespace skein::sim
