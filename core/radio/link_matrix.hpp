// A value for each directed link between two radio nodes. On the wire and in files the matrix is row-major: one row per
// sender, one column per receiver. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/ids.hpp"

namespace skein {

template <class T>
class LinkMatrix {
 public:
  LinkMatrix() = default;  ///< of no nodes
  explicit LinkMatrix(std::size_t nodes, const T& value = T()) : nodes_(nodes), values_(nodes * nodes, value) {}
  /// @throws std::invalid_argument unless there is a value for each link.
  LinkMatrix(std::size_t nodes, std::vector<T> row_major) : nodes_(nodes), values_(std::move(row_major)) {
    if (values_.size() == nodes * nodes) return;
    throw std::invalid_argument("a link matrix of " + std::to_string(values_.size()) + " entries for " +
                                std::to_string(nodes) + " radio nodes");
  }

  T& at(Node from, Node to) { return values_[from * nodes_ + to]; }
  const T& at(Node from, Node to) const { return values_[from * nodes_ + to]; }

  std::size_t nodes() const { return nodes_; }
  const std::vector<T>& row_major() const { return values_; }
  bool operator==(const LinkMatrix&) const = default;

 private:
  std::size_t nodes_ = 0;
  std::vector<T> values_;
};

/// The open links: 0 = no link; otherwise, with path loss, the index of the link's rate in kRadioRates plus 1.
using Links = LinkMatrix<std::uint8_t>;

}  // namespace skein
