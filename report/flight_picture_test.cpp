#include "report/flight_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <regex>

#include "report/testing/xml_check.hpp"
#include "results/testing/scratch.hpp"

namespace skein::report {
namespace {

using Eigen::Vector2d;

FlightPicture random_picture(std::mt19937& random, std::size_t points) {
  const auto coordinate = [&] { return static_cast<double>(random() % 10001) / 100.0; };
  FlightPicture picture;
  for (std::size_t i = 0; i < points; ++i) {
    picture.points.push_back({{coordinate(), coordinate(), coordinate()}, static_cast<double>(random() % 101) / 100.0});
  }
  for (const char* uav : {"a", "<b>"}) {
    PictureTrack track{uav, uav[0] == 'a', {}};
    for (int i = 0; i < 300; ++i) track.p_WB.emplace_back(coordinate(), coordinate(), coordinate());
    picture.tracks.push_back(track);
  }
  picture.boxes.emplace_back();
  for (std::size_t i = 0; i < 8; ++i) picture.boxes.front()[i] = Vector3d(i & 1 ? 9 : 1, i & 2 ? 9 : 1, i & 4 ? 9 : 1);
  return picture;
}

TEST(FlightPicture, ReadsAResultsFolder) {
  const results::Scratch scratch;
  write_text(scratch.path() / "result.json",
             R"({"status": "completed", "uavs": [{"name": "alpha", "role": "explorer"},
                                                          {"name": "beta", "role": "photographer"}]})");
  write_text(
      scratch.path() / "scene.json",
      R"({"boxes": [{"center": [1, 2, 3], "size": [2, 4, 6], "rotation": [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}]})");
  write_text(scratch.path() / "score.csv", "x,y,z,nx,ny,nz,score,index\n1,2,3,0,0,1,0.5,0\n4,5,6,0,0,1,0,1\n");
  write_text(scratch.path() / "trajectories.csv",
             "time_s,uav,x,y,z\n0,alpha,1,2,3\n0,beta,4,5,6\n0.1,alpha,7,8,9\n0.1,be");
  const FlightPicture picture = read_picture(scratch.path());
  ASSERT_EQ(picture.boxes.size(), 1u);
  EXPECT_TRUE(picture.boxes[0][0].isApprox(Vector3d(1 + 2, 2 - 1, 0))) << "turned by 90 degrees about its middle";
  EXPECT_TRUE(picture.boxes[0][7].isApprox(Vector3d(1 - 2, 2 + 1, 6)));
  ASSERT_EQ(picture.points.size(), 2u);
  EXPECT_EQ(picture.points[0].score, 0.5);
  ASSERT_EQ(picture.tracks.size(), 2u);
  EXPECT_TRUE(picture.tracks[0].explorer);
  EXPECT_EQ(picture.tracks[0].p_WB.size(), 2u);
  EXPECT_EQ(picture.tracks[1].p_WB.size(), 1u) << "an incomplete line is left out";
}

TEST(FlightPicture, AnEmptyFolderGivesAnEmptyDrawing) {
  const results::Scratch scratch;
  const FlightPicture picture = read_picture(scratch.path());
  EXPECT_TRUE(picture.boxes.empty() && picture.points.empty() && picture.tracks.empty());
  const PictureView view({&picture});
  EXPECT_NO_THROW(xml_elements(picture_svg(picture, view, "")));
}

TEST(FlightPicture, EverythingIsWithinTheDrawing) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 30; ++trial) {
    const FlightPicture one = random_picture(random, 500), other = random_picture(random, 50);
    const PictureView view({&one, &other});
    for (const FlightPicture* picture : {&one, &other}) {
      const auto inside = [&](const Vector3d& p_W) {
        const Vector2d at = view.at(p_W);
        return at.minCoeff() >= 0.0 && at.x() <= view.width() && at.y() <= view.height();
      };
      for (const PicturePoint& point : picture->points) ASSERT_TRUE(inside(point.p_W));
      for (const PictureTrack& track : picture->tracks) {
        for (const Vector3d& p_WB : track.p_WB) ASSERT_TRUE(inside(p_WB));
      }
      ASSERT_NO_THROW(xml_elements(picture_svg(*picture, view, "a & b")));
    }
  }
}

TEST(FlightPicture, TheViewIsFromAboveAndTheSouth) {
  FlightPicture picture;
  picture.points = {{{0, 0, 0}, 1}, {{10, 10, 10}, 1}};
  const PictureView view({&picture});
  EXPECT_LT(view.at({0, 0, 10}).y(), view.at({0, 0, 0}).y()) << "a higher point is drawn higher";
  EXPECT_LT(view.at({0, 10, 0}).y(), view.at({0, 0, 0}).y())
      << "a point in the north is drawn higher, farther from the viewer";
  EXPECT_GT(view.at({10, 0, 0}).x(), view.at({0, 0, 0}).x()) << "a point in the east is drawn to the right";
}

TEST(FlightPicture, ManyPointsAreThinnedAndNoUndetectedPointHidesADetectedOne) {
  std::mt19937 random(6);
  const FlightPicture picture = random_picture(random, 60000);
  const PictureView view({&picture});
  const std::string svg = picture_svg(picture, view, "");
  const std::regex dot("h0");  // a dot is a line of length 0
  EXPECT_LE(std::distance(std::sregex_iterator(svg.begin(), svg.end(), dot), std::sregex_iterator()), 4000);

  FlightPicture two;
  two.points = {{{5, 5, 5}, 0.9}, {{5, 5, 5}, 0.0}};
  const std::string drawn = picture_svg(two, PictureView({&two}), "");
  EXPECT_NE(drawn.find("\"q4\""), std::string::npos);
  EXPECT_EQ(drawn.find("\"q0\""), std::string::npos);
}

TEST(FlightPicture, ASimplifiedLineStaysNearTheOriginalAndKeepsItsEnds) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vector2d> line = {Vector2d::Zero()};
    for (int i = 0; i < 400; ++i) {
      line.push_back(line.back() + Vector2d(random() % 100, static_cast<double>(random() % 100) - 50.0) / 100.0);
    }
    const double tolerance = 0.01 * static_cast<double>(1 + random() % 200);
    const std::vector<Vector2d> kept = simplified(line, tolerance);
    ASSERT_EQ(kept.front(), line.front());
    ASSERT_EQ(kept.back(), line.back());
    ASSERT_LE(kept.size(), line.size());
    for (const Vector2d& p : line) {
      double nearest = 1e9;
      for (std::size_t i = 1; i < kept.size(); ++i) {
        const Vector2d along = kept[i] - kept[i - 1];
        const double share = std::clamp((p - kept[i - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (p - kept[i - 1] - share * along).norm());
      }
      ASSERT_LE(nearest, tolerance + 1e-9);
    }
  }
}

}  // namespace
}  // namespace skein::report
