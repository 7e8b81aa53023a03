#include "cli/study/spec.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cli/study/flights.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

using Texts = std::vector<std::string>;
using Seeds = std::vector<std::uint64_t>;

TEST(StudySpec, CommasSeparatePlanners) {
  EXPECT_EQ(split_planners("kios"), Texts{"kios"});
  EXPECT_EQ(split_planners("kios,patrol,hover"), (Texts{"kios", "patrol", "hover"}));
}

TEST(StudySpec, AnItemWithAKeyContinuesTheParametersBeforeIt) {
  EXPECT_EQ(split_planners("kios,xxh:faithful=true,star"), (Texts{"kios", "xxh:faithful=true", "star"}));
  EXPECT_EQ(split_planners("xxh:faithful=true,teams=2,star"), (Texts{"xxh:faithful=true,teams=2", "star"}));
  EXPECT_EQ(split_planners("kios:a.yaml,voxel_m=4,kios:voxel_m=5"), (Texts{"kios:a.yaml,voxel_m=4", "kios:voxel_m=5"}));
  EXPECT_EQ(split_planners("waypoints:tour.yaml,hover:height_m=4"), (Texts{"waypoints:tour.yaml", "hover:height_m=4"}));
}

TEST(StudySpec, ACommandEndsAtTheNextComma) {
  EXPECT_EQ(split_planners("exec:./mine --speed=3,kios"), (Texts{"exec:./mine --speed=3", "kios"}));
}

TEST(StudySpec, InvalidListsOfPlannersAreRefused) {
  for (const char* list : {"", "kios,,star", "kios,", "jurong=hover", "kios,voxel_m=4", "exec:./mine,speed=4"}) {
    EXPECT_THROW(split_planners(list), InputError) << list;
  }
}

TEST(StudySpec, AListThatIsJoinedReadsBackTheSame) {
  for (const std::string list : {"a", "a,b", "a:x=1,y=2,b", "a:f.yaml,b:x=1,y=2,z=3,c"}) {
    std::string joined;
    for (const std::string& planner : split_planners(list)) joined += (joined.empty() ? "" : ",") + planner;
    EXPECT_EQ(joined, list);
  }
}

TEST(StudySpec, SeedsAreAListOfNumbersAndRanges) {
  for (const std::uint64_t seed : {0ULL, 1ULL, 3ULL, 1001ULL, 123456789012ULL}) {
    EXPECT_EQ(parse_seeds(std::to_string(seed)), Seeds{seed});
  }
  EXPECT_EQ(parse_seeds("0-7"), (Seeds{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(parse_seeds("1,3,5"), (Seeds{1, 3, 5}));
  EXPECT_EQ(parse_seeds("3,5,8"), (Seeds{3, 5, 8}));
  EXPECT_EQ(parse_seeds("1-5"), (Seeds{1, 2, 3, 4, 5}));
  EXPECT_EQ(parse_seeds("7-7"), Seeds{7});
  EXPECT_EQ(parse_seeds("0,4-6"), (Seeds{0, 4, 5, 6}));
  EXPECT_EQ(parse_seeds("0-999").size(), 1000u);
  EXPECT_EQ(parse_seeds("18446744073709551615"), Seeds{18446744073709551615U}) << "the greatest seed";
  EXPECT_EQ(parse_seeds("18446744073709551613-18446744073709551615").size(), 3u);
}

TEST(StudySpec, InvalidSeedsAreRefused) {
  for (const char* text : {"", "x", "-1", "1-", "-", "5-1", "1.5", "3,3", "1-4,2", "1,,2", "0-1000", "1--2",
                           "99999999999999999999999", "0-18446744073709551615", "18446744073709551616", "+1", " 1"}) {
    EXPECT_THROW(parse_seeds(text), InputError) << text;
  }
}

// `--seed 010` is refused, too: many programs read it as 8.
TEST(StudySpec, SeedsWithLeadingZerosAreRefused) {
  for (const std::string text : {"010", "00", "1,02", "01-3", "1-03", "0,1,2-010"}) {
    for (const std::string option : {"--seeds", "--scene-seeds"}) {
      try {
        parse_seeds(text, option);
        ADD_FAILURE() << "accepted: " << text;
      } catch (const InputError& error) {
        const std::string said = error.what();
        EXPECT_EQ(said.find(option + " " + text + ": '"), 0U) << said;
        EXPECT_NE(said.find("' must be a whole number in decimal digits, without a zero before it"), std::string::npos)
            << said;
      }
    }
  }
}

TEST(StudySpec, EachPlannerKeepsItsAgent) {
  EXPECT_EQ(split_planners("kios@a/b,kios:x=1,y=2@c=d,kios"), (Texts{"kios@a/b", "kios:x=1,y=2@c=d", "kios"}));
  EXPECT_THROW(split_planners("kios@a,x=1"), InputError);
}

TEST(StudySpec, LabelsHaveAsMuchOfTheAgentsPathsAsDistinguishesThem) {
  EXPECT_EQ(planner_labels({"kios", "kios@x/a", "kios@x/b", "star@x/a"}),
            (Texts{"kios", "kios@a", "kios@b", "star@a"}));
  EXPECT_EQ(planner_labels({"kios@a/build/it", "star:x=1@b/build/it", "kios@b/install/it", "star@c/one"}),
            (Texts{"kios@a/build/it", "star:x=1@b/build/it", "kios@install/it", "star@one"}));
  EXPECT_EQ(planner_labels({"kios@/it", "kios@/a/it"}), (Texts{"kios@/it", "kios@a/it"}));
  EXPECT_EQ(planner_labels({"a=kios@a/it,b=kios@b/it", "exec:x @a/b"}),
            (Texts{"a=kios@a/it,b=kios@b/it", "exec:x @a/b"}));
  EXPECT_EQ(planner_labels({"kios@/a", "kios@/b/../a", "kios"}), (Texts{"kios@a", "kios@a", "kios"}))
      << "both paths name the same program";
}

TEST(StudySpec, FoldersAreDistinctAndSafe) {
  const Texts names = folder_names({"kios", "kios:a=1", "kios_a_1", "kios:a:1", "../x", "kios_a_1-2"});
  EXPECT_EQ(names[0], "kios");
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(names[i].find('/'), std::string::npos);
    EXPECT_EQ(std::count(names.begin(), names.end(), names[i]), 1) << names[i];
  }
}

TEST(StudyFlights, DurationsAreReadable) {
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(89.0), "89 s");
  EXPECT_EQ(duration_text(600.0), "10 min");
  EXPECT_EQ(duration_text(12000.0), "3 h 20 min");
}

}  // namespace
}  // namespace skein::cli
