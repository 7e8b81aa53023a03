#include "cli/study/requirement.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

using Relation = Requirement::Relation;

/// Relations of two characters come first, because "<" is the beginning of "<=".
constexpr std::array<std::pair<const char*, Relation>, 6> kRelations = {{{"==", Relation::equal},
                                                                         {"!=", Relation::unequal},
                                                                         {"<=", Relation::at_most},
                                                                         {">=", Relation::at_least},
                                                                         {"<", Relation::less},
                                                                         {">", Relation::more}}};

std::string trimmed(std::string text) {
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  text.erase(std::find_if_not(text.rbegin(), text.rend(), is_space).base(), text.end());
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_space));
  return text;
}

}  // namespace

bool Requirement::holds(const std::optional<FlightFigures>& figures) const {
  const std::optional<double> figure = figures ? column->value(*figures) : std::nullopt;
  if (!figure) return false;
  switch (relation) {
    case Relation::equal:
      return *figure == value;
    case Relation::unequal:
      return *figure != value;
    case Relation::less:
      return *figure < value;
    case Relation::at_most:
      return *figure <= value;
    case Relation::more:
      return *figure > value;
    case Relation::at_least:
      return *figure >= value;
  }
  return false;
}

Requirement parse_requirement(const std::string& text) {
  std::vector<std::string> names;
  for (const StudyColumn& column : study_columns()) names.push_back(column.name);
  for (const auto& [sign, relation] : kRelations) {
    const std::size_t at = text.find(sign);
    if (at == std::string::npos) continue;
    const std::string name = trimmed(text.substr(0, at)), number = trimmed(text.substr(at + std::string(sign).size()));
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      throw InputError("--require " + text + ": there is no figure '" + name + "'; " + suggestion(name, names));
    }
    const std::optional<double> value = parse_number(number);
    if (!value) throw InputError("--require " + text + ": '" + number + "' is no number");
    return {text, &study_column(name), relation, *value};
  }
  throw InputError("--require " + text + ": write a figure, a relation and a number: collisions==0");
}

}  // namespace skein::cli
