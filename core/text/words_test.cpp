#include "core/text/words.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

TEST(Words, ATextHasAWordOnlyAsAWhole) {
  EXPECT_TRUE(has_word("distance(uav1, z) < 3 m", "uav1"));
  EXPECT_TRUE(has_word("distance(uav1, z) < 3 m", "z"));
  EXPECT_TRUE(has_word("uav1", "uav1"));
  EXPECT_TRUE(has_word("uav10 or uav1", "uav1")) << "behind a longer word";
  EXPECT_FALSE(has_word("held(uav10) > 1", "uav1"));
  EXPECT_FALSE(has_word("held(my_uav1) > 1", "uav1"));
  EXPECT_FALSE(has_word("z_m(uav) > 1", "z"));
  EXPECT_FALSE(has_word("", "z"));
}

}  // namespace
}  // namespace skein
