// The damped spring of spring_force.h on vectors, in single precision. Highway's way of sharing
// code between files that are compiled once per instruction set: no ordinary include guard.
#if defined(LIMBER_VECTOR_SPRING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMBER_VECTOR_SPRING_INL_H
#undef LIMBER_VECTOR_SPRING_INL_H
#else
#define LIMBER_VECTOR_SPRING_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limber {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using Words = hn::RebindToUnsigned<Floats>;
using VF = hn::Vec<Floats>;
using VI = hn::Vec<Ints>;
using VU = hn::Vec<Words>;

struct VectorSpring {
  VF stiffness;    // N/m
  VF damping;      // N s/m per quantum
  VF rest_length;  // quanta
};

struct VectorPull {
  VF per_length;  // tension over length, N/m: times d in quanta and the quantum, the force
  VF excess;      // L^2 - L0^2, quanta^2
};

// 1 / sqrt(x), to 2^-14 with AVX-512; the others begin at 1.5 x 2^-12 and get a step of Newton's.
HWY_INLINE VF inverse_root(VF square) {
  const Floats f;
  const VF u = hn::ApproximateReciprocalSqrt(square);
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  (void)f;
  return u;
#else
  const VF half = hn::Mul(square, hn::Set(f, 0.5f));
  return hn::Mul(u, hn::NegMulAdd(hn::Mul(half, u), u, hn::Set(f, 1.5f)));
#endif
}

// d = x_b - x_a, quanta; w = v_b - v_a, m/s. With e = d^2 - L0^2 and u = 1 / |d|,
//   T / L = k (L - L0) / L + c (d . w) / L^2 = (k e / (1 + L0 u) + c d . w) u^2:
// the small difference of two lengths does not occur, so that u need not be exact. The wrong share
// it leaves, up to 2e-4 (4e-4 without AVX-512), depends on |d| alone: the force still has a potential.
HWY_INLINE VectorPull vector_pull(const VectorSpring& spring, VF dx, VF dy, VF dz, VF wx, VF wy,
                                  VF wz) {
  const Floats f;
  const VF one = hn::Set(f, 1.0f);
  const VF rest = spring.rest_length;
  const VF rest_square = hn::Mul(rest, rest);
  const VF excess = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::MulSub(dz, dz, rest_square)));
  // The sum has lost what is below L0 / 256, so that a spring this short pushes less the shorter it
  // is; coincident points have a direction of zero instead of NaN.
  const VF least_square = hn::MulAdd(rest_square, hn::Set(f, 0x1p-16f), one);
  const VF u = inverse_root(hn::Max(hn::Add(excess, rest_square), least_square));
  const VF share = hn::ApproximateReciprocal(hn::MulAdd(rest, u, one));
  const VF rate = hn::MulAdd(dx, wx, hn::MulAdd(dy, wy, hn::Mul(dz, wz)));
  const VF elastic = hn::Mul(excess, share);
  const VF sum = hn::MulAdd(spring.stiffness, elastic, hn::Mul(spring.damping, rate));
  return {hn::Mul(sum, hn::Mul(u, u)), excess};
}

// Bit i: lane i.
HWY_INLINE std::uint32_t bits_of(hn::Mask<Floats> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Floats(), mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

}  // namespace HWY_NAMESPACE
}  // namespace limber
HWY_AFTER_NAMESPACE();

#endif
