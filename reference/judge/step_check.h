// Checks what meets between frames, on straight paths, for meshes without declared contacts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/detect/detector.h"
#include "core/detect/registry.h"
#include "core/types/impact.h"
#include "core/types/mesh_edges.h"
#include "core/types/vec3.h"
#include "reference/judge/frame_check.h"
#include "reference/scene/frame_positions.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// Finds the elements that meet within a step; the oracle confirms what is named.
inline constexpr const char* kStepDetector = "swept-aabb";

/// What a frame says of two bodies, or of a body with itself, which is never kInside.
enum class EndState : std::uint8_t { kApart, kContact, kInside };

/// A vertex and a triangle, or two edges, that meet within a step.
struct ElementImpact {
  ImpactKind kind = ImpactKind::vertex_triangle;
  std::array<std::uint32_t, 2> bodies{};  ///< of the vertex and the triangle, or of the edges
  std::uint32_t vertex = 0, triangle = 0;
  std::array<Edge, 2> edges{};          ///< vertices of the bodies' meshes
  double earliest = 0.0, latest = 0.0;  ///< certified: the first time is in here (Impact)
  /// A common point at the middle of that interval, and how far the interval and rounding may move
  /// it; where edges are nearly parallel, a point in which they are that near.
  Vec3 place = Vec3::Zero();
  double place_error = 0.0;  ///< metres
};

/// Two bodies, or a body with itself, that meet within a step.
struct StepContact {
  BodyPair bodies;  ///< equal: with itself
  EndState start = EndState::kApart, end = EndState::kApart;
  /// The first to meet of the elements that are apart at the start; none if no such meet.
  std::optional<ElementImpact> first;
  /// Pairs of elements that are apart at the start and meet, and those of them that are apart at
  /// the end.
  std::size_t later = 0, passing = 0;

  bool own() const { return bodies.a == bodies.b; }
  bool starts_in_contact() const { return start == EndState::kContact; }
  bool apart_at_both() const { return start == EndState::kApart && end == EndState::kApart; }
};

/// The larger it is, the less straight paths say of the motion that was meant.
struct LargestMotion {
  double edges = 0.0;  ///< of a vertex, in mean edge lengths of its body
  std::size_t step = 0;
  std::uint32_t body = 0;
};
struct LargestTurn {
  double degrees = 0.0;  ///< of a triangle's normal from frame to frame
  std::size_t step = 0;
  std::uint32_t body = 0, triangle = 0;
};

/// The largest of all steps checked, none if no vertex moved or no normal turned; and how many
/// pairs of a vertex and a triangle, or of two edges, were tested exactly: those whose moving boxes
/// meet within a step.
struct StepTotals {
  std::optional<LargestMotion> motion;
  std::optional<LargestTurn> turn;
  std::uint64_t element_tests = 0;
};

/// Finds contact within steps with swept-aabb, exactly. The oracle confirms what is named: of each
/// pair of bodies the first elements and their time, and contact at either end.
class StepChecker {
 public:
  /// `scene` must outlive it. `allowed`: contact and self are not looked for where they are.
  StepChecker(const scene::Scene& scene, const AllowedContact& allowed,
              const DetectorCatalog& catalog);

  /// What meets from frame `step` to the next, ascending by bodies, each body with itself last.
  /// @throws std::runtime_error if detector, oracle and frames disagree, which is an error of
  /// contactcheck
  std::vector<StepContact> check(std::size_t step, const FrameContacts& at_start,
                                 const FrameContacts& at_end);

  const StepTotals& totals() const { return totals_; }
  /// Goes on as one that has checked the steps before.
  void resume(const StepTotals& totals) { totals_ = totals; }

 private:
  void measure(const Step& step);

  const scene::Scene& scene_;
  AllowedContact allowed_;
  scene::FramePositions positions_;
  std::unique_ptr<Detector> detector_;
  std::vector<MeshEdges> edges_;    // per body
  std::vector<double> mean_edges_;  // per body, metres
  StepTotals totals_;
};

}  // namespace contactcheck::judge
