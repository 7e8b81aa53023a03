// The cache keeps and returns results, and ignores damaged files.
#include "oracle/cache.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

#include "process/files/user_cache.hpp"
#include "tests/support/test_scenes.hpp"
#include "tests/support/text_files.hpp"

namespace skein::sim {
namespace {

namespace fs = std::filesystem;

class OracleCache : public ::testing::Test {
 protected:
  OracleCache() {
    std::string name = fs::path(testing::TempDir()) / "skein_oracle_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot create " + name);
    folder_ = name;
    scenario_.fleet.resize(1);
    scenario_.fleet[0].start = {-20.0, 0.0};
    test::add_box(scene_.mesh, {5.0, 0.0, 5.0}, {2.0, 8.0, 8.0});
    scene_.points = {{{4.0F, 0.0F, 5.0F}, {-1.0F, 0.0F, 0.0F}}, {{6.0F, 1.0F, 4.0F}, {1.0F, 0.0F, 0.0F}}};
    request_.config.directions = 16;
    request_.cache = folder_ / "a" / "b";
  }
  ~OracleCache() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  OracleReply ask() const { return ask_oracle(scenario_, scene_, request_); }
  fs::path file() const {
    return *request_.cache / ("oracle-" + oracle_key(scenario_, scene_, request_.config) + ".json");
  }

  fs::path folder_;
  Scenario scenario_;
  Scene scene_;
  OracleRequest request_;
};

TEST_F(OracleCache, TheSecondAnswerComesFromTheCache) {
  const OracleReply first = ask(), second = ask();
  ASSERT_TRUE(first.summary && second.summary);
  EXPECT_FALSE(first.cached);
  EXPECT_TRUE(second.cached);
  EXPECT_EQ(*first.summary, *second.summary);
  EXPECT_EQ(first.summary->points_total, 2u);
  EXPECT_EQ(first.summary->reachable.attainable.score, 2.0);
  EXPECT_EQ(first.summary->estimate, (std::vector<float>{1.0F, 1.0F}));
  EXPECT_EQ(first.summary->flyable, (std::vector<std::uint8_t>{1, 1}));
  EXPECT_TRUE(first.warnings.empty() && second.warnings.empty());
  EXPECT_EQ(summary_from_json(to_json(*first.summary)), *first.summary);
}

TEST_F(OracleCache, ADamagedFileIsReportedAndReplaced) {
  const OracleSummary right = *ask().summary;
  const std::string whole = read_text(file());
  std::string lie = whole;
  lie.replace(lie.find("\"points_total\":2"), 16, "\"points_total\":7");
  for (const std::string& content :
       {std::string(), std::string("{"), std::string("[1]"), lie, whole.substr(0, whole.size() / 2)}) {
    std::ofstream(file()) << content;
    const OracleReply reply = ask();
    EXPECT_EQ(*reply.summary, right);
    EXPECT_FALSE(reply.cached);
    EXPECT_EQ(reply.warnings.size(), 1u) << content;
    EXPECT_EQ(read_text(file()), whole);
  }
}

TEST_F(OracleCache, ACacheThatCannotBeWrittenCostsAWarning) {
  std::ofstream(folder_ / "a") << "a file where a folder should be";
  const OracleReply reply = ask();
  EXPECT_TRUE(reply.summary);
  EXPECT_EQ(reply.warnings.size(), 1u);
  request_.cache.reset();
  EXPECT_TRUE(ask().warnings.empty());
}

TEST_F(OracleCache, PatienceLimitsTheComputationButNotTheUseOfTheCache) {
  request_.patience_s = 1e-9;
  const OracleReply refused = ask();
  EXPECT_FALSE(refused.summary);
  EXPECT_GT(refused.expected_s, 0.0);
  request_.patience_s = 1e9;
  EXPECT_TRUE(ask().summary);
  request_.patience_s = 1e-9;
  EXPECT_TRUE(ask().cached);
}

TEST_F(OracleCache, EachInputThatChangesTheAnswerChangesTheKey) {
  const std::string before = oracle_key(scenario_, scene_, request_.config);
  const std::vector<std::function<void()>> changes = {
      [this] { scene_.mesh.vertices[3].x() += 0.001F; },
      [this] { std::swap(scene_.mesh.triangles[0], scene_.mesh.triangles[1]); },
      [this] { scene_.points[1].n_W.y() = 0.5F; },
      [this] { scene_.points.pop_back(); },
      [this] { scenario_.fleet[0].start.x() += 1.0; },
      [this] { scenario_.fleet[0].vehicle.camera.focal_length_m *= 1.01; },
      [this] { scenario_.fleet[0].vehicle.gimbal.pitch_limit_deg = 70.0; },
      [this] { scenario_.desired_mm_per_pixel = 1.0; },
      [this] { scenario_.rules.unnormalised_displacement = false; },
      [this] { scenario_.rules.limit_search_radius = false; },
      [this] { scenario_.rules.min_point_score = 0.3; },
      [this] { scenario_.rules.own_body_hides = false; },
      [this] { scenario_.rules.camera_blind_in_structure = false; },
      [this] { scenario_.rules.ray_ends_at_point = true; },
      [this] { scenario_.fleet[0].vehicle.rotor_radius_m = 0.1; },
      [this] { scenario_.fleet[0].vehicle.camera.p_BC.z() = -0.2; },
      [this] { scenario_.fleet[0].vehicle.gimbal.yaw_limit_deg = 45.0; },
      [this] { request_.config.berth = Berth::body; },
      [this] { request_.config.clearance_m = 0.6; },
      [this] { request_.config.outside_berth_m = 3.0; },
      [this] { request_.config.directions = 32; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Scenario scenario = scenario_;
    const Scene scene = scene_;
    const OracleRequest request = request_;
    changes[i]();
    EXPECT_NE(oracle_key(scenario_, scene_, request_.config), before) << i;
    scenario_ = scenario;
    scene_ = scene;
    request_ = request;
  }
  scenario_.name = "another";
  scenario_.duration_s = 5.0;
  scene_.boxes.resize(1);
  request_.config.threads = 7;
  EXPECT_EQ(oracle_key(scenario_, scene_, request_.config), before);
}

TEST_F(OracleCache, TheUsersCacheFolderFollowsXdg) {
  const auto set = [](const char* name, const std::optional<std::string>& value) {
    value ? ::setenv(name, value->c_str(), 1) : ::unsetenv(name);
  };
  const auto value_of = [](const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
  };
  const std::optional<std::string> cache_before = value_of("XDG_CACHE_HOME"), home_before = value_of("HOME");
  const auto with = [&](const std::optional<std::string>& cache, const std::optional<std::string>& home) {
    set("XDG_CACHE_HOME", cache);
    set("HOME", home);
    return user_cache_folder();
  };
  EXPECT_EQ(with("/c", "/h"), "/c/skein");
  EXPECT_EQ(with("relative", "/h"), "/h/.cache/skein");
  EXPECT_EQ(with("", "/h"), "/h/.cache/skein");
  EXPECT_EQ(with(std::nullopt, std::nullopt), std::nullopt);
  with(cache_before, home_before);
}

}  // namespace
}  // namespace skein::sim
