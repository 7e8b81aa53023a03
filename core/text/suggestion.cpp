#include "core/text/suggestion.hpp"

#include <algorithm>
#include <numeric>

namespace skein {
namespace {

/// Levenshtein distance. Only one row of the table is stored.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongestWord = 64;  // a longer one is not a typing error
  std::size_t best = word.size() > kLongestWord ? 0 : std::max<std::size_t>(2, word.size() / 3) + 1;
  const std::string* nearest = nullptr;
  for (const std::string& candidate : known) {
    if (best == 0) break;
    // A forgotten unit ("mass" for mass_kg) is as near as one wrong letter.
    const bool is_start = word.size() >= 3 && candidate.size() > word.size() && candidate.starts_with(word) &&
                          candidate[word.size()] == '_';
    const std::size_t distance = is_start ? 1 : edit_distance(word, candidate);
    if (distance < best && distance < candidate.size()) {
      best = distance;
      nearest = &candidate;
    }
  }
  if (nearest) return "did you mean '" + *nearest + "'?";
  return known.empty() ? "none is known" : "known are: " + joined(known);
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string out;
  for (const std::string& word : words) {
    if (!out.empty()) out += separator;
    out += word;
  }
  return out;
}

std::string joined_first(const std::vector<std::string>& words, std::size_t most) {
  if (words.size() <= most) return joined(words);
  const std::vector<std::string> first(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(most) - 1);
  return joined(first) + " and " + std::to_string(words.size() - first.size()) + " more";
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace skein
