// Reads a property as people write it:
//   [for u in uavs,] [whenever CONDITION,] always CONDITION     or never, sometimes, eventually
//   [for u in uavs,] CONDITION until CONDITION
// and behind it, each at most once: `within 20 s`, `after heal` or `after 20 s`, `from 10 s to 20 s`.
// Conditions: core/expressions/expression_parser.hpp.  Pure.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/expressions/expression_parser.hpp"
#include "core/scenario.hpp"
#include "properties/property.hpp"

namespace skein::properties {

/// The property for each of those that its variables may stand for, in fleet order; variables of one property are
/// never the same UAV.
/// @param scenario  whose UAVs may be named, and whose mission's end no time may exceed.
/// @throws ExpressionError.
std::vector<Property> parse_property(const std::string& name, const std::string& text, const Scenario& scenario,
                                     const std::map<std::string, Quantity>& parameters = {});

}  // namespace skein::properties
