// Parses the text of a property:
//   [for u in uavs,] [whenever CONDITION,] always CONDITION     or never, sometimes, eventually, finally
//   [for u in uavs,] CONDITION until CONDITION
// then, all optional: `unless CONDITION`; `within 20 s`; one of `after heal`, `after 20 s`, `from 10 s to 20 s`.
// Conditions: core/expressions/expression_parser.hpp.  Pure.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/expressions/expression_parser.hpp"
#include "core/scenario/scenario.hpp"
#include "signals/properties/property.hpp"

namespace skein::properties {

/// @returns one property per binding of the text's variables, in fleet order; two variables are never bound to the same
/// UAV.
/// @param scenario  has the UAVs that the text may name; times must be below its duration.
/// @param parameters  values of the names that the text uses as parameters.
/// @throws ExpressionError if the text is wrong, or the fleet permits no binding.
std::vector<Property> parse_property(const std::string& name, const std::string& text, const Scenario& scenario,
                                     const std::map<std::string, Quantity>& parameters = {});

}  // namespace skein::properties
