#include "core/dynamics/stencil_kernel.h"

#include "core/dynamics/spring_precision.h"

// Highway compiles the rest of this file once per instruction set and picks one at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/dynamics/stencil_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

#include "core/dynamics/vector_spring-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limber {
namespace HWY_NAMESPACE {
namespace {

constexpr Floats kFloats;
constexpr Ints kInts;
constexpr Words kWords;

struct Cells {
  VI x, y, z;  // position, quanta
  VF u, v, w;  // velocity, m/s
};

struct Sums {
  VF x, y, z;  // force / quantum, N/m
  hn::Mask<Floats> overstretched;
};

HWY_INLINE Cells load(const StencilView& view, std::ptrdiff_t cell) {
  return {hn::LoadU(kInts, view.position[0] + cell),   hn::LoadU(kInts, view.position[1] + cell),
          hn::LoadU(kInts, view.position[2] + cell),   hn::LoadU(kFloats, view.velocity[0] + cell),
          hn::LoadU(kFloats, view.velocity[1] + cell), hn::LoadU(kFloats, view.velocity[2] + cell)};
}

// table[class] for every lane.
HWY_INLINE VF look_up(const std::array<float, kStencilClasses>& table, VU spring_class) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  return hn::TableLookupLanes(hn::Load(kFloats, table.data()),
                              hn::IndicesFromVec(kFloats, spring_class));
#elif HWY_TARGET == HWY_AVX2
  const VU in_half = hn::And(spring_class, hn::Set(kWords, 7u));
  const auto index = hn::IndicesFromVec(kFloats, in_half);
  const VF low = hn::TableLookupLanes(hn::Load(kFloats, table.data()), index);
  const VF high = hn::TableLookupLanes(hn::Load(kFloats, table.data() + 8), index);
  const auto in_high = hn::TestBit(spring_class, hn::Set(kWords, 8u));
  return hn::IfThenElse(hn::RebindMask(kFloats, in_high), high, low);
#else
  return hn::GatherIndex(kFloats, table.data(), hn::BitCast(kInts, spring_class));
#endif
}

template <bool kCrush>
HWY_INLINE void add_spring(const StencilConstants& constants, const Cells& here, const Cells& there,
                           VU spring_class, Sums& sums) {
  const VF dx = hn::ConvertTo(kFloats, hn::Sub(there.x, here.x));
  const VF dy = hn::ConvertTo(kFloats, hn::Sub(there.y, here.y));
  const VF dz = hn::ConvertTo(kFloats, hn::Sub(there.z, here.z));
  const VectorSpring spring = {look_up(constants.stiffness, spring_class),
                               look_up(constants.damping, spring_class),
                               hn::Set(kFloats, constants.rest_length)};
  const VectorPull pull = vector_pull(spring, dx, dy, dz, hn::Sub(there.u, here.u),
                                      hn::Sub(there.v, here.v), hn::Sub(there.w, here.w));
  sums.x = hn::MulAdd(pull.per_length, dx, sums.x);
  sums.y = hn::MulAdd(pull.per_length, dy, sums.y);
  sums.z = hn::MulAdd(pull.per_length, dz, sums.z);
  const VF longest = look_up(constants.longest, spring_class);
  sums.overstretched = hn::Or(sums.overstretched, hn::Gt(pull.excess, longest));
  if constexpr (kCrush) {
    const VF shortest = look_up(constants.shortest, spring_class);
    sums.overstretched = hn::Or(sums.overstretched, hn::Lt(pull.excess, shortest));
  }
}

// Half 2 d leads on, half 2 d + 1 back.
template <bool kCrush, int kHalf>
HWY_INLINE void add_half(const StencilView& view, std::ptrdiff_t cell, const Cells& here,
                         VU classes, Sums& sums) {
  if constexpr (kHalf < 2 * kGridDirections) {
    const StencilConstants& constants = view.constants[kHalf / 2];
    const std::ptrdiff_t offset = kHalf % 2 == 0 ? constants.offset : -constants.offset;
    const VU shifted = hn::ShiftRight<4 * (kHalf % 8)>(classes);
    const VU spring_class = hn::And(shifted, hn::Set(kWords, kStencilClasses - 1u));
    add_spring<kCrush>(constants, here, load(view, cell + offset), spring_class, sums);
  }
}

template <bool kCrush, int kWord>
HWY_INLINE void add_word(const StencilView& view, std::ptrdiff_t cell, const Cells& here,
                         Sums& sums) {
  const VU classes = hn::LoadU(kWords, view.classes[kWord] + cell);
  add_half<kCrush, 8 * kWord + 0>(view, cell, here, classes, sums);
  add_half<kCrush, 8 * kWord + 1>(view, cell, here, classes, sums);
  add_half<kCrush, 8 * kWord + 2>(view, cell, here, classes, sums);
  add_half<kCrush, 8 * kWord + 3>(view, cell, here, classes, sums);
  add_half<kCrush, 8 * kWord + 4>(view, cell, here, classes, sums);
  add_half<kCrush, 8 * kWord + 5>(view, cell, here, classes, sums);
  add_half<kCrush, 8 * kWord + 6>(view, cell, here, classes, sums);
  add_half<kCrush, 8 * kWord + 7>(view, cell, here, classes, sums);
}

template <bool kCrush>
HWY_INLINE std::uint32_t sum_cells(const StencilView& view, std::ptrdiff_t cell) {
  const Cells here = load(view, cell);
  const VF zero = hn::Zero(kFloats);
  Sums sums = {zero, zero, zero, hn::Gt(zero, zero)};
  add_word<kCrush, 0>(view, cell, here, sums);
  add_word<kCrush, 1>(view, cell, here, sums);
  add_word<kCrush, 2>(view, cell, here, sums);
  add_word<kCrush, 3>(view, cell, here, sums);
  const VF quantum = hn::Set(kFloats, view.quantum);
  hn::StoreU(hn::Mul(sums.x, quantum), kFloats, view.force[0] + cell);
  hn::StoreU(hn::Mul(sums.y, quantum), kFloats, view.force[1] + cell);
  hn::StoreU(hn::Mul(sums.z, quantum), kFloats, view.force[2] + cell);
  return bits_of(sums.overstretched);
}

template <bool kCrush>
void sum_blocks(const StencilView& view, const std::int32_t* blocks, std::size_t count,
                std::uint16_t* overstretched) {
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(kFloats));
  for (std::size_t b = 0; b < count; ++b) {
    std::uint32_t bits = 0;
    for (int lane = 0; lane < kStencilBlock; lane += kLanes) {
      bits |= sum_cells<kCrush>(view, blocks[b] + lane) << lane;
    }
    overstretched[b] = static_cast<std::uint16_t>(bits);
  }
}

}  // namespace

void stretch_only(const StencilView& view, const std::int32_t* blocks, std::size_t count,
                  std::uint16_t* overstretched) {
  sum_blocks<false>(view, blocks, count, overstretched);
}

void stretch_and_crush(const StencilView& view, const std::int32_t* blocks, std::size_t count,
                       std::uint16_t* overstretched) {
  sum_blocks<true>(view, blocks, count, overstretched);
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace limber
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limber {

HWY_EXPORT(stretch_only);
HWY_EXPORT(stretch_and_crush);
HWY_EXPORT(target_name);

void sum_stencil_forces(const StencilView& view, std::span<const std::int32_t> blocks,
                        std::span<std::uint16_t> overstretched) {
  if (view.crush) {
    HWY_DYNAMIC_DISPATCH(stretch_and_crush)
    (view, blocks.data(), blocks.size(), overstretched.data());
  } else {
    HWY_DYNAMIC_DISPATCH(stretch_only)
    (view, blocks.data(), blocks.size(), overstretched.data());
  }
}

const char* vector_instructions() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

}  // namespace limber
#endif
