// map_point() on vector lanes, bit for bit: for the batch mapping and for lazy mapping
// (core/lazy/leaves-inl.h). Compiled once per instruction set.

#if defined(CONTACTCHECK_MAPPING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_MAPPING_INL
#undef CONTACTCHECK_MAPPING_INL
#else
#define CONTACTCHECK_MAPPING_INL
#endif

#include <hwy/highway.h>

#include "core/deform/lattice.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The operations of blend() in the same order, lane by lane: mul, mul, add, never fused.
template <class V>
HWY_INLINE V blend_lanes(V a, V b, V w, V one_minus_w) {
  return hn::Add(hn::Mul(a, one_minus_w), hn::Mul(b, w));
}

template <class D>
struct LocalLanes {
  hn::Vec<D> s, t, u, one_minus_s, one_minus_t, one_minus_u;
};

template <class D>
HWY_INLINE hn::Vec<D> map_axis(D d, const hn::TFromD<D>* corners, const LocalLanes<D>& w) {
  const auto along_s = [&](int low) HWY_ATTR {
    return blend_lanes(hn::Set(d, corners[low]), hn::Set(d, corners[low + 1]), w.s, w.one_minus_s);
  };
  const auto near_u = blend_lanes(along_s(0), along_s(2), w.t, w.one_minus_t);
  const auto far_u = blend_lanes(along_s(4), along_s(6), w.t, w.one_minus_t);
  return blend_lanes(near_u, far_u, w.u, w.one_minus_u);
}

template <class D>
HWY_INLINE LocalLanes<D> local_lanes(D d, hn::Vec<D> s, hn::Vec<D> t, hn::Vec<D> u) {
  const auto one = hn::Set(d, hn::TFromD<D>(1));
  return {s, t, u, hn::Sub(one, s), hn::Sub(one, t), hn::Sub(one, u)};
}

template <typename T>
HWY_INLINE void gather_corners(const CornerIds& ids, const Vec3Of<T>* nodes, T (&corners)[3][8]) {
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) corners[k][c] = nodes[ids[c]][k];
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
