#include "tests/core/lazy/translation_errors.h"

#include <array>
#include <cmath>

#include "core/types/vector_targets.h"
// clang-format off: before any header of Highway
#include "core/lazy/meeting-inl.h"
// clang-format on
#include "tests/support/observed_error.h"
#include "tests/support/random_triangles.h"
#include "tests/support/wide.h"

namespace contactcheck::test {
namespace {

namespace lanes = HWY_NAMESPACE;

// Origins of the frames of two bodies at both ends of a step.
struct Origins {
  Vec3 from, to, from_end, to_end;
};

// Two bodies in their frames. The sum of both reaches is no more than the offsets ask for, and
// boxes and slabs of about 1: their |coordinates| are at most 2.9 times that sum.
class TwoStates {
 public:
  static constexpr double kLeastReach = 0.35;
  TwoStates(const Origins& o, FramePair frames) {
    from.origin = o.from, from_end_.origin = o.from_end;
    to.origin = o.to, to_end_.origin = o.to_end;
    if (frames == FramePair::kMoving) from.end = &from_end_, to.end = &to_end_;
    const Vec3 start = o.from - o.to;
    const Vec3 end = frames == FramePair::kMoving ? Vec3(o.from_end - o.to_end) : start;
    const double longest = std::max(start.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff());
    const double grows = (end - start).cwiseAbs().maxCoeff();
    from.reach = to.reach = std::max(0.0, 0.5 * (std::max(kLeastReach, longest) - grows));
    translation = lanes::translation_between(from, to);
  }
  TwoStates(const TwoStates&) = delete;
  TwoStates& operator=(const TwoStates&) = delete;

  LazyState from, to;
  lanes::Translation translation;

 private:
  LazyState from_end_, to_end_;
};

double shortfall(const Origins& o, FramePair frames) {
  const TwoStates states(o, frames);
  const LaneBoxes zero{};
  const LaneSlabs none{};
  const lanes::MovedBounds moved{{zero, &none, 0}, states.translation};
  double largest = -1.0;
  for (int k = 0; k < 3; ++k) {
    const Wide start = Wide(o.from[k]) - o.to[k], end = Wide(o.from_end[k]) - o.to_end[k];
    for (const Wide& exact : {start, frames == FramePair::kMoving ? end : start}) {
      const Wide by = std::max(moved.lo(k) - exact, exact - moved.hi(k));
      const Wide size = std::max(magnitude(exact), Wide(0x1p-126));
      largest = std::max(largest, static_cast<double>(by / size));
    }
  }
  return largest;
}

// Two frames, a slab of the first and a lane of the second.
struct Frames {
  Origins origins;
  double middle = 0.0;  // of the slab that is along `axis`
  int axis = 0;
  std::array<float, 3> normal{}, lo{}, hi{};  // of the other one
  float other_middle = 0.0f, other_half = 0.0f;
};

Frames random_frames(TriangleSource& random) {
  Frames out;
  for (Vec3* origin :
       {&out.origins.from, &out.origins.to, &out.origins.from_end, &out.origins.to_end})
    *origin = random.point(Vec3::Zero(), 1.0);
  out.axis = random.below(3);
  out.middle = random.unit();
  const Vec3 normal = random.point(Vec3::Zero(), 1.0).normalized();
  for (std::size_t k = 0; k < 3; ++k) {
    out.normal[k] = static_cast<float>(normal[static_cast<int>(k)]);
    const double a = random.unit(), b = random.unit();
    out.lo[k] = static_cast<float>(std::min(a, b)), out.hi[k] = static_cast<float>(std::max(a, b));
  }
  out.other_middle = static_cast<float>(random.unit());
  out.other_half = static_cast<float>(std::abs(random.unit()));
  return out;
}

void change_frames(TriangleSource& random, Frames& f) {
  const auto little = [&] { return std::ldexp(random.unit(), -random.below(26)); };
  for (Vec3* origin : {&f.origins.from, &f.origins.to, &f.origins.from_end, &f.origins.to_end})
    (*origin)[random.below(3)] += little();
  f.middle += little();
  f.other_middle += static_cast<float>(little());
  const auto k = static_cast<std::size_t>(random.below(3));
  f.hi[k] = std::max(f.lo[k], f.hi[k] + static_cast<float>(little()));
}

// The test of slabs along an axis, so that the factor a has no error, which would be none of the
// test. The other one's slab has the normal, middle, half and box of `f`.
class SlabTest {
 public:
  SlabTest(const Frames& f, FramePair frames, Along along)
      : f_(f), frames_(frames), along_(along), states_(f.origins, frames) {}

  // Found by bisection: at which half-width of the slab along the axis the test no longer
  // separates, less that at which it should not.
  double error_over_slack() {
    const auto wanted = static_cast<double>(exact_half());
    double low = wanted - 1e-3, high = wanted + 1e-3;
    while (high - low > 1e-9) {
      const double half = 0.5 * (low + high);
      (meets(half) ? high : low) = half;
    }
    if (frames_ == FramePair::kOne)
      return (high - wanted) / (384 * 0x1p-24 * std::max(1.0, states_.from.reach));
    const double slack = states_.translation.slab_slack;
    // It is in the half of what is moved, and added once more where that comes times the cosine.
    const double taken = along_ == Along::kMoved ? 1.0 : 1.0 + std::abs(normal(f_.axis));
    return (high - wanted) / slack + taken;
  }

 private:
  double normal(int k) const { return f_.normal[static_cast<std::size_t>(k)]; }

  Wide offset_at_start(int k) const {
    if (frames_ == FramePair::kOne) return 0;
    return Wide(f_.origins.from[k]) - f_.origins.to[k];
  }
  Wide offset_at_end(int k) const {
    if (frames_ != FramePair::kMoving) return offset_at_start(k);
    return Wide(f_.origins.from_end[k]) - f_.origins.to_end[k];
  }
  Wide middle_offset(int k) const { return (offset_at_start(k) + offset_at_end(k)) / 2; }
  Wide half_growth(int k) const { return (offset_at_end(k) - offset_at_start(k)) / 2; }

  // By the derivation at not_separated(): n is the axis, m the other one's normal.
  Wide exact_half() const {
    const Wide a = normal(f_.axis);
    Wide middle = a * f_.other_middle, half = magnitude(a * f_.other_half);
    Wide grows = 0;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Wide rest = (k == f_.axis) - a * f_.normal[i];
      middle += rest * (Wide(f_.lo[i]) + f_.hi[i]) / 2;
      Wide wide = (Wide(f_.hi[i]) - f_.lo[i]) / 2;
      if (along_ == Along::kLane) {
        middle += (rest + a * f_.normal[i]) * middle_offset(k);
        wide += magnitude(half_growth(k));
        grows += f_.normal[i] * half_growth(k);
      }
      half += magnitude(rest) * wide;
    }
    half += magnitude(a * grows);
    Wide own = static_cast<float>(f_.middle);
    if (along_ == Along::kMoved) {
      own += middle_offset(f_.axis);
      half += magnitude(half_growth(f_.axis));
    }
    return magnitude(own - middle) - half;
  }

  bool meets(double half) const {
    LaneBoxes box{};
    LaneSlabs slab{};
    BlockBounds lane{};
    LaneBoxes& everything = along_ == Along::kMoved ? box : lane.box;
    LaneBoxes& other_box = along_ == Along::kMoved ? lane.box : box;
    LaneSlabs& along = along_ == Along::kMoved ? slab : lane.slab;
    LaneSlabs& other = along_ == Along::kMoved ? lane.slab : slab;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      everything.lo[k][0] = -1e20f, everything.hi[k][0] = 1e20f;  // the other comparison passes
      other_box.lo[k][0] = f_.lo[i], other_box.hi[k][0] = f_.hi[i];
      along.normal[k][0] = k == f_.axis ? 1.0f : 0.0f;
      other.normal[k][0] = f_.normal[i];
    }
    along.middle[0] = static_cast<float>(f_.middle), along.half[0] = static_cast<float>(half);
    other.middle[0] = f_.other_middle, other.half[0] = f_.other_half;
    const lanes::ChildBounds child{box, &slab, 0};
    const std::uint32_t bits =
        frames_ == FramePair::kOne
            ? lanes::not_separated(child, lane)
            : lanes::not_separated(lanes::MovedBounds{child, states_.translation}, lane);
    return (bits & 1) != 0;
  }

  const Frames& f_;
  FramePair frames_;
  Along along_;
  TwoStates states_;
};

}  // namespace

double largest_shortfall_of_translations() {
  double largest = -1.0;
  TriangleSource random(553);
  for (int i = 0; i < 3000; ++i) {
    const Frames f = random_frames(random);
    largest = std::max(
        {largest, shortfall(f.origins, FramePair::kTwo), shortfall(f.origins, FramePair::kMoving)});
  }
  // Differences that doubles round to floats: only doubles rounded outward hold them.
  for (const double away : {0x1p-54, -0x1p-54, 0x1p-60, -0x1p-60})
    for (const Vec3& from : {Vec3(1, -1, 1.5), Vec3(-1, 2, 0.75)}) {
      const Vec3 to = Vec3::Constant(away);
      largest = std::max({largest, shortfall({from, to, from, to}, FramePair::kTwo),
                          shortfall({-from, to, from, -to}, FramePair::kMoving)});
    }
  return largest;
}

double largest_error_of_slab_tests(FramePair frames, Along along) {
  TriangleSource random(554);
  const auto make = [&] { return random_frames(random); };
  const auto change = [&](Frames& f) { change_frames(random, f); };
  return climb(4, 1000, make, change,
               [&](const Frames& f) { return SlabTest(f, frames, along).error_over_slack(); });
}

}  // namespace contactcheck::test
