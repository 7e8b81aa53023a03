// For tests over every message type: the list of all types, and a message of each in which nothing is empty.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "idl/cdr.hpp"
#include "idl/type_names.hpp"

namespace skein {

/// All types of the table. msg::Time precedes them, because the table begins with a comma.
#define SKEIN_COMMA_TYPE(package, name) , msg::name
using AllMessageTypes = testing::Types<msg::Time SKEIN_ALL_TYPES(SKEIN_COMMA_TYPE)>;
#undef SKEIN_COMMA_TYPE

/// A message in which each sequence has one element. It is decoded from the bytes 01 00 00 00 01 00 00 00 ...: CDR puts
/// lengths at multiples of four, so each length is read as 1.
template <class T>
T filled_message() {
  std::vector<std::uint8_t> ones(4096);
  for (std::size_t i = 4; i < ones.size(); i += 4) ones[i] = 1;
  ones[1] = 1;
  T message;
  EXPECT_TRUE(decode(ones, message));
  return message;
}

}  // namespace skein
