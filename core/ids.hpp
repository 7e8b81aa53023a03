// Distinct types for the indices of UAVs and radio nodes: code that confuses the two does not compile. Construction is
// explicit; conversion to std::size_t is implicit, so that an id can be used as an index. Pure.
#pragma once

#include <cstddef>
#include <optional>

namespace skein {

/// @tparam Tag  kind of the id; ids with different tags can neither be compared nor assigned to each other.
template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  constexpr explicit Id(std::size_t value) : value_(value) {}
  constexpr operator std::size_t() const { return value_; }

  friend constexpr bool operator==(Id a, Id b) { return a.value_ == b.value_; }
  template <class Other>
  bool operator==(Id<Other>) const = delete;

 private:
  std::size_t value_ = 0;
};

/// A UAV, by its index in the fleet.
using UavIndex = Id<struct UavTag>;
/// A radio node: 0 is the ground station, UAV i (in fleet order) is node i + 1.
using Node = Id<struct NodeTag>;

inline constexpr Node kStationNode{0};
constexpr Node node_of_uav(UavIndex uav) { return Node(uav + 1); }
/// nullopt for the ground station.
constexpr std::optional<UavIndex> uav_of_node(Node node) {
  return node == kStationNode ? std::nullopt : std::optional(UavIndex(node - 1));
}

/// The ids 0 ... count - 1, for a range-based loop.
template <class Id>
class FirstIds {
 public:
  class Iterator {
   public:
    constexpr explicit Iterator(std::size_t at) : at_(at) {}
    constexpr Id operator*() const { return Id(at_); }
    constexpr Iterator& operator++() {
      ++at_;
      return *this;
    }
    constexpr bool operator==(const Iterator&) const = default;

   private:
    std::size_t at_;
  };

  constexpr explicit FirstIds(std::size_t count) : count_(count) {}
  constexpr Iterator begin() const { return Iterator(0); }
  constexpr Iterator end() const { return Iterator(count_); }

 private:
  std::size_t count_;
};
using FirstUavs = FirstIds<UavIndex>;
using FirstNodes = FirstIds<Node>;

}  // namespace skein
