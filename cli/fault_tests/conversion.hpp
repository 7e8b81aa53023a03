// Turns fault tests of earlier versions into those of this one: most keys that `expect` had are properties now
// (docs/decisions/0046-one-language-for-what-must-hold.md). Pure.
#pragma once

#include <string>
#include <vector>

#include "core/config/config_node.hpp"

namespace skein::cli {

/// The keys of `expect` that became properties.
const std::vector<std::string>& old_expectations();

/// The text of a fault test, with a property for each such key; the same text if there is none. Text outside `expect`
/// stays as it is, and comments within `expect` stay as lines of their own. An expectation that holds by default, or
/// that a property of the file states as strongly, gives no property.
/// @throws InputError where `expect` is wrong, if no property can be added to the file, or if it is not a fault test
std::string converted(const ConfigDocument& document);

}  // namespace skein::cli
