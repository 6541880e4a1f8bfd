#pragma once
// RapidCheck inside Catch2: seeded, so that every run checks the same cases, with the shrunk counterexample as message.
#include <rapidcheck.h>

#include <sstream>
#include <utility>

#include "schemes/vec3.h"
#include "tests/catch.h"

namespace shaolin {

/// Fails the test case with the smallest counterexample that RapidCheck finds in `count` cases.
template <class Testable>
void check_property(Testable&& testable, int count = 100) {
  rc::detail::TestParams params;
  params.seed = 20030901;
  params.maxSuccess = count;
  const auto result = rc::detail::checkTestable(std::forward<Testable>(testable), rc::detail::TestMetadata(), params);
  std::ostringstream message;
  rc::detail::printResultMessage(result, message);
  INFO(message.str());
  CHECK(result.template is<rc::detail::SuccessResult>());
}

/// A coordinate in [-4, 4], multiples of 2^-20: shrinks to 0. (RapidCheck shrinks a range to its lower end; odd numbers
/// stand for negative values.)
inline rc::Gen<double> coordinate() {
  return rc::gen::map(rc::gen::inRange(0, (8 << 20) + 1),
                      [](int k) { return (k % 2 == 0 ? k / 2 : -(k + 1) / 2) * 0x1p-20; });
}

inline rc::Gen<Vec3> any_point() {
  return rc::gen::map(rc::gen::tuple(coordinate(), coordinate(), coordinate()),
                      [](const auto& p) { return Vec3(std::get<0>(p), std::get<1>(p), std::get<2>(p)); });
}

}  // namespace shaolin
