// Layout of a memory block that two programs share. One program builds the layout and sends the other program the name,
// type, shape and offset of each field. Fields are row-major arrays of numbers in the machine's byte order.
// Pure.   Threads: one thread builds a layout. The two programs must agree on when each of them accesses the fields.
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

/// A field, as described to the other program. `type` is NumPy's name of the type: "<f8".
struct BlockField {
  std::string name;
  std::string type;
  std::vector<std::size_t> shape;  ///< empty: one number
  std::size_t offset = 0;          ///< bytes from the block's beginning
  bool operator==(const BlockField&) const = default;
};

/// Place of an array, the same in every block that has this layout.
template <class T>
struct BlockArray {
  std::size_t offset = 0, size = 0;
  std::span<T> in(std::byte* block) const { return {reinterpret_cast<T*>(block + offset), size}; }
};

class BlockLayout {
 public:
  /// Appends a field. @param shape  empty: one number.
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
