#include "core/dynamics/edge_kernel.h"

// Highway compiles the rest of this file once per instruction set and picks one at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/dynamics/edge_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

#include "core/dynamics/vector_spring-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limber {
namespace HWY_NAMESPACE {
namespace {

using Float4 = hn::FixedTag<float, 4>;
using Int4 = hn::FixedTag<std::int32_t, 4>;

// d and w of each spring, four numbers each.
struct alignas(64) Differences {
  float d[4 * kEdgeBatch];
  float w[4 * kEdgeBatch];
};

HWY_INLINE void gather(const EdgeColumns& edges, std::int32_t first, const PackedMotion* motion,
                       Differences& differences) {
  const Float4 f;
  const Int4 i;
  for (std::int32_t e = 0; e < kEdgeBatch; ++e) {
    const PackedMotion& a = motion[edges.a[first + e]];
    const PackedMotion& b = motion[edges.b[first + e]];
    const auto d = hn::Sub(hn::Load(i, b.position), hn::Load(i, a.position));
    const auto w = hn::Sub(hn::Load(f, b.velocity), hn::Load(f, a.velocity));
    hn::Store(hn::ConvertTo(f, d), f, differences.d + 4 * e);
    hn::Store(w, f, differences.w + 4 * e);
  }
}

HWY_INLINE std::uint32_t pull_some(const EdgeColumns& edges, std::int32_t first,
                                   const Differences& differences, std::int32_t from,
                                   float* pulls) {
  const Floats f;
  VF dx, dy, dz, wx, wy, wz, none;
  hn::LoadInterleaved4(f, differences.d + 4 * from, dx, dy, dz, none);
  hn::LoadInterleaved4(f, differences.w + 4 * from, wx, wy, wz, none);
  const std::int32_t e = first + from;
  const VectorSpring spring = {hn::LoadU(f, edges.stiffness + e), hn::LoadU(f, edges.damping + e),
                               hn::LoadU(f, edges.rest_length + e)};
  const VectorPull pull = vector_pull(spring, dx, dy, dz, wx, wy, wz);
  hn::StoreInterleaved4(hn::Mul(pull.per_length, dx), hn::Mul(pull.per_length, dy),
                        hn::Mul(pull.per_length, dz), hn::Zero(f), f, pulls + 4 * from);
  const auto too_long = hn::Gt(pull.excess, hn::LoadU(f, edges.longest + e));
  const auto too_short = hn::Lt(pull.excess, hn::LoadU(f, edges.shortest + e));
  return bits_of(hn::Or(too_long, too_short));
}

}  // namespace

std::uint64_t pull_batch(const EdgeColumns& edges, std::int32_t first, const PackedMotion* motion,
                         float* pulls) {
  Differences differences;
  gather(edges, first, motion, differences);
  std::uint64_t bits = 0;
  constexpr auto kLanes = static_cast<std::int32_t>(hn::MaxLanes(Floats()));
  for (std::int32_t from = 0; from < kEdgeBatch; from += kLanes) {
    bits |= std::uint64_t{pull_some(edges, first, differences, from, pulls)} << from;
  }
  return bits;
}

void scatter_batch(const EdgeColumns& edges, std::int32_t first, const float* pulls,
                   PackedForce* force) {
  const Float4 f;
  for (std::int32_t e = 0; e < kEdgeBatch; ++e) {
    const auto pull = hn::LoadU(f, pulls + 4 * e);
    float* a = force[edges.a[first + e]].value;
    float* b = force[edges.b[first + e]].value;
    hn::Store(hn::Add(hn::Load(f, a), pull), f, a);
    hn::Store(hn::Sub(hn::Load(f, b), pull), f, b);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace limber
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limber {

HWY_EXPORT(pull_batch);
HWY_EXPORT(scatter_batch);

std::uint64_t pull_edges(const EdgeColumns& edges, std::int32_t first, const PackedMotion* motion,
                         float* pulls) {
  return HWY_DYNAMIC_DISPATCH(pull_batch)(edges, first, motion, pulls);
}

void scatter_pulls(const EdgeColumns& edges, std::int32_t first, const float* pulls,
                   PackedForce* force) {
  HWY_DYNAMIC_DISPATCH(scatter_batch)(edges, first, pulls, force);
}

}  // namespace limber
#endif
