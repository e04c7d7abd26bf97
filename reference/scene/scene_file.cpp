// Scene files (JSON), described in fixtures/README.md, "Scenes".
#include <algorithm>
#include <deque>
#include <set>
#include <utility>

#include "core/types/check.h"
#include "reference/mesh/mesh_spec.h"
#include "reference/scene/common_fields.h"
#include "reference/scene/copies_spec.h"
#include "reference/scene/draw_rules.h"
#include "reference/scene/drawn_scene.h"
#include "reference/scene/family_file.h"
#include "reference/scene/lattice_spec.h"
#include "reference/scene/motion_spec.h"
#include "reference/scene/recorded_bodies.h"
#include "reference/scene/scene.h"
#include "reference/scene/simulation_spec.h"
#include "reference/text/file_text.h"
#include "reference/text/id_check.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {
namespace {

constexpr double kLongest = 1e6;  // seconds
constexpr text::NumberRange kSeconds = {0.0, true, kLongest, false};

// Builds each distinct mesh and each distinct shape once.
class Workshop {
 public:
  struct Made {
    mesh::MeshSpec mesh;
    LatticeSpec lattice;
    std::shared_ptr<const BodyShape> shape;
    std::string notes;
  };

  const Made& shape(const mesh::MeshSpec& mesh, const LatticeSpec& lattice,
                    const text::JsonField& body) {
    for (const Made& made : made_) {
      if (made.mesh == mesh && made.lattice == lattice) return made;
    }
    const mesh::LoadedMesh& loaded = loaded_mesh(mesh, body.at("mesh"));
    Made made{mesh, lattice, nullptr, loaded.notes};
    try {
      made.shape = build_shape(loaded.mesh, lattice);
      if (mesh.weld) made.shape = welded(*made.shape);
    } catch (const InputError& error) {
      body.at("mesh").fail("cannot be used: " + text::without_full_stop(error.what()));
    }
    made.notes = shape_notes(*made.shape, std::move(made.notes));
    return made_.emplace_back(std::move(made));
  }

 private:
  const mesh::LoadedMesh& loaded_mesh(const mesh::MeshSpec& spec, const text::JsonField& field) {
    for (const auto& [known, mesh] : loaded_) {
      if (known == spec) return mesh;
    }
    return loaded_.emplace_back(spec, mesh::build_mesh(spec, field)).second;
  }

  std::deque<Made> made_;
  std::deque<std::pair<mesh::MeshSpec, mesh::LoadedMesh>> loaded_;
};

void parse_times(const text::JsonField& root, std::size_t frames, std::size_t wanted_frames,
                 Scene& scene) {
  const std::string key = root.exactly_one_of({"duration", "time_step"});
  const double value = root.at(key).number(kSeconds);
  const double duration = key == "duration" ? value : value * static_cast<double>(frames);
  scene.frames = wanted_frames > 0 ? wanted_frames : frames;
  scene.time_step = key == "time_step" && scene.frames == frames
                        ? value
                        : duration / static_cast<double>(scene.frames);
}

// Steps keep their length: another one would be another simulation.
void parse_simulated_times(const text::JsonField& root, std::size_t wanted_frames, Scene& scene) {
  scene.kind = parse_simulation(root.at("simulation"));
  for (const char* key : {"duration", "time_step"}) {
    if (!root.has(key)) continue;
    root.at(key).fail("is not allowed beside \"simulation\", whose step and every give the time");
  }
  const std::size_t frames = root.at("frames").whole(1, kMostFrames);
  scene.frames = wanted_frames > 0 ? wanted_frames : frames;
  scene.time_step =
      scene.simulation()->settings.time_step * static_cast<double>(scene.simulation()->every);
}

void add_body(const text::JsonField& field, const std::string& name, const Workshop::Made& made,
              const mesh::MeshSpec& mesh, Motion motion, Scene& scene) {
  scene.bodies.push_back({name, made.shape});
  scene.origins.push_back({name, mesh::described_source(mesh), made.notes});
  scene.motions.push_back(std::move(motion));
  if (scene.simulation()) {
    add_simulated_body(field, *made.shape, scene.motions.back(), *scene.simulation());
  } else {
    require_no_simulation_keys(field);
  }
}

void add_copies(const text::JsonField& field, const std::string& name, const Workshop::Made& made,
                const mesh::MeshSpec& mesh, const Motion& motion, Scene& scene) {
  if (!field.has("motion")) field.at("copies").fail("needs a \"motion\" beside it");
  const CopiesSpec copies = parse_copies(field.at("copies"));
  std::set<std::string> taken;
  for (const Body& body : scene.bodies) taken.insert(body.name);
  for (std::size_t i = 0; i < copies.count(); ++i) {
    const std::string own = name_of_copy(name, i);
    if (taken.count(own)) field.at("name").refuse("such that \"" + own + "\" is free");
    add_body(field, own, made, mesh, motion_of_copy(copies, motion, i), scene);
  }
}

void parse_body(const text::JsonField& field, const std::filesystem::path& folder,
                Workshop& workshop, RecordedBodies& recorded, Scene& scene) {
  field.only_keys(
      {"name", "copies", "mesh", "lattice", "motion", "recording", "material", "velocity"});
  const std::string name = parse_body_name(field.at("name"), scene.bodies);
  if (field.has("recording")) return recorded.add(field, name, folder, scene);
  const mesh::MeshSpec mesh = mesh::parse_mesh_spec(field.at("mesh"), folder);
  const LatticeSpec lattice =
      field.has("lattice") ? parse_lattice_spec(field.at("lattice")) : LatticeSpec{};
  const Workshop::Made& made = workshop.shape(mesh, lattice, field);
  Motion motion = field.has("motion") ? parse_motion(field.at("motion"), *made.shape) : Motion{};
  if (field.has("copies")) return add_copies(field, name, made, mesh, motion, scene);
  add_body(field, name, made, mesh, std::move(motion), scene);
}

// Poses of two bodies at given separations, all defaults filled in: a frame for each.
void parse_sweep(const text::JsonField& root, std::size_t wanted_frames, Scene& scene) {
  // In the scene's size: deeper, a body may have gone through the other one.
  constexpr text::NumberRange kSeparation = {-0.5, false, 10.0, false};
  constexpr std::size_t kMostOrientations = 10'000, kLargestSeed = 1'000'000'000;
  constexpr std::size_t kMostPoses = 100'000;
  for (const char* key : {"frames", "duration", "time_step", "simulation"})
    if (root.has(key))
      root.at(key).fail("is not allowed beside \"sweep\", which says what frames there are");
  const text::JsonField field = root.at("sweep");
  field.only_keys({"separations", "orientations", "seed"});
  SweepSpec& spec = scene.kind.emplace<SweepSpec>();
  for (const text::JsonField& item : field.at("separations").items(1)) {
    const double separation = item.number(kSeparation);
    if (!spec.separations.empty() && !(separation > spec.separations.back()))
      item.refuse("above " + text::shown(spec.separations.back()) + ", the one before");
    spec.separations.push_back(separation);
  }
  if (field.has("orientations"))
    spec.orientations = field.at("orientations").whole(1, kMostOrientations);
  if (field.has("seed")) spec.seed = field.at("seed").whole(0, kLargestSeed);
  if (spec.separations.size() * spec.orientations > kMostPoses)
    field.fail("asks for more than " + std::to_string(kMostPoses) + " poses");
  if (wanted_frames > 0)
    throw InputError("--frames: scene " + text::in_quotes(scene.id) +
                     " is a sweep, has a frame for every pose and cannot be given others");
  scene.frames = spec.separations.size() * spec.orientations;
  scene.time_step = 1.0;
}

Drawn parse_drawn(const text::JsonField& field) {
  field.only_keys({"seed", "number", "redrawn", "happens", "parameters"});
  Drawn drawn;
  drawn.seed = field.at("seed").whole(0, kLargestDrawSeed);
  drawn.number = field.at("number").whole(1, kMostDrawnScenes);
  drawn.redrawn = field.at("redrawn").whole(0, kMostRedraws);
  drawn.happens =
      field.at("happens").one_of(std::vector<std::string>(kHappenings.begin(), kHappenings.end()));
  const text::JsonField parameters = field.at("parameters");
  parameters.only_keys(std::vector<std::string>(kDrawnParameters.begin(), kDrawnParameters.end()));
  for (const char* name : kDrawnParameters)
    drawn.parameters[name] = parameters.at(name).number({-1e9, false, 1e9, false});
  return drawn;
}

// Two bodies that do not move by themselves.
void require_sweep_bodies(const text::JsonField& root, const Scene& scene) {
  const std::vector<text::JsonField> bodies = root.at("bodies").items();
  for (const text::JsonField& body : bodies)
    for (const char* key : {"motion", "recording", "copies"})
      if (body.has(key))
        body.at(key).fail("is not allowed in a sweep, which moves the second body");
  if (bodies.size() != 2)
    root.at("bodies").refuse("an array of two, of which the sweep moves the second");
  for (std::size_t b = 0; b < 2; ++b)
    if (!(bounding_box(scene.bodies[b].shape->mesh.vertices).extent().maxCoeff() > 0.0))
      bodies[b].at("mesh").fail("is a point, for which there is no separation");
}

// Before bodies are read: their recordings say how many frames there are.
bool any_recording(const text::JsonField& root) {
  const std::vector<text::JsonField> bodies = root.at("bodies").items(1);
  return std::any_of(bodies.begin(), bodies.end(), [](const text::JsonField& body) {
    return body.is(text::JsonValue::Kind::kObject) && body.has("recording");
  });
}

// As many as are asked for, or as every recording has.
std::size_t recorded_frames(const text::JsonField& root, const RecordedBodies& recorded,
                            Scene& scene) {
  if (!root.has("frames")) {
    const std::size_t frames = recorded.available(kMostFrames).frames;
    recorded.note_unused(frames, kMostFrames, scene);
    return frames;
  }
  const std::size_t frames = root.at("frames").whole(1, kMostFrames);
  const auto [available, body] = recorded.available(frames);
  if (available < frames)
    root.at("frames").refuse("at most " + std::to_string(available) +
                             ", as many as the recording of body " +
                             text::in_quotes(scene.bodies[body].name) + " has");
  return frames;
}

}  // namespace

namespace {

/// What the fields point to that recordings keep for their messages.
struct ParsedScene {
  std::string name;
  text::JsonValue value;
};

Scene load_document(const SceneText& document, std::size_t wanted_frames, bool unread) {
  const auto parsed = std::make_shared<const ParsedScene>(
      ParsedScene{document.name, text::parse_json(document.text, document.name)});
  const text::JsonField root(parsed->value, parsed->name);
  if (root.has("parameter")) {
    if (wanted_frames > 0)
      throw InputError("--frames: the family of cases in the " + document.name +
                       " has its own frames and cannot be given others");
    return parse_family(root, document.folder);
  }
  root.only_keys({"id", "title", "drawn", "frames", "duration", "time_step", "simulation", "sweep",
                  "levels", "bodies"});
  Scene scene;
  scene.id = text::parse_id(root.at("id"));
  if (root.has("drawn")) {
    if (wanted_frames > 0)
      throw InputError("--frames: scene " + text::in_quotes(scene.id) +
                       " is drawn with its frames and cannot be given others");
    scene.drawn = parse_drawn(root.at("drawn"));
  }
  scene.title = root.has("title") ? root.at("title").text() : scene.id;
  if (root.has("sweep")) {
    parse_sweep(root, wanted_frames, scene);
  } else if (root.has("simulation")) {
    parse_simulated_times(root, wanted_frames, scene);
  } else if (!any_recording(root)) {
    parse_times(root, root.at("frames").whole(1, kMostFrames), wanted_frames, scene);
  }
  scene.levels = parse_levels(root.at("levels"));
  Workshop workshop;
  const auto recorded_bodies = std::make_shared<RecordedBodies>();
  RecordedBodies& recorded = *recorded_bodies;
  for (const text::JsonField& body : root.at("bodies").items(1)) {
    parse_body(body, document.folder, workshop, recorded, scene);
  }
  if (scene.sweep()) require_sweep_bodies(root, scene);
  if (recorded.empty()) return scene;
  const std::size_t frames = recorded_frames(root, recorded, scene);
  parse_times(root, frames, 0, scene);
  if (wanted_frames > frames)
    throw InputError("--frames: scene " + text::in_quotes(scene.id) + " has " +
                     std::to_string(frames) + " recorded frames");
  if (wanted_frames > 0) scene.frames = wanted_frames;  // the first ones, each at its own time
  if (unread && !recorded.fits_lattices())
    scene.read_frame = [parsed, recorded_bodies, base = scene](std::size_t frame) {
      return recorded_bodies->nodes(base, frame);
    };
  else
    recorded.fill(scene);
  return scene;
}

}  // namespace

Scene load_scene_text(const SceneText& document, std::size_t wanted_frames) {
  return load_document(document, wanted_frames, false);
}

Scene load_scene_unread(const SceneText& document) { return load_document(document, 0, true); }

Scene load_scene(const std::filesystem::path& file, std::size_t wanted_frames) {
  return load_scene_text({text::read_file_bytes(file, "scene file"),
                          "scene file " + text::in_quotes(file.string()), file.parent_path()},
                         wanted_frames);
}

}  // namespace contactcheck::scene
