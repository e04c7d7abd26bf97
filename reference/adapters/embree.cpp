// Embree's scene-against-scene collision as a detector: the fast peer.
//
//   embree  one hierarchy of boxes per body, refitted; rtcCollide names the pairs of triangles
//           whose boxes overlap; core's exact test decides
//
// Embree only culls, in single precision, with boxes rounded outward: the answer is exact for all
// finite doubles, closed (touching is contact) and about surfaces. rtcCollide cannot stop early, so
// the question `body` costs the whole traversal too and saves tests of triangles only. Single
// threaded, and it leaves the process's limit on oneTBB's threads alone.
//
// Seen in Embree 3.13.5 (Debian 12), November 2026:
// - A box with a coordinate beyond 1.844e18 counts as invalid and its primitive is left out of the
//   hierarchy, without an error. Hence the normalisation below.
// - A commit of two to four primitives whose boxes together have no extent aborts the process (an
//   assertion in heuristic_openmerge_array.h; Debian's library is built with them). With
//   flush-to-zero an extent that is denormal is none. Hence the padding below.
// - Flush-to-zero and denormals-are-zero are on in the bounds callback and in the collide callback.
//   They are off again when the call returns. So nothing is computed in a callback but sums,
//   minima and maxima of normal floats, and nothing is judged there.
// - "threads=1" as device configuration lowers oneTBB's limit for the whole process to one thread
//   until the last device is gone, and with it every other detector that uses oneTBB. Calls from
//   within an arena of one slot stay on the calling thread and leave the limit alone.
// - Quality REFIT refits a scene only if it is dynamic; otherwise it is built anew.
// - rtcCollide aborts on RTC_GEOMETRY_TYPE_TRIANGLE; user geometries work.
// - rtcCollide has no early-out: the callback returns nothing.
#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/detect/triangle_pair_detector.h"
#include "core/types/check.h"
#include "reference/adapters/adapters.h"

namespace contactcheck::adapters {
namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

/// @throws std::runtime_error with the device's error since the last time; a null device: the error
/// of the calling thread's last rtcNewDevice
void require_ok(RTCDevice device, const char* call) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw std::runtime_error(std::string("Embree's ") + call + " failed with error " +
                           std::to_string(static_cast<int>(error)));
}

// Boxes are padded by this part of the scene's largest coordinate (which is normalised to [0.5, 1)
// first): about one spacing of floats there. It covers the rounding of a coordinate to a float and
// of the bound itself, each at most 2^-25; no box is flat and no bound but 0 is denormal. Without
// it Embree aborts.
constexpr float kPadding = 0x1p-23f;

/// Four floats, of which three are a vertex: minima and maxima are one instruction each.
using FloatVertex = Eigen::Array4f;

FloatVertex float_vertex(const Vec3& p, double scale) {
  return {static_cast<float>(scale * p.x()), static_cast<float>(scale * p.y()),
          static_cast<float>(scale * p.z()), 0.0f};
}

/// The power of two that brings `largest` into [0.5, 1), as near as a double can: what is below
/// 2^-1023 stays below the padding, which costs culling and loses nothing.
double normalising_scale(double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, std::min(-exponent, 1023));
}

double largest_coordinate(std::span<const Vec3> vertices) {
  if (vertices.empty()) return 0.0;
  const Eigen::Map<const Eigen::ArrayXd> all(vertices[0].data(),
                                             static_cast<Eigen::Index>(3 * vertices.size()));
  const double largest = all.abs().maxCoeff<Eigen::PropagateNaN>();
  if (!std::isfinite(largest)) throw RefusedInput("embree refuses a vertex that is not finite");
  return largest;
}

/// One body: a scene of one user geometry, whose primitives are the triangles.
class EmbreeBody {
 public:
  EmbreeBody(RTCDevice device, const TriangleMesh& mesh)
      : device_(device), triangles_(mesh.triangles), vertices_(mesh.vertices.size()) {
    scene_.reset(rtcNewScene(device_));
    geometry_.reset(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER));
    require_ok(device_, "rtcNewScene or rtcNewGeometry");
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryBuildQuality(geometry_.get(), RTC_BUILD_QUALITY_REFIT);
    rtcSetGeometryUserPrimitiveCount(geometry_.get(), static_cast<unsigned>(triangles_.size()));
    rtcSetGeometryUserData(geometry_.get(), this);
    rtcSetGeometryBoundsFunction(geometry_.get(), &EmbreeBody::triangle_bounds, nullptr);
    rtcAttachGeometry(scene_.get(), geometry_.get());
    require_ok(device_, "set-up of a geometry");
  }
  EmbreeBody(const EmbreeBody&) = delete;
  EmbreeBody& operator=(const EmbreeBody&) = delete;

  /// Exact box in doubles, and the floats for commit().
  void set_vertices(std::span<const Vec3> vertices, double scale) {
    CONTACTCHECK_INVARIANT(vertices.size() == vertices_.size(), "one position per vertex");
    box_ = Aabb();
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      box_.extend(vertices[v]);
      vertices_[v] = float_vertex(vertices[v], scale);
    }
  }

  void commit() {
    rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene_.get());
    require_ok(device_, "rtcCommitScene");
  }

  RTCScene scene() const { return scene_.get(); }
  const Aabb& box() const { return box_; }

 private:
  // Flush-to-zero is on in here: sums, minima and maxima of normal floats, nothing else.
  static void triangle_bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& body = *static_cast<const EmbreeBody*>(arguments->geometryUserPtr);
    const Triangle& t = body.triangles_[arguments->primID];
    const FloatVertex &a = body.vertices_[t[0]], &b = body.vertices_[t[1]],
                      &c = body.vertices_[t[2]];
    const FloatVertex lo = a.min(b).min(c) - kPadding, hi = a.max(b).max(c) + kPadding;
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = lo.x(), out.lower_y = lo.y(), out.lower_z = lo.z();
    out.upper_x = hi.x(), out.upper_y = hi.y(), out.upper_z = hi.z();
  }

  RTCDevice device_;
  Owned<RTCScene> scene_;
  Owned<RTCGeometry> geometry_;
  std::span<const Triangle> triangles_;  // of the body's shape, which outlives the detector
  std::vector<FloatVertex> vertices_;
  Aabb box_;
};

// Not the user's settings (.embree3 files beside the program and at home).
constexpr const char* kDeviceConfiguration = "ignore_config_files=1,set_affinity=0";

/// The bodies' scenes on a device of their own; the broad phase of a TrianglePairDetector.
class EmbreeScenes {
 public:
  static constexpr const char* kName = "boxes";
  using Real = double;
  static constexpr const char* kVisitedUnit = "";  // Embree does not count
  static constexpr bool kBoxesOverlap = false;     // boxes of floats, wider than those of doubles

  EmbreeScenes()
      : arena_(std::make_unique<tbb::task_arena>(1)), device_(rtcNewDevice(kDeviceConfiguration)) {
    if (!device_) require_ok(nullptr, "rtcNewDevice");
  }

  void prepare(const std::vector<Body>& bodies) {
    bodies_.clear();
    std::vector<std::span<const Vec3>> rest;
    for (const Body& body : bodies) {
      bodies_.push_back(std::make_unique<EmbreeBody>(device_.get(), body.shape->mesh));
      rest.emplace_back(body.shape->mesh.vertices);
    }
    // The first commit builds; the hierarchies are those of the rest shapes ever after.
    commit(rest);
  }

  void update(const std::vector<std::span<const Vec3>>& vertices) { commit(vertices); }

  /// Calls `visit(ElementPair)`; true: the rest of these two bodies is skipped.
  template <typename Visit>
  void visit_candidates(Visit&& visit) {
    for (std::uint32_t a = 0; a < bodies_.size(); ++a) {
      for (std::uint32_t b = a + 1; b < bodies_.size(); ++b) {
        if (!bodies_[a]->box().overlaps(bodies_[b]->box())) continue;
        collide(a, b);
        for (const auto& [i, j] : candidates_)
          if (visit(ElementPair{a, b, i, j})) break;
      }
    }
  }
  std::uint64_t visited() const { return 0; }

 private:
  /// One scale for all bodies: their boxes are compared.
  void commit(const std::vector<std::span<const Vec3>>& vertices) {
    CONTACTCHECK_INVARIANT(vertices.size() == bodies_.size(), "one state per body");
    double largest = 0.0;
    for (const std::span<const Vec3>& body : vertices)
      largest = std::max(largest, largest_coordinate(body));
    const double scale = normalising_scale(largest);
    for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b]->set_vertices(vertices[b], scale);
    arena_->execute([&] {
      for (const auto& body : bodies_) body->commit();
    });
  }

  void collide(std::uint32_t a, std::uint32_t b) {
    candidates_.clear();
    arena_->execute([&] {
      rtcCollide(bodies_[a]->scene(), bodies_[b]->scene(), &EmbreeScenes::collect, &candidates_);
    });
    require_ok(device_.get(), "rtcCollide");  // also what the callback threw
  }

  using Candidates = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  // Flush-to-zero is on in here: ids are taken down, nothing is judged.
  static void collect(void* candidates, RTCCollision* collisions, unsigned count) {
    auto& out = *static_cast<Candidates*>(candidates);
    for (unsigned i = 0; i < count; ++i)
      out.emplace_back(collisions[i].primID0, collisions[i].primID1);
  }

  std::unique_ptr<tbb::task_arena> arena_;           // one slot: the calling thread's
  Owned<RTCDevice> device_;                          // outlives the scenes
  std::vector<std::unique_ptr<EmbreeBody>> bodies_;  // Embree holds their addresses
  Candidates candidates_;                            // kept for its capacity
};

}  // namespace

Adapter embree_adapter() {
  DetectorInfo info;
  info.id = "embree";
  info.summary = "Embree's refitted box hierarchies and rtcCollide; exact triangle test";
  info.make = [](const Options&) {
    return std::make_unique<TrianglePairDetector<EmbreeScenes>>(EmbreeScenes(), ExactTriangles{},
                                                                exact_triangle_semantics());
  };
  return {"embree", RTC_VERSION_STRING, {std::move(info)}};
}

}  // namespace contactcheck::adapters
