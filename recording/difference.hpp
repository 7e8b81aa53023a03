// Where what a program says parts from what was recorded of it. Pure.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "recording/mcap/records.hpp"

namespace skein::recording {

/// Of one topic, in one step.
struct Difference {
  std::string node, topic;
  Tick tick = 0;
  std::string recorded, now;  ///< what was said, for people; "nothing"
};

/// What a sample says: numbers of commands, the text of a string, else how long it is.
std::string describe(const std::string& wire_type, mcap::ByteView payload);

/// The first sample in which two steps differ on a topic. @returns nullopt: none.
std::optional<std::pair<std::string, std::string>> first_difference(const std::string& wire_type,
                                                                    std::span<const mcap::Bytes> recorded,
                                                                    std::span<const mcap::Bytes> now);

/// "jurong first differs at 12.35 s on /jurong/command/trajectory: it was ..., and is ..."
std::string text_of(const Difference& difference);

}  // namespace skein::recording
