// A visitor for std::visit() made of several lambdas, one for each alternative of the variant.
#pragma once

namespace skein {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

/// C++20 needs no such deduction guide, but clang-tidy 16 does.
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace skein
