// Checks that frames have no contact, or only allowed contact, for meshes without declared
// contacts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/detect/detector.h"
#include "core/detect/registry.h"
#include "reference/judge/judge.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_geometry.h"
#include "reference/scene/frame_positions.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// Finds the pairs of triangles; the oracle confirms them.
inline constexpr const char* kFrameDetector = "full-refit";

struct AllowedContact {
  bool contact = false, self = false;
  std::optional<double> depth;  ///< metres, of contacts between bodies
};

/// At most kListedPairs (judge.h) of two bodies, or of one with itself.
using TrianglePairs = std::vector<std::array<std::uint32_t, 2>>;

/// What is not allowed in one frame.
struct BadFrame {
  struct Pair {
    BodyPair bodies;
    std::size_t triangles = 0;
    TrianglePairs listed;  ///< the first ones; empty: one body is inside the other
    oracle::SurfaceDepth depth;
  };
  struct Self {
    std::uint32_t body = 0;
    std::map<Level, std::size_t> pairs;
    TrianglePairs listed;  ///< the first ones of the first level that has some, then of the others
  };
  std::size_t frame = 0;
  std::vector<Pair> pairs;
  std::vector<Self> selfs;
};

/// What is in contact in one frame, allowed or not; canonical. Empty where it is not looked for.
struct FrameContacts {
  std::vector<BodyPair> touching, inside;  ///< surfaces that meet; else one body inside the other
  std::vector<std::uint32_t> self;
};

/// By body: the first frame in which it is open, and the open edge. Nothing counts as inside it.
using OpenBodies = std::map<std::uint32_t, std::string>;

/// Finds contacts with full-refit and containment with the oracle; the oracle confirms all of it.
class FrameChecker {
 public:
  /// `scene` must outlive it.
  FrameChecker(const scene::Scene& scene, const AllowedContact& allowed,
               const DetectorCatalog& catalog);

  /// Returns what is not allowed in this frame, or nothing.
  /// @throws InputError if welded vertices come apart or a frame cannot be judged;
  /// std::runtime_error if detector and oracle disagree, which is an error of contactcheck
  std::optional<BadFrame> check(std::size_t frame);

  /// The contacts of the last frame checked.
  const FrameContacts& contacts() const { return contacts_; }
  const OpenBodies& open() const { return open_; }
  /// Goes on as one that has checked the frames before: those in which these bodies were open.
  void resume(const FrameContacts& contacts, OpenBodies open) {
    contacts_ = contacts;
    open_ = std::move(open);
  }

 private:
  oracle::Truth judged(std::size_t f, const Frame& frame, const oracle::WantedTruth& wanted);
  std::optional<BadFrame> confirmed(std::size_t f, const Frame& frame, const ContactSet& found);
  void add_pairs(const Frame& frame, const oracle::Truth& truth, BadFrame& out);

  const scene::Scene& scene_;
  AllowedContact allowed_;
  scene::FramePositions positions_;
  std::unique_ptr<Detector> detector_;
  oracle::Oracle oracle_;
  oracle::SurfaceGeometry geometry_;
  FrameContacts contacts_;
  OpenBodies open_;
};

}  // namespace contactcheck::judge
