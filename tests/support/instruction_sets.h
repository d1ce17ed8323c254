#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "core/dynamics/spring_precision.h"

namespace limber::test {

// Runs a test with the kernels of every instruction set that this machine has.
template <class Test>
void on_every_target(const Test& test) {
  for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (target == HWY_SCALAR) continue;  // the kernels ask for SSSE3 at least
    hwy::SetSupportedTargetsForTest(target);
    SCOPED_TRACE(vector_instructions());
    EXPECT_STREQ(vector_instructions(), hwy::TargetName(target));
    test();
  }
  hwy::SetSupportedTargetsForTest(0);
}

// What reciprocals are sure to: 1.5 x 2^-12 (RCPPS in Intel's manual, volume 2); AVX-512's two of
// 2^-14 each, one of them squared, are together no worse.
inline constexpr double kReciprocalError = 1.5 / 4096.0;

}  // namespace limber::test
