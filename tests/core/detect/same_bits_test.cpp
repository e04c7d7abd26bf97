// The same bits everywhere: what was mapped and found on one machine, compiler and instruction set
// is what every other one maps and finds. The numbers below were printed by an x86-64 build of
// g++ 12; the preset "aarch64" runs this test on another architecture.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <string>

#include "core/detect/ffd_detector.h"
#include "core/types/hash.h"
#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::FrameData;
using test::Scene;

// In [-1, 1), exactly: no function of the mathematical library may stand before a vertex, and calls
// are made one after another, since compilers choose the order of a call's arguments.
class Numbers {
 public:
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(static_cast<std::int32_t>(state_ >> 32)) * 0x1p-31;
  }

 private:
  std::uint64_t state_ = 20261122;
};

std::vector<Vec3> shaken(const BodyShape& shape, const Vec3& at, Numbers& numbers) {
  std::vector<Vec3> nodes = test::rest_nodes_at(shape, at);
  for (Vec3& node : nodes)
    for (int axis = 0; axis < 3; ++axis) node[axis] += 0.3 * numbers.next();
  return nodes;
}

// Three bodies that come nearer: apart, touching, deep inside; and one beside them at `far`.
Scene fixed_scene(double far = 0.0) {
  Scene scene;
  scene.bodies = {
      test::make_body("left", test::sphere_mesh(Vec3::Zero(), 1.0, 3), {4, 4, 4}),
      test::make_body("right", test::sphere_mesh(Vec3::Zero(), 1.1, 3), {5, 4, 3}),
      test::make_body("below", test::box_mesh(Vec3(-2, -1, -0.5), Vec3(2, 1, 0.5), 5), {6, 3, 2})};
  if (far > 0.0) scene.bodies.push_back(scene.bodies[0]);
  Numbers numbers;
  for (int f = 0; f < 6; ++f) {
    const double gap = 3.0 - 0.375 * f;
    std::vector<std::vector<Vec3>> nodes;
    nodes.push_back(shaken(*scene.bodies[0].shape, Vec3(-0.5 * gap, 0, 0), numbers));
    nodes.push_back(shaken(*scene.bodies[1].shape, Vec3(0.5 * gap, 0.125, 0), numbers));
    nodes.push_back(shaken(*scene.bodies[2].shape, Vec3(0, 0, -0.625 * gap), numbers));
    if (far > 0.0) nodes.push_back(shaken(*scene.bodies[3].shape, Vec3(far, far, far), numbers));
    scene.frames.push_back(test::make_frame(scene.bodies, std::move(nodes)));
  }
  return scene;
}

std::uint64_t hash_of_vertices(const Scene& scene) {
  Fnv1a hash;
  for (const FrameData& frame : scene.frames)
    for (const std::vector<Vec3>& body : frame.vertices)
      for (const Vec3& vertex : body)
        for (int axis = 0; axis < 3; ++axis) hash.value(vertex[axis]);
  return hash.digest();
}

std::uint64_t hash_of_contacts(const std::string& name, const Scene& scene) {
  const auto detector = test::prepared(name, scene);
  std::uint64_t hash = 0;
  for (std::size_t f = 0; f < scene.frames.size(); ++f)
    hash = chain_hash(hash, f, test::answer(*detector, scene.frames[f]));
  return hash;
}

// Both questions of steps, and the first times to the bit, which chain_hash() leaves out.
std::uint64_t hash_of_impacts(const std::string& name, const Scene& scene) {
  const auto detector = test::prepared(name, scene);
  std::uint64_t hash = 0;
  Fnv1a times;
  for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
    const Step step = {scene.frames[f].frame(f), scene.frames[f + 1].frame(f + 1)};
    detector->update_step(step);
    ContactSet out;
    for (const Question question : {Question::kImpacts, Question::kSelfImpacts})
      detector->query(question, out);
    out.canonicalize();
    hash = chain_hash(hash, f, out);
    for (const BodyImpact& impact : out.impacts)
      times.value(std::bit_cast<std::uint64_t>(impact.time.value()));
  }
  times.value(hash);
  return times.digest();
}

/// The detectors of core that answer questions of steps, or of frames.
std::vector<std::string> detectors_of(bool steps) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  std::vector<std::string> ids;
  for (const DetectorInfo& info : catalog.all()) {
    const auto detector = catalog.make(catalog.parse(info.id));
    const std::vector<Question>& questions = detector->semantics().questions;
    if (std::any_of(questions.begin(), questions.end(),
                    [&](Question question) { return is_of_steps(question) == steps; }))
      ids.push_back(info.id);
  }
  return ids;
}

TEST(SameBits, MappedVertices) { EXPECT_EQ(hash_of_vertices(fixed_scene()), 2314277800574072379u); }

// Of every pair of triangles that meet, and of the cells that the paper's pipeline reports.
constexpr std::uint64_t kTriangles = 1417059647185862788u, kAabbCells = 10896995354945533846u,
                        kAabbCellsOfN = 3389917938739314841u, kGridCells = 643190377150691094u;

std::map<std::string, std::uint64_t> expected_hashes() {
  return {{"aabb-tree", kTriangles},
          {"bd-tree", kTriangles},
          {"ffd-aabb", kAabbCells},
          {"ffd-aabb+tri", kTriangles},
          {"ffd-aabb-sphere", kAabbCells},
          {"ffd-aabb-sphere+tri", kTriangles},
          {"ffd-aabb-sphere2", kAabbCells},
          {"ffd-aabb-sphere2+tri", kTriangles},
          {"ffd-aabb-sphereN", kAabbCellsOfN},
          {"ffd-aabb-sphereN+tri", kTriangles},
          {"ffd-grid", kGridCells},
          {"ffd-grid+tri", kTriangles},
          {"ffd-lazy", kTriangles},
          {"full-refit", kTriangles},
          {"spatial-hash", kTriangles},
          {"sphere-tree", kTriangles}};
}

TEST(SameBits, ContactsOfEveryDetectorOfCore) {
  const Scene scene = fixed_scene();
  std::map<std::string, std::uint64_t> found;
  for (const std::string& id : detectors_of(false)) found[id] = hash_of_contacts(id, scene);
  EXPECT_EQ(found, expected_hashes());
}

TEST(SameBits, ContactsWithinStepsOfEveryDetectorOfCore) {
  constexpr std::uint64_t kImpacts = 2792814485780081825u;
  const Scene scene = fixed_scene();
  std::map<std::string, std::uint64_t> found;
  for (const std::string& id : detectors_of(true)) found[id] = hash_of_impacts(id, scene);
  EXPECT_EQ(found,
            (std::map<std::string, std::uint64_t>{
                {"ffd-lazy", kImpacts}, {"full-refit", kImpacts}, {"swept-aabb", kImpacts}}));
  for (const char* name : {"ffd-lazy:bounds=nodes", "ffd-lazy:threads=3", "full-refit:threads=2"})
    EXPECT_EQ(hash_of_impacts(name, scene), kImpacts) << name;
}

TEST(SameBits, VerticesMappedInSinglePrecision) {
  const Scene scene = fixed_scene();
  FrameNumbers<float> numbers;
  numbers.prepare(scene.bodies, true);
  Fnv1a hash;
  for (const FrameData& frame : scene.frames) {
    numbers.update(frame.frame());
    for (const std::span<const Vec3f> body : numbers.vertices())
      for (const Vec3f& vertex : body)
        for (int axis = 0; axis < 3; ++axis) hash.value(vertex[axis]);
  }
  EXPECT_EQ(hash.digest(), 13260691688073655738u);
}

// Nothing in this scene is so close to touching that floats say anything else than doubles.
TEST(SameBits, ContactsInSinglePrecision) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  const Scene scene = fixed_scene();
  std::size_t with_choice = 0;
  for (const DetectorInfo& info : catalog.all())
    for (const OptionInfo& option : info.options) {
      if (option.name != "precision") continue;
      ++with_choice;
      EXPECT_EQ(hash_of_contacts(info.id + ":precision=single", scene),
                expected_hashes().at(info.id))
          << info.id;
    }
  EXPECT_GE(with_choice, 16u);
}

// The far body leaves floats eight binary digits of a metre: contacts are rounded ones, of vertices
// that a detector maps in floats or of those that it is fed.
TEST(SameBits, RoundedContacts) {
  constexpr std::uint64_t kMapped = 11571887441486454298u, kFed = 709858669527445740u;
  const Scene scene = fixed_scene(0x1p16);
  const std::uint64_t exact = hash_of_contacts("ffd-lazy", scene);
  EXPECT_TRUE(exact != kMapped && exact != kFed && kFed != kMapped);
  for (const char* name : {"ffd-lazy:precision=single", "ffd-lazy:precision=single,bounds=nodes",
                           "ffd-lazy:precision=single,threads=3", "full-refit:precision=single",
                           "ffd-aabb+tri:precision=single,bounds=safe", "bd-tree:precision=single"})
    EXPECT_EQ(hash_of_contacts(name, scene), kMapped) << name;
  for (const char* name : {"aabb-tree:precision=single", "spatial-hash:precision=single",
                           "sphere-tree:precision=single"})
    EXPECT_EQ(hash_of_contacts(name, scene), kFed) << name;
}

}  // namespace
}  // namespace contactcheck
