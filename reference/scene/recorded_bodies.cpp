#include "reference/scene/recorded_bodies.h"

#include <utility>

#include "core/types/check.h"
#include "reference/scene/file_text.h"
#include "reference/scene/lattice_fit.h"
#include "reference/scene/mesh_spec.h"

namespace contactcheck {
namespace {

void require_no_other_motion(const JsonField& body, const Scene& scene) {
  if (scene.simulation) body.at("recording").fail("is not allowed in a simulated scene");
  for (const char* key : {"copies", "motion", "material", "velocity"})
    if (body.has(key)) body.at(key).fail("is not allowed beside a \"recording\"");
}

// The recording has the vertices that the mesh has; what changes them would part the two.
LoadedMesh mesh_of(const JsonField& body, const RecordedFrames& frames,
                   const std::filesystem::path& folder) {
  if (!body.has("mesh") && frames.spec().numbered) return frames.first_mesh();
  const JsonField field = body.at("mesh");
  for (const char* key : {"triangles", "subdivide", "size", "scale", "center"})
    if (field.has(key))
      field.at(key).fail(
          "is not allowed beside a \"recording\", which has \"scale\" and "
          "\"translate\" for both");
  return build_mesh(parse_mesh_spec(field, folder), field);
}

}  // namespace

void RecordedBodies::add(const JsonField& body, const std::string& name,
                         const std::filesystem::path& folder, Scene& scene) {
  require_no_other_motion(body, scene);
  const JsonField field = body.at("recording");
  RecordedFrames frames(parse_recording_spec(field, folder), field);
  const LatticeSpec lattice =
      body.has("lattice") ? parse_lattice_spec(body.at("lattice"), true) : LatticeSpec{};
  LoadedMesh loaded = mesh_of(body, frames, folder);
  frames.spec().place(loaded.mesh.vertices);
  std::string notes = loaded.notes;
  try {
    scene.bodies.push_back({name, build_shape(std::move(loaded.mesh), lattice)});
  } catch (const InputError& error) {
    field.fail("has a mesh that cannot be used: " + without_full_stop(error.what()));
  }
  add_note(notes, describe(scene.bodies.back().shape->topology));
  scene.origins.push_back({name, frames.described(), notes});
  scene.motions.emplace_back();
  bodies_.push_back({scene.bodies.size() - 1, lattice, std::move(frames)});
}

RecordedBodies::Available RecordedBodies::available(std::size_t most) const {
  CONTACTCHECK_INVARIANT(!empty(), "some body is recorded");
  Available out{most, bodies_.front().body};
  for (const Recorded& recorded : bodies_) {
    const std::size_t frames = recorded.frames.available(most);
    if (frames < out.frames) out = {frames, recorded.body};
  }
  return out;
}

void RecordedBodies::fill(Scene& scene) const {
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (std::size_t f = 0; f < scene.frames; ++f) frames.push_back(scene.nodes_at(scene.time_of(f)));
  for (const Recorded& recorded : bodies_) {
    const BodyShape& shape = *scene.bodies[recorded.body].shape;
    std::optional<LatticeFit> fit;
    if (recorded.lattice.fit) fit.emplace(shape, recorded.lattice.smoothing);
    FitError error{recorded.body, {}, {}};
    for (std::size_t f = 0; f < scene.frames; ++f) {
      std::vector<Vec3> positions = recorded.frames.positions(f, shape.mesh);
      frames[f][recorded.body] = fit ? fit->fitted(positions, error) : std::move(positions);
    }
    if (fit) scene.fits.push_back(std::move(error));
  }
  scene.recorded = std::move(frames);
}

}  // namespace contactcheck
