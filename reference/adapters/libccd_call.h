// Calls of libccd for two convex pieces given by points, with iteration limits that libccd lacks.
//
// How a loop is ended. EPA and MPR's portal loops run until no point lies further out, without
// counting rounds. All of them call a support function for that point: the ones here count, and
// above the limit return a point on the wrong side of the origin. Each loop then finds nothing
// further out, leaves by its own exit and frees its memory. Its result is not used.
//
// Limits, in support points of the difference (one of each piece), by option `iterations` = n:
//   GJK  1 + n for the verdict (libccd's own limit), n + 64 more for the depth (EPA: 46 at most to
//        start its polytope from a segment, then one per round)
//   MPR  3 + n for the whole call, depth or not (three points make the first portal)
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck::adapters {

enum class CcdAlgorithm { kGjk, kMpr };

struct CcdSettings {
  CcdAlgorithm algorithm = CcdAlgorithm::kGjk;
  std::uint32_t iterations = 100;
  /// libccd is fed points times this, so its units are metres / scale. 0: a power of two per pair,
  /// at which the larger piece is 1/4 to 1/2 (GJK) or 1/2 to 1 (MPR) units wide.
  double scale = 0.0;
  double epa_tolerance = 1e-12;  ///< square units: EPA compares squared distances with it
  double mpr_tolerance = 1e-9;   ///< units
};

/// The hull of these points; not empty.
using CcdPiece = std::span<const Vec3>;

/// The minimum translation.
struct CcdTranslation {
  double depth = 0.0;          ///< metres
  Vec3 normal = Vec3::Zero();  ///< unit; moving the second piece by depth * normal separates them
};

struct CcdPenetration {
  bool contact = false;
  std::optional<CcdTranslation> translation;  ///< none if libccd gave none that is finite and unit
};

class CcdCaller {
 public:
  explicit CcdCaller(const CcdSettings& settings) : settings_(settings) {}

  /// True if the pieces share a point; false also if the limit was reached.
  bool intersect(CcdPiece a, CcdPiece b);
  /// The same verdict, and the translation that separates them.
  /// @throws std::runtime_error when libccd is out of memory
  CcdPenetration penetrate(CcdPiece a, CcdPiece b);

  /// Resets the counts of notes().
  void begin_frame() { verdict_limits_ = depth_limits_ = without_direction_ = 0; }
  /// Notes on all calls since begin_frame().
  std::vector<std::string> notes() const;
  /// Counted since construction.
  std::uint64_t support_calls() const { return support_calls_; }

  std::uint64_t verdict_limits() const { return verdict_limits_; }
  std::uint64_t depth_limits() const { return depth_limits_; }
  std::uint64_t without_direction() const { return without_direction_; }

 private:
  CcdPenetration penetrate_gjk(CcdPiece a, CcdPiece b);
  CcdPenetration penetrate_mpr(CcdPiece a, CcdPiece b);
  CcdPenetration contact_with(const CcdTranslation& translation);

  CcdSettings settings_;
  std::uint64_t support_calls_ = 0;
  std::uint64_t verdict_limits_ = 0, depth_limits_ = 0, without_direction_ = 0;
};

}  // namespace contactcheck::adapters
