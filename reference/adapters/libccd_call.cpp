// Seen in libccd 2.1 (Debian 12), November 2026:
// - GJK gives up, as "no contact", when the square of its next direction is below 2.2e-16. A
//   direction may be a triple product of lengths: triangles of 3 mm lose 6 % of their pairs,
//   triangles of 1 mm 99 %. Times 1024 both lose none. So every pair is scaled to its own size.
// - MPR's refinement goes round for ever on some pairs: one of 100,000 with corners of small whole
//   numbers (one is in the tests; prior work, C2) and, at scale 1024, a tenth of points on a
//   triangle.
// - MPR never reports coplanar triangles; neither reports two equal points.
// - EPA holds its tolerance against squares of lengths: with its own of 1e-4, depths below a
//   hundredth of a unit are those of its first polytope. With 1e-12 those of boxes are right.
// - EPA replaces only the face nearest to the origin, so its polytope gets dents: depths of round
//   hulls are too small, by a third.
// - MPR's depths lie along the one direction that it went: never too small, and up to more than
//   twice the shortest where a flat piece crosses another.
// - EPA may take a face that the origin lies on for touching, with a depth of 0 and a direction of
//   NaN, deep inside (prior work, C1); it hangs on the last bits of the corners.
// - No crash in 3 million degenerate pairs, overflowing ones among them.
#include "reference/adapters/libccd_call.h"

#include <ccd/ccd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/lazy/lazy_state.h"

namespace contactcheck::adapters {
namespace {

/// A pair that is scaled to its size is fed with its larger piece from 2^(this - 1) to 2^this units
/// wide. Below, both lose or invent what is smaller than their tolerances. Above, both lose more
/// that touches: flat pieces (GJK), and corners of few digits (MPR).
int fed_exponent(CcdAlgorithm algorithm) { return algorithm == CcdAlgorithm::kGjk ? -1 : 0; }

/// What EPA may need before its first round, rounded up.
constexpr std::uint64_t kPolytopeStart = 64;
/// Points of MPR's first portal.
constexpr std::uint64_t kPortalStart = 3;

/// One call of libccd: how often it has asked and may ask.
struct Budget {
  std::uint64_t asked = 0;
  std::uint64_t limit = 0;
  bool exceeded() const { return asked > limit; }
};

struct Operand {
  CcdPiece points;
  double scale;
  Budget* budget;
};

/// The first of the farthest points; the first point where the direction is NaN. The scale has no
/// part in it.
const Vec3& farthest(CcdPiece points, const ccd_vec3_t& dir) {
  const Vec3* best = points.data();
  const auto along = [&](const Vec3& p) {
    return p.x() * dir.v[0] + p.y() * dir.v[1] + p.z() * dir.v[2];
  };
  double reach = along(*best);
  for (const Vec3& p : points) {
    const double d = along(p);
    if (!(d > reach)) continue;
    reach = d;
    best = &p;
  }
  return *best;
}

void answer(const Operand& operand, const ccd_vec3_t& dir, ccd_vec3_t* out) {
  if (operand.budget->exceeded()) {
    // For both pieces together: -2 dir, which is behind the origin seen along dir.
    ccdVec3Set(out, -dir.v[0], -dir.v[1], -dir.v[2]);
    return;
  }
  const Vec3 p = operand.scale * farthest(operand.points, dir);
  ccdVec3Set(out, p.x(), p.y(), p.z());
}

extern "C" {

// libccd asks the first piece, then the second: the first one counts for both.
static void support_of_first(const void* object, const ccd_vec3_t* dir, ccd_vec3_t* out) {
  const Operand& operand = *static_cast<const Operand*>(object);
  ++operand.budget->asked;
  answer(operand, *dir, out);
}

static void support_of_second(const void* object, const ccd_vec3_t* dir, ccd_vec3_t* out) {
  answer(*static_cast<const Operand*>(object), *dir, out);
}

static void mean_of_points(const void* object, ccd_vec3_t* out) {
  const Operand& operand = *static_cast<const Operand*>(object);
  Vec3 mean = Vec3::Zero();
  const double share = operand.scale / static_cast<double>(operand.points.size());
  for (const Vec3& p : operand.points) mean += share * p;
  ccdVec3Set(out, mean.x(), mean.y(), mean.z());
}

}  // extern "C"

ccd_t ccd_for(const CcdSettings& settings) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support_of_first;
  ccd.support2 = support_of_second;
  ccd.center1 = ccd.center2 = mean_of_points;
  ccd.max_iterations = settings.iterations;
  ccd.epa_tolerance = settings.epa_tolerance;
  ccd.mpr_tolerance = settings.mpr_tolerance;
  return ccd;
}

/// GJK's limit is libccd's own: a GJK that gives up says "no contact", having asked this often. So
/// may one that was sure in its last round; it is counted too.
std::uint64_t gjk_limit(const CcdSettings& settings) { return 1 + settings.iterations; }

std::uint64_t mpr_limit(const CcdSettings& settings) { return kPortalStart + settings.iterations; }

double extent(CcdPiece piece) {
  Aabb box;
  for (const Vec3& p : piece) box.extend(p);
  return box.extent().maxCoeff();
}

double scale_for(const CcdSettings& settings, CcdPiece a, CcdPiece b) {
  if (settings.scale > 0.0) return settings.scale;
  // Coordinates of both signs next to the largest double are an infinity apart.
  const double larger =
      std::min(std::max(extent(a), extent(b)), std::numeric_limits<double>::max());
  return std::ldexp(scale_to_one(larger), fed_exponent(settings.algorithm));
}

using PenetrationCall = int (*)(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*,
                                ccd_vec3_t*);

struct RawPenetration {
  int code = -1;  ///< 0: contact
  CcdTranslation translation;
};

RawPenetration call(PenetrationCall function, const CcdSettings& settings, CcdPiece a, CcdPiece b,
                    Budget& budget) {
  const ccd_t ccd = ccd_for(settings);
  const double scale = scale_for(settings, a, b);
  const Operand first{a, scale, &budget}, second{b, scale, &budget};
  // EPA writes nothing when it says that the pieces touch and has no element to measure.
  double depth = std::nan("");
  ccd_vec3_t dir, position;
  ccdVec3Set(&dir, 0, 0, 0);
  ccdVec3Set(&position, 0, 0, 0);
  RawPenetration out;
  out.code = function(&first, &second, &ccd, &depth, &dir, &position);
  if (out.code == -2) throw std::runtime_error("libccd ran out of memory");
  out.translation = {depth / scale, Vec3(dir.v[0], dir.v[1], dir.v[2])};
  return out;
}

bool usable(const CcdTranslation& translation) {
  // Written so that NaN fails.
  return translation.depth >= 0.0 && std::isfinite(translation.depth) &&
         std::abs(translation.normal.norm() - 1.0) < 1e-9;
}

}  // namespace

bool CcdCaller::intersect(CcdPiece a, CcdPiece b) {
  const bool gjk = settings_.algorithm == CcdAlgorithm::kGjk;
  const ccd_t ccd = ccd_for(settings_);
  Budget budget{0, gjk ? gjk_limit(settings_) : mpr_limit(settings_)};
  const double scale = scale_for(settings_, a, b);
  const Operand first{a, scale, &budget}, second{b, scale, &budget};
  const bool hit =
      (gjk ? ccdGJKIntersect(&first, &second, &ccd) : ccdMPRIntersect(&first, &second, &ccd)) != 0;
  support_calls_ += budget.asked;
  const bool limited = gjk ? !hit && budget.asked >= budget.limit : budget.exceeded();
  verdict_limits_ += limited ? 1 : 0;
  return hit && !limited;
}

CcdPenetration CcdCaller::penetrate(CcdPiece a, CcdPiece b) {
  return settings_.algorithm == CcdAlgorithm::kGjk ? penetrate_gjk(a, b) : penetrate_mpr(a, b);
}

CcdPenetration CcdCaller::penetrate_gjk(CcdPiece a, CcdPiece b) {
  Budget budget{0, gjk_limit(settings_) + kPolytopeStart + settings_.iterations};
  const RawPenetration raw = call(&ccdGJKPenetration, settings_, a, b, budget);
  support_calls_ += budget.asked;
  if (raw.code != 0) {
    verdict_limits_ += budget.asked >= gjk_limit(settings_) ? 1 : 0;
    return {};
  }
  if (!budget.exceeded()) return contact_with(raw.translation);
  ++depth_limits_;  // GJK had ended: only EPA gets that far
  return {true, std::nullopt};
}

CcdPenetration CcdCaller::penetrate_mpr(CcdPiece a, CcdPiece b) {
  Budget budget{0, mpr_limit(settings_)};
  const RawPenetration raw = call(&ccdMPRPenetration, settings_, a, b, budget);
  support_calls_ += budget.asked;
  if (!budget.exceeded()) return raw.code == 0 ? contact_with(raw.translation) : CcdPenetration{};
  // Whether it was the verdict or the depth that took so long, only the verdict alone tells.
  if (!intersect(a, b)) return {};
  ++depth_limits_;
  return {true, std::nullopt};
}

CcdPenetration CcdCaller::contact_with(const CcdTranslation& translation) {
  if (usable(translation)) return {true, translation};
  ++without_direction_;
  return {true, std::nullopt};
}

std::vector<std::string> CcdCaller::notes() const {
  std::vector<std::string> out;
  if (verdict_limits_ > 0)
    out.push_back("libccd reached its iteration limit on some pairs, which count as no contact");
  if (depth_limits_ > 0)
    out.push_back(
        "libccd reached its iteration limit on the depth of some pairs, which are contacts "
        "without a depth");
  if (without_direction_ > 0)
    out.push_back(
        "libccd gave no finite depth or no direction for some pairs, which are contacts without a "
        "depth");
  return out;
}

}  // namespace contactcheck::adapters
