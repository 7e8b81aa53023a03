#include "core/ids.hpp"

#include <gtest/gtest.h>

#include <concepts>
#include <type_traits>
#include <vector>

#include "core/radio/link_matrix.hpp"
#include "core/text/sha256.hpp"

namespace skein {
namespace {

// Code that mixes these types up does not compile.
static_assert(!std::is_convertible_v<std::size_t, Node> && !std::is_convertible_v<std::size_t, UavIndex>);
static_assert(!std::is_convertible_v<Node, UavIndex> && !std::is_convertible_v<UavIndex, Node>);
static_assert(!std::equality_comparable_with<Node, UavIndex>);
static_assert(!std::is_invocable_v<decltype(node_of_uav), Node> &&
              !std::is_invocable_v<decltype(node_of_uav), std::size_t>);
static_assert(!std::is_invocable_v<decltype(uav_of_node), UavIndex>);

TEST(Ids, NodesAreTheStationAndThenTheFleet) {
  EXPECT_EQ(uav_of_node(kStationNode), std::nullopt);
  for (const UavIndex uav : FirstUavs(5)) {
    EXPECT_EQ(node_of_uav(uav), Node{uav + 1});
    EXPECT_EQ(uav_of_node(node_of_uav(uav)), uav);
  }
  std::vector<Node> nodes;
  for (const Node node : FirstNodes(3)) nodes.push_back(node);
  EXPECT_EQ(nodes, (std::vector{Node{0}, Node{1}, Node{2}}));
}

TEST(Ids, AreHashedAsTheNumbersTheyAre) {
  EXPECT_EQ(Sha256().add(Node{7}).hex(), Sha256().add(std::size_t{7}).hex());
  EXPECT_EQ(Sha256().add(UavIndex{7}).hex(), Sha256().add(7).hex());
}

TEST(LinkMatrix, IsRowMajorBySender) {
  LinkMatrix<int> matrix(3);
  for (const Node from : FirstNodes(3)) {
    for (const Node to : FirstNodes(3)) matrix.at(from, to) = static_cast<int>(10 * from + to);
  }
  EXPECT_EQ(matrix.row_major(), (std::vector{0, 1, 2, 10, 11, 12, 20, 21, 22}));
  EXPECT_EQ(matrix, LinkMatrix<int>(3, matrix.row_major()));
}

TEST(LinkMatrix, HasAValueForEachLink) {
  EXPECT_THROW(LinkMatrix<int>(3, std::vector<int>(8)), std::invalid_argument);
  EXPECT_EQ(LinkMatrix<int>(0, std::vector<int>{}), LinkMatrix<int>());
}

}  // namespace
}  // namespace skein
