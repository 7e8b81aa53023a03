// Memory that two programs share, field by field: one program lays the block out, and tells the other by name, type,
// shape and offset what lies where. Fields are arrays of numbers in the machine's byte order, row by row.
// Pure.   Threads: one lays out; how both take turns at the fields is for them to agree upon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace skein {

/// A field as the other program needs it. `type` is as NumPy names it: "<f8".
struct BlockField {
  std::string name;
  std::string type;
  std::vector<std::size_t> shape;  ///< empty: one number
  std::size_t offset = 0;          ///< bytes from the block's beginning
  bool operator==(const BlockField&) const = default;
};

/// Where an array lies in every block of a layout.
template <class T>
struct BlockArray {
  std::size_t offset = 0, size = 0;
  std::span<T> in(std::byte* block) const { return {reinterpret_cast<T*>(block + offset), size}; }
};

class BlockLayout {
 public:
  /// Adds a field behind the others. @param shape  empty: one number.
  template <class T>
  BlockArray<T> add(std::string name, std::vector<std::size_t> shape = {}) {
    const std::size_t count = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
    bytes_ = (bytes_ + kAlignment - 1) / kAlignment * kAlignment;
    const BlockArray<T> array{bytes_, count};
    fields_.push_back({std::move(name), type_name<T>(), std::move(shape), bytes_});
    bytes_ += count * sizeof(T);
    return array;
  }

  const std::vector<BlockField>& fields() const { return fields_; }
  std::size_t bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kAlignment = 8;

  template <class T>
  static std::string type_name() {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, float> || std::is_same_v<T, std::int64_t> ||
                  std::is_same_v<T, std::int8_t>);
    const char kind = std::is_floating_point_v<T> ? 'f' : 'i';
    return (sizeof(T) == 1 ? "|" : "<") + std::string(1, kind) + std::to_string(sizeof(T));
  }

  std::vector<BlockField> fields_;
  std::size_t bytes_ = 0;
};

}  // namespace skein
