// Types of diagnostic_msgs. They are not in type_names.hpp, because only one program writes them.
#pragma once

#include "idl/diagnostic_msgs.h"
#include "idl/type_names.hpp"

namespace skein {

namespace msg {
using KeyValue = diagnostic_msgs::msg::dds_::KeyValue_;
using DiagnosticStatus = diagnostic_msgs::msg::dds_::DiagnosticStatus_;
using DiagnosticArray = diagnostic_msgs::msg::dds_::DiagnosticArray_;
}  // namespace msg

template <>
struct TypeName<msg::DiagnosticArray> {
  static constexpr const char* kValue = "diagnostic_msgs::msg::dds_::DiagnosticArray_";
};

}  // namespace skein
