#include "reference/scene/recorded_bodies.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/types/check.h"
#include "core/types/given_vertices.h"
#include "reference/mesh/mesh_spec.h"
#include "reference/scene/common_fields.h"
#include "reference/scene/lattice_fit.h"
#include "reference/text/file_text.h"
#include "reference/text/words.h"

namespace contactcheck::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestNumber = 1'000'000'000;
constexpr text::NumberRange kScale = {0.0, true, 1e9, false};
constexpr text::NumberRange kTranslation = {-1e7, false, 1e7,
                                            false};  // metres, as positions of motions

// "cloth_%04d.obj": one %d, or %0Nd with N from 1 to 9.
void parse_pattern(const text::JsonField& field, const fs::path& folder, RecordingSpec& spec) {
  const std::string name = field.text();
  const std::size_t mark = name.find('%');
  std::size_t at = mark == std::string::npos ? name.size() : mark + 1;
  if (at + 1 < name.size() && name[at] == '0' && name[at + 1] >= '1' && name[at + 1] <= '9') {
    spec.digits = static_cast<std::size_t>(name[at + 1] - '0');
    at += 2;
  }
  if (at >= name.size() || name[at] != 'd' || name.find('%', at) != std::string::npos)
    field.refuse("the name of numbered files with one number in it, as %d or %04d");
  spec.before_number = (folder / name.substr(0, mark)).string();
  spec.after_number = name.substr(at + 1);
}

std::string triangle_text(const Triangle& t) {
  return "(" + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) +
         ")";
}

// A face that is a triangle must be that one; of a polygon, one with its corners.
bool fills(const Triangle& triangle, std::span<const std::uint32_t> face) {
  if (face.size() == 3) return std::ranges::equal(face, triangle);
  return std::ranges::all_of(triangle, [&](std::uint32_t corner) {
    return std::ranges::find(face, corner) != face.end();
  });
}

std::string counts(std::size_t vertices, std::size_t triangles) {
  return std::to_string(vertices) + " vertices and " + std::to_string(triangles) + " triangles";
}

// What tells the frame's topology from that of the mesh; empty when nothing does. Where faces are
// polygons, a later frame might split them otherwise by itself: what it must have are the same
// faces, which the mesh's triangles fill, one face after the other. `unfilled`: faces that none
// fill.
std::string topology_fault(const mesh::PolygonSoup& frame, const std::vector<std::size_t>& unfilled,
                           const BodyShape& shape) {
  const std::vector<Triangle> given = shape.given.numbered(shape.mesh.triangles);
  std::vector<std::size_t> filled;
  std::size_t triangles = 0;
  for (std::size_t f = 0; f < frame.size(); ++f) {
    const std::size_t corners = frame.polygon(f).size();
    if (corners < 3 || std::ranges::binary_search(unfilled, f)) continue;
    filled.push_back(f);
    triangles += corners - 2;
  }
  if (frame.points.size() != shape.given_vertex_count() || triangles != given.size())
    return "has " + counts(frame.points.size(), triangles) + ", the body's mesh has " +
           counts(shape.given_vertex_count(), given.size()) +
           (triangles != given.size()
                ? ""
                : "; a program that splits vertices at seams, as some do for PLY, keeps them in "
                  "OBJ");
  std::size_t t = 0;
  for (const std::size_t f : filled) {
    const std::span<const std::uint32_t> face = frame.polygon(f);
    for (std::size_t k = 2; k < face.size(); ++k, ++t)
      if (!fills(given[t], face))
        return "has other triangles than the body's mesh: triangle " + std::to_string(t) + " is " +
               triangle_text({face[0], face[k - 1], face[k]}) + ", there " +
               triangle_text(given[t]);
  }
  return "";
}

// Joins the points of a frame whose triangles share none into the vertices of its mesh. Returns a
// fault, as topology_fault() does, if triangle counts differ or corners of one vertex are apart.
std::string join_corners(const BodyShape& shape, mesh::PolygonSoup& frame) {
  const std::vector<Triangle> given = shape.given.numbered(shape.mesh.triangles);
  if (frame.size() != given.size())
    return "has " + std::to_string(frame.size()) + " triangles, the body's mesh has " +
           std::to_string(given.size());
  std::vector<Vec3> points(shape.given_vertex_count(), Vec3::Zero());
  std::vector<std::size_t> first(points.size(), frame.points.size());
  for (std::size_t corner = 0; corner < frame.points.size(); ++corner) {
    const std::uint32_t vertex = given[corner / 3][corner % 3];
    if (first[vertex] == frame.points.size()) {
      first[vertex] = corner;
      points[vertex] = frame.points[corner];
    } else if (points[vertex] != frame.points[corner]) {
      const auto place = [](std::size_t c) {
        return "corner " + std::to_string(c % 3) + " of triangle " + std::to_string(c / 3);
      };
      return "has " + place(first[vertex]) + " and " + place(corner) + " apart, which are vertex " +
             std::to_string(vertex) +
             " of the body's mesh; STL has no vertices of several triangles, OBJ has";
    }
  }
  frame.points = std::move(points);
  return "";
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Also a name of what is no file, or leads to none: that is for the reader to refuse, and no end.
bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::symlink_status(file, ignored).type() != fs::file_type::not_found;
}

}  // namespace

std::string RecordingSpec::file_of(std::size_t frame) const {
  if (!cache.empty()) return cache;
  if (!files.empty()) return files[number_of(frame)];
  std::string number = std::to_string(number_of(frame));
  if (number.size() < digits) number.insert(0, digits - number.size(), '0');
  return before_number + number + after_number;
}

fs::path RecordingSpec::numbered_part(std::size_t frame) const {
  const std::string file = file_of(frame);
  return file.substr(0, file.find('/', file.size() - after_number.size()));
}

std::optional<std::size_t> RecordingSpec::frame_of(const std::string& name) const {
  const std::string before = fs::path(before_number).filename().string(),
                    after = after_number.substr(0, after_number.find('/'));
  if (name.size() <= before.size() + after.size() || !name.starts_with(before) ||
      !name.ends_with(after))
    return std::nullopt;
  const auto number = text::whole_number<std::size_t>(
      std::string_view(name).substr(before.size(), name.size() - before.size() - after.size()));
  if (!number || *number < first || (*number - first) % step != 0) return std::nullopt;
  const std::size_t frame = (*number - first) / step;
  if (numbered_part(frame).filename().string() != name) return std::nullopt;
  return frame;
}

void RecordingSpec::place(std::vector<Vec3>& vertices) const {
  if (scale != 1.0)
    for (Vec3& v : vertices) v *= scale;
  if (translate != Vec3::Zero())
    for (Vec3& v : vertices) v += translate;
}

RecordingSpec parse_recording_spec(const text::JsonField& field, const fs::path& folder) {
  field.only_keys(
      {"frames", "files", "cache", "first", "step", "scale", "translate", "repair", "space"});
  RecordingSpec spec;
  const std::string source = field.exactly_one_of({"frames", "files", "cache"});
  if (source == "frames") {
    parse_pattern(field.at("frames"), folder, spec);
  } else if (source == "files") {
    for (const text::JsonField& file : field.at("files").items(1))
      spec.files.push_back((folder / file.text()).lexically_normal().string());
  } else {
    spec.cache = (folder / field.at("cache").text()).lexically_normal().string();
  }
  if (field.has("space")) {
    if (source != "cache") field.at("space").fail("is of a \"cache\"");
    spec.cache_space = field.at("space").one_of({"file", "mesh"}) == "file" ? CacheSpace::kFile
                                                                            : CacheSpace::kMesh;
  }
  if (field.has("first")) spec.first = field.at("first").whole(0, kLargestNumber);
  if (!spec.files.empty() && spec.first >= spec.files.size())
    field.at("first").refuse("below " + std::to_string(spec.files.size()) +
                             ", the number of files");
  if (field.has("step")) spec.step = field.at("step").whole(1, kLargestNumber);
  if (field.has("repair"))
    spec.folded = field.at("repair").boolean() ? mesh::Folded::kFanned : mesh::Folded::kLeftOut;
  if (field.has("scale")) spec.scale = field.at("scale").number(kScale);
  if (field.has("translate")) spec.translate = field.at("translate").vector(kTranslation);
  return spec;
}

RecordedFrames::RecordedFrames(RecordingSpec spec, const text::JsonField& field)
    : spec_(std::move(spec)), field_(field) {
  if (spec_.in_meshes()) return;
  try {
    cache_ = read_point_cache(spec_.cache);
  } catch (const InputError& error) {
    field_.fail("cannot be read: " + text::without_full_stop(error.what()));
  }
}

void RecordedFrames::fail_at(std::size_t frame, const std::string& what) const {
  field_.fail("frame " + std::to_string(frame) + " (" + text::in_quotes(spec_.file_of(frame)) +
              (cache_ ? ", sample " + std::to_string(spec_.number_of(frame)) : "") + ") " + what);
}

std::size_t RecordedFrames::available(std::size_t most) const {
  std::size_t count = 0;
  const std::size_t listed = cache_ ? cache_->samples() : spec_.files.size();
  if (spec_.first < listed) {
    count = std::min(most, (listed - spec_.first - 1) / spec_.step + 1);
  } else if (listed == 0) {
    while (count < most && is_there(spec_.file_of(count))) ++count;
    if (count > 0 && count < most) refuse_gap(count, most);
  }
  if (count == 0 && listed > 0)
    field_.at("first").refuse("below " + std::to_string(listed) + ", the number of samples");
  if (count == 0)
    field_.fail("has no frame: there is no file " + text::in_quotes(spec_.file_of(0)));
  return count;
}

// A later file says that this one is lost, and not that the recording ends before it.
void RecordedFrames::refuse_gap(std::size_t missing, std::size_t most) const {
  const fs::path lost = spec_.file_of(missing);
  std::error_code ignored;
  std::optional<std::size_t> later;
  const fs::path folder = folder_of(spec_.numbered_part(missing));
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::optional<std::size_t> frame = spec_.frame_of(entry.path().filename().string());
    if (!frame || *frame <= missing || *frame >= most || !is_there(spec_.file_of(*frame))) continue;
    later = std::min(later.value_or(*frame), *frame);
  }
  if (later)
    field_.fail("has a gap: there is no file " + text::in_quotes(lost.string()) +
                ", but there is " + text::in_quotes(spec_.file_of(*later)));
}

mesh::LoadedMesh RecordedFrames::first_mesh() const {
  try {
    return mesh::read_mesh_file(spec_.file_of(0), spec_.folded);
  } catch (const InputError& error) {
    fail_at(0, "cannot be read: " + text::without_full_stop(error.what()));
  }
}

std::vector<Vec3> RecordedFrames::positions(std::size_t frame, const BodyShape& shape) const {
  std::vector<Vec3> out =
      shape.given.kept(cache_ ? cached_positions(frame, shape) : numbered_positions(frame, shape));
  spec_.place(out);
  for (std::uint32_t i = 0; i < out.size(); ++i)
    if (!out[i].allFinite())
      fail_at(frame, "overflows at vertex " + std::to_string(shape.given.number_of(i)));
  return out;
}

std::vector<Vec3> RecordedFrames::numbered_positions(std::size_t frame,
                                                     const BodyShape& shape) const {
  mesh::PolygonSoup loaded;
  try {
    loaded = mesh::read_polygons(spec_.file_of(frame));
  } catch (const InputError& error) {
    fail_at(frame, "cannot be read: " + text::without_full_stop(error.what()));
  }
  const std::string fault = mesh::has_own_corners(spec_.file_of(frame))
                                ? join_corners(shape, loaded)
                                : topology_fault(loaded, unfilled_, shape);
  if (!fault.empty()) fail_at(frame, fault);
  return std::move(loaded.points);
}

std::vector<Vec3> RecordedFrames::cached_positions(std::size_t frame,
                                                   const BodyShape& shape) const {
  if (cache_->points() != shape.given_vertex_count())
    field_.at("cache").fail("has " + std::to_string(cache_->points()) +
                            " points, the body's mesh has " +
                            std::to_string(shape.given_vertex_count()) + " vertices");
  try {
    std::vector<Vec3> points = cache_->sample(spec_.number_of(frame));
    space_.apply(points);
    return points;
  } catch (const InputError& error) {
    field_.fail("cannot be used: " + text::without_full_stop(error.what()));
  }
}

std::string RecordedFrames::find_space(const TriangleMesh& mesh) {
  if (!cache_) return "";
  if (cache_->points() != mesh.vertices.size())
    field_.at("cache").fail("has " + std::to_string(cache_->points()) +
                            " points, the body's mesh has " + std::to_string(mesh.vertices.size()) +
                            " vertices");
  std::string notes;
  try {
    const std::size_t still = cache_->still_samples();
    if (still > 1)
      mesh::add_note(notes, "the last " + std::to_string(still) + " samples are equal");
    if (spec_.cache_space == CacheSpace::kFile) return notes;
    const std::optional<SpaceChange> found = space_change(cache_->sample(0), mesh.vertices);
    const bool wanted = spec_.cache_space == CacheSpace::kMesh;
    if (!found && wanted)
      field_.at("space").fail(
          "cannot be that of the mesh: no change of axes and no offset lead sample 0 to it");
    if (!found)
      mesh::add_note(notes, "sample 0 of the cache is not the mesh: it is taken as it is");
    else if (found->moves() && !wanted)
      mesh::add_note(notes, "sample 0 of the cache is the mesh with " + found->described() +
                                ": it is taken as it is (--cache-space mesh, in a scene \"space\": "
                                "\"mesh\", leads it there)");
    else if (!found->is_identity())
      mesh::add_note(notes, "the cache is led to the mesh by " + found->described());
    if (found && (wanted || !found->moves())) space_ = *found;
  } catch (const InputError& error) {
    field_.fail("cannot be used: " + text::without_full_stop(error.what()));
  }
  return notes;
}

std::string RecordedFrames::described() const {
  const std::string file = spec_.file_of(0);
  return spec_.in_meshes() ? "recorded frames, " + file + " and on" : "recorded samples of " + file;
}

namespace {

void require_no_other_motion(const text::JsonField& body, const Scene& scene) {
  if (scene.simulation()) body.at("recording").fail("is not allowed in a simulated scene");
  for (const char* key : {"copies", "motion", "material", "velocity"})
    if (body.has(key)) body.at(key).fail("is not allowed beside a \"recording\"");
}

// The recording has the vertices that the mesh has; what changes them would make the two differ.
mesh::LoadedMesh mesh_of(const text::JsonField& body, const RecordedFrames& frames,
                         const std::filesystem::path& folder) {
  if (!body.has("mesh") && frames.spec().in_meshes()) return frames.first_mesh();
  const text::JsonField field = body.at("mesh");
  for (const char* key : {"triangles", "subdivide", "size", "scale", "center"})
    if (field.has(key))
      field.at(key).fail(
          "is not allowed beside a \"recording\", which has \"scale\" and "
          "\"translate\" for both");
  return mesh::build_mesh(mesh::parse_mesh_spec(field, folder), field);
}

}  // namespace

void RecordedBodies::add(const text::JsonField& body, const std::string& name,
                         const std::filesystem::path& folder, Scene& scene) {
  require_no_other_motion(body, scene);
  const text::JsonField field = body.at("recording");
  RecordedFrames frames(parse_recording_spec(field, folder), field);
  const LatticeSpec lattice =
      body.has("lattice") ? parse_lattice_spec(body.at("lattice"), true) : LatticeSpec{};
  mesh::LoadedMesh loaded = mesh_of(body, frames, folder);
  frames.leave_unfilled(std::move(loaded.unfilled));
  mesh::add_note(loaded.notes, frames.find_space(loaded.mesh));
  // What no triangle uses keeps its number and overflows nowhere.
  const GivenVertices given = drop_unused_vertices(loaded.mesh);
  frames.spec().place(loaded.mesh.vertices);
  loaded.mesh = {given.spread(loaded.mesh.vertices),
                 given.numbered(std::move(loaded.mesh.triangles))};
  try {
    std::shared_ptr<const BodyShape> shape = build_shape(std::move(loaded.mesh), lattice);
    if (body.has("mesh") && mesh::parse_mesh_spec(body.at("mesh"), folder).weld)
      shape = welded(*shape);
    scene.bodies.push_back({name, std::move(shape)});
  } catch (const InputError& error) {
    field.fail("has a mesh that cannot be used: " + text::without_full_stop(error.what()));
  }
  scene.origins.push_back(
      {name, frames.described(), shape_notes(*scene.bodies.back().shape, std::move(loaded.notes))});
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

void RecordedBodies::note_unused(std::size_t frames, std::size_t most, Scene& scene) const {
  for (const Recorded& recorded : bodies_)
    if (const std::size_t has = recorded.frames.available(most); has > frames)
      mesh::add_note(scene.origins[recorded.body].notes,
                     "only the first " + std::to_string(frames) + " of its " + std::to_string(has) +
                         " frames are used, as many as every recording has");
}

bool RecordedBodies::fits_lattices() const {
  return std::ranges::any_of(bodies_, [](const Recorded& r) { return r.lattice.fit; });
}

std::vector<std::vector<Vec3>> RecordedBodies::nodes(const Scene& scene, std::size_t frame) const {
  std::vector<std::vector<Vec3>> out = scene.nodes_at(scene.time_of(frame));
  for (const Recorded& recorded : bodies_)
    out[recorded.body] = recorded.frames.positions(frame, *scene.bodies[recorded.body].shape);
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
      std::vector<Vec3> positions = recorded.frames.positions(f, shape);
      try {
        frames[f][recorded.body] = fit ? fit->fitted(positions, error) : std::move(positions);
      } catch (const InputError& overflow) {
        recorded.frames.fail_at(f, "cannot be fitted: " + text::without_full_stop(overflow.what()));
      }
    }
    if (fit) scene.fits.push_back(std::move(error));
  }
  scene.recorded = std::move(frames);
}

}  // namespace contactcheck::scene
