#include "uav_agent/api/work_parts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

class WorkPartsTest : public testing::Test {
 protected:
  double cpu_s(std::string_view name) const {
    for (const WorkParts::Part& part : parts_.all()) {
      if (part.name == name) return part.cpu_s;
    }
    return -1.0;
  }
  /// Works for some whole seconds in parts that are nested in each other. @returns the time that passed.
  double work_nested(RandomStream& random, int depth) {
    const double began_s = now_s_;
    const std::string_view name = kNames.at(static_cast<std::size_t>(random.uniform() * 3.0));
    const PartTimer timer(&parts_, name);
    for (int i = 0; i < 3; ++i) {
      const double own_s = std::floor(random.uniform(0.0, 5.0));
      now_s_ += own_s;
      own_s_[name] += own_s;
      if (depth > 0 && random.uniform() < 0.7) work_nested(random, depth - 1);
    }
    return now_s_ - began_s;
  }

  static constexpr std::array<std::string_view, 3> kNames = {"planner/views", "planner/tours", "flight/search"};
  double now_s_ = 5.0;
  std::map<std::string_view, double> own_s_;
  WorkParts parts_{[this] { return now_s_; }};
};

TEST_F(WorkPartsTest, AnInnerPartDoesNotCountForTheOuterOne) {
  {
    const PartTimer outer(&parts_, "outer");
    now_s_ += 1.0;
    {
      const PartTimer inner(&parts_, "inner");
      now_s_ += 2.0;
    }
    now_s_ += 4.0;
  }
  now_s_ += 8.0;  // outside of all parts
  const PartTimer again(&parts_, "outer");
  EXPECT_EQ(cpu_s("outer"), 5.0);
  EXPECT_EQ(cpu_s("inner"), 2.0);
  ASSERT_EQ(parts_.all().size(), 2U);
  EXPECT_EQ(parts_.all().front().name, "outer");
}

TEST_F(WorkPartsTest, DrawnPartsSumToTheTimeOfTheWork) {
  RandomStream random(1, "work parts", 0);
  double worked_s = 0.0;
  for (int i = 0; i < 100; ++i) {
    worked_s += work_nested(random, 4);
    now_s_ += 3.0;  // outside of all parts
  }
  double sum_s = 0.0;
  for (const WorkParts::Part& part : parts_.all()) {
    EXPECT_EQ(part.cpu_s, own_s_[part.name]) << part.name;
    sum_s += part.cpu_s;
  }
  EXPECT_EQ(sum_s, worked_s);
}

TEST_F(WorkPartsTest, WithoutAProfileNothingIsTimed) {
  const PartTimer timer(nullptr, "planner/views");
  now_s_ += 1.0;
  EXPECT_TRUE(parts_.all().empty());
}

}  // namespace
}  // namespace skein::agent
