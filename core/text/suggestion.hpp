// Parts of messages to a user: suggestions for a mistyped name, lists, counts. Pure; safe from any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// The end of a message about an unknown name: "did you mean 'towers'?" when one of `known` is near (edit distance
/// at most a third of the word, at least 2), else "known are: a, b, c", in the order given.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

/// "a, b, c".
std::string joined(const std::vector<std::string>& words, std::string_view separator = ", ");

/// A list for a message: all words if there are at most `most` (>= 1), otherwise the first most - 1 "and N more".
std::string joined_first(const std::vector<std::string>& words, std::size_t most = 10);

/// A count with its noun, whose plural ends in "s": "1 flight", "3 flights".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace skein
