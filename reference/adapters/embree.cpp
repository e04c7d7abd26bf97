// Embree's scene-against-scene collision as detectors: the fast peers.
//
//   embree        one hierarchy of boxes per body, refitted or built anew (option `build`);
//                 rtcCollide names pairs of triangles in leaves whose boxes overlap; core's exact
//                 test decides, eight pairs at a time
//   embree-swept  the same of steps: boxes of triangles over both ends, core's exact tests of
//                 vertices, triangles and edges
//
// Embree only culls, in single precision, with boxes rounded outward: the answer is exact for all
// finite doubles, closed (touching is contact) and about surfaces. Single threaded, and it leaves
// the process's limit on oneTBB's threads alone.
//
// rtcCollide's callback returns nothing, so the only way to end a traversal is an exception, which
// rtcCollide catches and turns into its error "unknown". The question `body` tests within the
// callback and ends so at the first contact.
//
// Seen in Embree 3.13.5 (Debian 12), November 2026:
// - A box with a coordinate beyond 1.844e18 counts as invalid and its primitive is left out of the
//   hierarchy, without an error. Hence the normalisation below.
// - A commit of two to four primitives whose boxes together have no extent aborts the process (an
//   assertion in heuristic_openmerge_array.h; Debian's library is built with them). With
//   flush-to-zero an extent that is denormal is none. Hence the padding below.
// - Flush-to-zero and denormals-are-zero are on in the bounds callback and in the collide callback.
//   They are off again when the call returns. So nothing is computed in the bounds callback but
//   sums, minima and maxima of normal floats, and triangles are tested in the caller's environment.
// - "threads=1" as device configuration lowers oneTBB's limit for the whole process to one thread
//   until the last device is gone, and with it every other detector that uses oneTBB. Calls from
//   within an arena of one slot stay on the calling thread and leave the limit alone.
// - Quality REFIT refits a scene only if it is dynamic; otherwise it is built anew.
// - rtcCollide aborts on RTC_GEOMETRY_TYPE_TRIANGLE; user geometries work.
#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "core/broad/adjacent_pairs.h"
#include "core/broad/body_pairs.h"
#include "core/detect/exact_pairs.h"
#include "core/detect/step_contacts.h"
#include "core/detect/swept_detector.h"
#include "core/detect/triangle_pair_detector.h"
#include "core/detect/triangle_record.h"
#include "core/types/check.h"
#include "reference/adapters/adapters.h"
#include "reference/adapters/body_pair_detector.h"

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

/// One body: a scene of one user geometry, whose primitives are the triangles.
class EmbreeBody {
 public:
  /// `quality`: of what every commit after the first does.
  EmbreeBody(RTCDevice device, const TriangleMesh& mesh, RTCBuildQuality quality)
      : device_(device), triangles_(mesh.triangles), vertices_(mesh.vertices.size()) {
    scene_.reset(rtcNewScene(device_));
    geometry_.reset(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER));
    require_ok(device_, "rtcNewScene or rtcNewGeometry");
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryBuildQuality(geometry_.get(), quality);
    rtcSetGeometryUserPrimitiveCount(geometry_.get(), static_cast<unsigned>(triangles_.size()));
    rtcSetGeometryUserData(geometry_.get(), this);
    rtcSetGeometryBoundsFunction(geometry_.get(), &EmbreeBody::triangle_bounds, nullptr);
    rtcAttachGeometry(scene_.get(), geometry_.get());
    require_ok(device_, "set-up of a geometry");
  }
  EmbreeBody(const EmbreeBody&) = delete;
  EmbreeBody& operator=(const EmbreeBody&) = delete;

  /// The floats for commit().
  void set_vertices(std::span<const Vec3> vertices, double scale) {
    CONTACTCHECK_INVARIANT(vertices.size() == vertices_.size(), "one position per vertex");
    for (std::size_t v = 0; v < vertices.size(); ++v)
      vertices_[v] = float_vertex(vertices[v], scale);
  }

  /// The same of a step: boxes are then around both ends.
  void set_step(std::span<const Vec3> start, std::span<const Vec3> end, double scale) {
    set_vertices(start, scale);
    ends_.resize(end.size());
    for (std::size_t v = 0; v < end.size(); ++v) ends_[v] = float_vertex(end[v], scale);
  }

  void commit() {
    rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene_.get());
    require_ok(device_, "rtcCommitScene");
  }

  RTCScene scene() const { return scene_.get(); }

 private:
  // Flush-to-zero is on in here: sums, minima and maxima of normal floats, nothing else.
  static void triangle_bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& body = *static_cast<const EmbreeBody*>(arguments->geometryUserPtr);
    const Triangle& t = body.triangles_[arguments->primID];
    const FloatVertex &a = body.vertices_[t[0]], &b = body.vertices_[t[1]],
                      &c = body.vertices_[t[2]];
    FloatVertex lo = a.min(b).min(c), hi = a.max(b).max(c);
    if (!body.ends_.empty()) {
      const FloatVertex &p = body.ends_[t[0]], &q = body.ends_[t[1]], &r = body.ends_[t[2]];
      lo = lo.min(p).min(q).min(r);
      hi = hi.max(p).max(q).max(r);
    }
    lo -= kPadding;
    hi += kPadding;
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = lo.x(), out.lower_y = lo.y(), out.lower_z = lo.z();
    out.upper_x = hi.x(), out.upper_y = hi.y(), out.upper_z = hi.z();
  }

  RTCDevice device_;
  Owned<RTCScene> scene_;
  Owned<RTCGeometry> geometry_;
  std::span<const Triangle> triangles_;  // of the body's shape, which outlives the detector
  std::vector<FloatVertex> vertices_;
  std::vector<FloatVertex> ends_;  // of a step; empty of frames
};

// Not the user's settings (.embree3 files beside the program and at home).
constexpr const char* kDeviceConfiguration = "ignore_config_files=1,set_affinity=0";

class EmbreeDetector final : public BodyPairDetector {
 public:
  EmbreeDetector(RTCBuildQuality quality, Prefilter prefilter)
      : BodyPairDetector(prefilter),
        quality_(quality),
        arena_(std::make_unique<tbb::task_arena>(1)),
        device_(rtcNewDevice(kDeviceConfiguration)) {
    if (!device_) require_ok(nullptr, "rtcNewDevice");
  }

  const Semantics& semantics() const override { return semantics_; }

  void prepare(const std::vector<Body>& bodies) override {
    set_bodies(bodies);
    bodies_.clear();
    neighbours_.assign(bodies.size(), std::nullopt);
    std::vector<CandidateBody> rest;
    for (std::uint32_t b = 0; b < bodies.size(); ++b) {
      const TriangleMesh& mesh = bodies[b].shape->mesh;
      bodies_.push_back(std::make_unique<EmbreeBody>(device_.get(), mesh, quality_));
      rest.push_back({b, mesh.vertices, bounding_box(mesh.vertices)});
      if (expects_self()) neighbours_[b] = adjacent_pairs(bodies[b].shape->linked());
    }
    // The first commit builds; the hierarchies are those of the rest shapes ever after.
    move(rest);
  }

  std::vector<Count> counts() override { return exact_.counts(); }

  StageTrace trace() override {
    std::vector<std::uint64_t> triangles;
    std::vector<ElementPair> candidates;
    ContactSet exact;
    for (std::uint32_t b = 0; b < body_count(); ++b)
      triangles.push_back(shape(b).mesh.triangles.size());
    for (const BodyPair& pair : candidate_pairs()) {
      find_candidates(pair);
      for (const auto& [i, j] : candidates_) candidates.push_back({pair.a, pair.b, i, j});
      collide(pair, Question::kTriangles, exact);
    }
    StageTrace out;
    out.stages.push_back(
        triangle_record("rtcCollide", brute_force_pairs(triangles), std::move(candidates)));
    out.stages.push_back(
        triangle_record("triangles", out.stages[0].out, std::move(exact.triangles)));
    return out;
  }

 private:
  struct Contact {};  // thrown through rtcCollide

  /// One scale for all that are moved: their boxes are compared.
  void move(std::span<const CandidateBody> bodies) override {
    exact_.clear_counts();
    double largest = 0.0;
    for (const CandidateBody& body : bodies)
      largest = std::max(largest, largest_coordinate(body.box));
    const double scale = normalising_scale(largest);
    for (const CandidateBody& body : bodies) bodies_[body.body]->set_vertices(body.vertices, scale);
    arena_->execute([&] {
      for (const CandidateBody& body : bodies) bodies_[body.body]->commit();
    });
  }

  void collide(BodyPair pair, Question question, ContactSet& out) override {
    exact_.begin(shape(pair.a), vertices(pair.a), shape(pair.b), vertices(pair.b));
    if (question == Question::kBody) {
      if (find_first(pair)) out.bodies.push_back(pair);
      return;
    }
    find_candidates(pair);
    const auto meets = [&](std::uint32_t i, std::uint32_t j) {
      out.triangles.push_back({pair.a, pair.b, i, j});
    };
    for (const auto& [i, j] : candidates_) exact_.add({i, j, {}}, meets);
    exact_.flush(meets);
  }

  // Neighbours come from the mesh; rtcCollide names the others, each pair in both orders.
  void collide_self(std::uint32_t body, ContactSet& out) override {
    const BodyShape& mesh = shape(body);
    const std::span<const Vec3> positions = vertices(body);
    linked_ = mesh.linked().data();
    candidates_.clear();
    call_collide({body, body}, &EmbreeDetector::collect_strangers);
    require_ok(device_.get(), "rtcCollide");
    exact_.begin(mesh, positions, mesh, positions);
    const auto meets = [&](std::uint32_t i, std::uint32_t j) { out.self.push_back({body, i, j}); };
    for (const auto& [i, j] : candidates_) exact_.add({i, j, {}}, meets);
    if (!neighbours_[body]) neighbours_[body] = adjacent_pairs(mesh.linked());
    for (const AdjacentPair& pair : *neighbours_[body]) exact_.add(pair, meets);
    exact_.flush(meets);
  }

  // Flush-to-zero is on in here, too: indices are compared.
  static void collect_strangers(void* detector, RTCCollision* collisions, unsigned count) {
    auto& self = *static_cast<EmbreeDetector*>(detector);
    for (unsigned i = 0; i < count; ++i) {
      const unsigned a = collisions[i].primID0, b = collisions[i].primID1;
      if (a < b && shared_corners(self.linked_[a], self.linked_[b]).count == 0)
        self.candidates_.emplace_back(a, b);
    }
  }

  void find_candidates(BodyPair pair) {
    candidates_.clear();
    call_collide(pair, &EmbreeDetector::collect);
    require_ok(device_.get(), "rtcCollide");  // also what the callback threw
  }

  bool find_first(BodyPair pair) {
    contact_ = false;
    std::fenv_t caller;
    std::fegetenv(&caller);
    environment_ = &caller;
    call_collide(pair, &EmbreeDetector::test);
    std::fesetenv(&caller);  // Embree does not put it back on its way out of an exception
    if (contact_) {
      rtcGetDeviceError(device_.get());  // of the exception
      return true;
    }
    require_ok(device_.get(), "rtcCollide");
    exact_.flush([this](std::uint32_t, std::uint32_t) { contact_ = true; });
    return contact_;
  }

  void call_collide(BodyPair pair, RTCCollideFunc callback) {
    arena_->execute(
        [&] { rtcCollide(bodies_[pair.a]->scene(), bodies_[pair.b]->scene(), callback, this); });
  }

  // Flush-to-zero is on in here: ids are taken down, nothing is judged.
  static void collect(void* detector, RTCCollision* collisions, unsigned count) {
    auto& out = static_cast<EmbreeDetector*>(detector)->candidates_;
    for (unsigned i = 0; i < count; ++i)
      out.emplace_back(collisions[i].primID0, collisions[i].primID1);
  }

  static void test(void* detector, RTCCollision* collisions, unsigned count) {
    auto& self = *static_cast<EmbreeDetector*>(detector);
    std::fenv_t embrees;
    std::fegetenv(&embrees);
    std::fesetenv(self.environment_);
    for (unsigned i = 0; i < count && !self.contact_; ++i)
      self.exact_.add({collisions[i].primID0, collisions[i].primID1, {}},
                      [&](std::uint32_t, std::uint32_t) { self.contact_ = true; });
    std::fesetenv(&embrees);
    if (self.contact_) throw Contact();
  }

  const Semantics semantics_ = exact_triangle_semantics(Precision::kDouble, true);
  const RTCBuildQuality quality_;
  std::unique_ptr<tbb::task_arena> arena_;           // one slot: the calling thread's
  Owned<RTCDevice> device_;                          // outlives the scenes
  std::vector<std::unique_ptr<EmbreeBody>> bodies_;  // Embree holds their addresses
  ExactPairs exact_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates_;   // kept for its capacity
  std::vector<std::optional<std::vector<AdjacentPair>>> neighbours_;  // of bodies asked for self
  const Triangle* linked_ = nullptr;                                  // of collide_self()
  bool contact_ = false;                                              // of find_first()
  const std::fenv_t* environment_ = nullptr;  // the caller's, of find_first()
};

/// Candidates are pairs of triangles whose boxes over the step overlap, by Embree; StepContacts
/// decides, as in swept-aabb. Bodies whose boxes over the step meet no other's are not refitted.
class EmbreeSwept final : public Detector {
 public:
  EmbreeSwept()
      : arena_(std::make_unique<tbb::task_arena>(1)), device_(rtcNewDevice(kDeviceConfiguration)) {
    if (!device_) require_ok(nullptr, "rtcNewDevice");
  }

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }

  void prepare(const std::vector<Body>& bodies) override {
    contacts_.prepare(bodies);
    bodies_.clear();
    shapes_.clear();
    for (const Body& body : bodies) {
      const TriangleMesh& mesh = body.shape->mesh;
      shapes_.push_back(body.shape.get());
      bodies_.push_back(std::make_unique<EmbreeBody>(device_.get(), mesh, RTC_BUILD_QUALITY_REFIT));
      bodies_.back()->set_step(mesh.vertices, mesh.vertices,
                               normalising_scale(largest_coordinate(bounding_box(mesh.vertices))));
      arena_->execute([&] { bodies_.back()->commit(); });
    }
  }

  void update(const Frame&) override {
    throw std::logic_error("embree-swept answers questions of steps alone");
  }

  void update_step(const Step& step) override {
    contacts_.begin(step);
    start_.clear();
    end_.clear();
    boxes_.clear();
    double largest = 0.0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      start_.push_back(step.start.bodies[b].vertices);
      end_.push_back(step.end.bodies[b].vertices);
      Aabb& box = boxes_.emplace_back();
      for (const auto vertices : {start_[b], end_[b]})
        for (const Vec3& vertex : vertices) box.extend(vertex);
      largest = std::max(largest, largest_coordinate(box));
    }
    scale_ = normalising_scale(largest);
    pairs_.clear();
    find_candidate_bodies(boxes_, pairs_);
    moved_.assign(bodies_.size(), false);
    for (const BodyPair& pair : pairs_)
      for (const std::uint32_t body : pair.ids()) move(body);
  }

  void query(Question question, ContactSet& out) override {
    CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
    if (question == Question::kSelfImpacts) {
      for (std::uint32_t body = 0; body < bodies_.size(); ++body) {
        refuse_many_adjacent_pairs(shapes_[body]->linked());
        move(body);
        find_candidates({body, body});
        // Each pair comes in both orders.
        for (const auto& [i, j] : candidates_)
          if (i < j) contacts_.add_own({body, i, j}, out);
      }
      return;
    }
    for (const BodyPair& pair : pairs_) {
      find_candidates(pair);
      for (const auto& [i, j] : candidates_) contacts_.add({pair.a, pair.b, i, j}, out);
    }
    contacts_.finish(out);
  }

  std::vector<Count> counts() override { return {{"element_tests", contacts_.tested()}}; }

 private:
  void move(std::uint32_t body) {
    if (moved_[body]) return;
    moved_[body] = true;
    bodies_[body]->set_step(start_[body], end_[body], scale_);
    arena_->execute([&] { bodies_[body]->commit(); });
  }

  void find_candidates(BodyPair pair) {
    candidates_.clear();
    arena_->execute([&] {
      rtcCollide(bodies_[pair.a]->scene(), bodies_[pair.b]->scene(), &EmbreeSwept::collect, this);
    });
    require_ok(device_.get(), "rtcCollide");
  }

  // Flush-to-zero is on in here: ids are taken down, nothing is judged.
  static void collect(void* detector, RTCCollision* collisions, unsigned count) {
    auto& out = static_cast<EmbreeSwept*>(detector)->candidates_;
    for (unsigned i = 0; i < count; ++i)
      out.emplace_back(collisions[i].primID0, collisions[i].primID1);
  }

  const Semantics semantics_ = exact_step_semantics(true);
  std::unique_ptr<tbb::task_arena> arena_;           // one slot: the calling thread's
  Owned<RTCDevice> device_;                          // outlives the scenes
  std::vector<std::unique_ptr<EmbreeBody>> bodies_;  // Embree holds their addresses
  std::vector<const BodyShape*> shapes_;
  StepContacts contacts_;
  std::vector<std::span<const Vec3>> start_, end_;  // vertices of the last update
  double scale_ = 1.0;
  std::vector<Aabb> boxes_;
  std::vector<BodyPair> pairs_;
  std::vector<bool> moved_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates_;  // kept for its capacity
};

DetectorInfo swept_info() {
  DetectorInfo info;
  info.id = "embree-swept";
  info.summary =
      "contact between frames: Embree's hierarchies of boxes over both ends of a step and "
      "rtcCollide; exact tests of vertices, triangles and edges";
  info.given = std::string(kSweepAndPrune) + "core's exact tests, as in ffd-lazy";
  info.make = [](const Options&) { return std::make_unique<EmbreeSwept>(); };
  return info;
}

}  // namespace

Adapter embree_adapter() {
  DetectorInfo info;
  info.id = "embree";
  info.summary = "Embree's refitted box hierarchies and rtcCollide; exact triangle test";
  info.given = std::string(kSweepAndPrune) +
               "exact tests eight at a time, by the kernels of ffd-lazy; body ends at the first "
               "contact of two bodies";
  info.options = {
      prefilter_option(),
      choice_option("build", "refit", {"refit", "low", "medium"},
                    "a frame's boxes: of the hierarchy of the rest shape, or of one that is built "
                    "anew by Morton codes (low) or by surface areas (medium)")};
  info.make = [](const Options& options) {
    const std::string& build = options.at("build");
    const RTCBuildQuality quality = build == "low"      ? RTC_BUILD_QUALITY_LOW
                                    : build == "medium" ? RTC_BUILD_QUALITY_MEDIUM
                                                        : RTC_BUILD_QUALITY_REFIT;
    return std::make_unique<EmbreeDetector>(quality, prefilter_of(options));
  };
  return {"embree", RTC_VERSION_STRING, {std::move(info), swept_info()}};
}

}  // namespace contactcheck::adapters
