#include "station/point_names.hpp"

#include <gtest/gtest.h>

namespace skein::station {
namespace {

LedgerEntry named_entry(std::uint64_t index, UavIndex uav, std::uint64_t capture, std::vector<std::uint32_t> points) {
  LedgerEntry made{index, 0, uav, points.empty(), {uav, capture, 0, 70 + index, {}}};
  for (const std::uint32_t point : points) made.capture.points.push_back({point, 1.0F, 0.5F, 0.5F});
  return made;
}

/// The points that a report with these numbers names.
std::vector<std::uint32_t> resolved(const PointNames& names, UavIndex uav, std::vector<std::uint32_t> numbers) {
  CaptureReport report{uav, 0, 0, 0, {}};
  for (const std::uint32_t number : numbers) report.points.push_back({number, 1.0F, 0.5F, 0.5F});
  names.resolve(report);
  std::vector<std::uint32_t> points;
  for (const CapturePoint& point : report.points) points.push_back(point.index);
  return points;
}

using Points = std::vector<std::uint32_t>;

TEST(PointNames, EachUavHasItsOwnNumbersInTheOrderOfTheLedger) {
  PointNames names(2);
  std::vector<LedgerEntry> ledger = {named_entry(0, UavIndex{0}, 0, {5, 9}), named_entry(1, UavIndex{1}, 0, {9}),
                                     named_entry(2, UavIndex{0}, 1, {9, 2})};
  names.follow(ledger);
  EXPECT_EQ(resolved(names, UavIndex{0}, {0, 1, 2}), (Points{5, 9, 2})) << "point 9 has its number already";
  EXPECT_EQ(resolved(names, UavIndex{1}, {0}), (Points{9}));
  ledger.push_back(named_entry(3, UavIndex{1}, 0, {}));  // a collision
  ledger.push_back(named_entry(4, UavIndex{1}, 1, {5}));
  names.follow(ledger);
  EXPECT_EQ(resolved(names, UavIndex{1}, {1, 0}), (Points{5, 9})) << "a point that was known gets no second number";
}

TEST(PointNames, NumbersThatWereNeverGivenNameNoPoint) {
  PointNames names(1);
  names.follow({named_entry(0, UavIndex{0}, 0, {3})});
  EXPECT_EQ(resolved(names, UavIndex{0}, {1, 0}), (Points{PointNames::kNoPoint, 3}));
  EXPECT_EQ(resolved(names, UavIndex{7}, {0}), (Points{PointNames::kNoPoint})) << "no such UAV";
}

}  // namespace
}  // namespace skein::station
