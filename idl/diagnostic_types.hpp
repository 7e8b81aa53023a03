// Types of diagnostic_msgs, as type_names.hpp has all others: apart, since one program alone writes them.
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
