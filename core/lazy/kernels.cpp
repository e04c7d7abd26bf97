#include "core/lazy/kernels.h"

#include "core/types/vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/lazy/kernels.cpp"
#include <hwy/foreach_target.h>
// clang-format off: highway.h must follow foreach_target.h
#include <hwy/highway.h>
// clang-format on

#include "core/lazy/refit-inl.h"
#include "core/lazy/traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {

void collide(BodiesToTest bodies, bool first_only, LazyScratch& scratch,
             std::vector<ElementPair>& out) {
  PairTraversal(bodies, first_only, scratch, out).run();
}

void collide_self(BodiesToTest bodies, bool first_only, LazyScratch& scratch,
                  std::vector<ElementPair>& out) {
  PairTraversal(bodies, first_only, scratch, out).run_self();
}

void spread(BodiesToTest bodies, std::size_t slots, LazyScratch& scratch, BvttFront& front) {
  std::vector<ElementPair> none;
  PairTraversal(bodies, false, scratch, none).spread(slots, front);
}

void collide_part(BodiesToTest bodies, FrontPart part, bool first_only, LazyScratch& scratch,
                  std::vector<ElementPair>& out) {
  PairTraversal(bodies, first_only, scratch, out).run(part);
}

void bound_all(LazyState& state, FrameArena& arena) {
  if (state.from_vertices && state.precision == Precision::kSingle)
    return refit<float>(state, arena);
  if (state.from_vertices) return refit<double>(state, arena);
  for (std::uint32_t block = 0; block < state.tree->blocks.size(); ++block)
    bounds(state, block, arena);
}

BatchVerdict test_batch(const TriangleBatch& batch) { return test_batch_in(batch); }

BatchVerdict test_single_batch(const SingleTriangleBatch& batch) { return test_batch_in(batch); }

const LeafCache& map_leaf(LazyState& state, std::uint32_t leaf, FrameArena& arena) {
  return map_leaf_in<double>(state, leaf, arena);
}

const SingleLeafCache& map_single_leaf(LazyState& state, std::uint32_t leaf, FrameArena& arena) {
  return map_leaf_in<float>(state, leaf, arena);
}

const LazyKernels& kernels() {
  static const LazyKernels all = {hwy::TargetName(HWY_TARGET),
                                  collide,
                                  collide_self,
                                  spread,
                                  collide_part,
                                  bound_all,
                                  test_batch,
                                  test_single_batch,
                                  map_leaf,
                                  map_single_leaf};
  return all;
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "core/types/check.h"

namespace contactcheck {
namespace {

struct Compiled {
  std::int64_t target;
  const LazyKernels& (*kernels)();
};

// Best first. The targets that Highway attempts on a platform differ; each names its own namespace.
std::vector<Compiled> compiled_targets() {
  return {
#if HWY_TARGETS & HWY_AVX3_DL
    {HWY_AVX3_DL, N_AVX3_DL::kernels},
#endif
#if HWY_TARGETS & HWY_AVX3
        {HWY_AVX3, N_AVX3::kernels},
#endif
#if HWY_TARGETS & HWY_AVX2
        {HWY_AVX2, N_AVX2::kernels},
#endif
#if HWY_TARGETS & HWY_SSE4
        {HWY_SSE4, N_SSE4::kernels},
#endif
#if HWY_TARGETS & HWY_SSSE3
        {HWY_SSSE3, N_SSSE3::kernels},
#endif
#if HWY_TARGETS & HWY_NEON
        {HWY_NEON, N_NEON::kernels},
#endif
        {HWY_STATIC_TARGET, HWY_STATIC_DISPATCH(kernels)},
  };
}

std::vector<const LazyKernels*> kernels_among(std::int64_t targets) {
  std::vector<const LazyKernels*> out;
  for (const Compiled& c : compiled_targets())
    if ((c.target & targets) != 0 && (out.empty() || out.back() != &c.kernels()))
      out.push_back(&c.kernels());
  return out;
}

std::vector<const LazyKernels*> usable_kernels() {
  return kernels_among(static_cast<std::int64_t>(hwy::SupportedTargets()));
}

std::vector<std::string> names_of(const std::vector<const LazyKernels*>& all) {
  std::vector<std::string> names;
  for (const LazyKernels* kernels : all) names.emplace_back(kernels->name);
  return names;
}

}  // namespace

std::vector<std::string> lazy_isas() { return names_of(usable_kernels()); }

std::vector<std::string> compiled_lazy_isas() { return names_of(kernels_among(HWY_TARGETS)); }

const LazyKernels& lazy_kernels(const std::string& isa) {
  std::string known = "best";
  for (const LazyKernels* kernels : usable_kernels()) {
    if (isa == "best" || isa == kernels->name) return *kernels;
    known += std::string(", ") + kernels->name;
  }
  throw Unavailable("instruction set " + isa + " does not run here; there are " + known);
}

}  // namespace contactcheck
#endif
