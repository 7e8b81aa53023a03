// Parses the text header of a PCD file (point cloud).   Pure; any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace skein::sim {

struct PcdField {
  std::string name;       ///< "_": padding
  char type = 'F';        ///< F float, I signed, U unsigned
  std::size_t size = 4;   ///< bytes of one element
  std::size_t count = 1;  ///< number of elements

  std::size_t bytes() const { return size * count; }
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t points = 0;
  std::string data;             ///< "ascii", "binary" or "binary_compressed"
  std::size_t data_offset = 0;  ///< bytes from the start of the file
  int data_line = 0;            ///< line of the file on which ASCII data begin

  std::size_t elements_per_point() const;
  std::size_t bytes_per_point() const;
};

/// @param file   for error messages.   @param bytes  the whole file, or at least its header.
/// @throws InputError with file, line and key: no PCD header; a line unknown, repeated or missing; inconsistent
///   numbers; no points, or more than kMostPoints. No memory is allocated according to numbers in the header.
PcdHeader parse_pcd_header(const std::filesystem::path& file, std::string_view bytes);

}  // namespace skein::sim
