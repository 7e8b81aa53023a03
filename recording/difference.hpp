// Finds the first difference between the samples that a program sends in a replay and its recorded samples. Pure.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "recording/mcap/records.hpp"

namespace skein::recording {

/// A difference on one topic in one step.
struct Difference {
  std::string node, topic;  ///< topic: name in the recording
  Tick tick = 0;
  std::string recorded, now;  ///< the two samples as text for people; "nothing": there is no sample
};

/// A sample as text for people: the numbers of a command, the text of a string, else size and checksum.
std::string describe(const std::string& wire_type, mcap::ByteView payload);

/// The first two samples of a topic that differ between the recorded step and the present one, as text (describe(), or
/// "nothing"). @returns nullopt: there is no difference.
std::optional<std::pair<std::string, std::string>> first_difference(const std::string& wire_type,
                                                                    std::span<const mcap::Bytes> recorded,
                                                                    std::span<const mcap::Bytes> now);

/// "jurong first differs at 12.35 s on /jurong/command/trajectory: it was ..., and is ..."
std::string text_of(const Difference& difference);

}  // namespace skein::recording
