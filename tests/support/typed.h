#pragma once
// Names and lists for typed tests.
#include <airlight/math/simd.h>
#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <variant>

namespace airlight::test {

using Arithmetics = ::testing::Types<double, float, FloatBatch>;

struct ArithmeticName {
  template <class F>
  static std::string GetName(int) {
    return std::same_as<F, double> ? "double" : std::same_as<F, float> ? "float" : "FloatBatch";
  }
};

/// The members of a family, such as `Phases`.
template <class Family>
struct MembersOf;
template <class... Members>
struct MembersOf<std::variant<Members...>> {
  using Types = ::testing::Types<Members...>;
};

/// A member's name as a user says it, in characters that a test's name may have.
struct MemberName {
  template <class Member>
  static std::string GetName(int) {
    std::string name = Member::name;
    for (char& c : name)
      if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
  }
};

}  // namespace airlight::test
