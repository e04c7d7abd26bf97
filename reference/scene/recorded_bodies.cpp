#include "reference/scene/recorded_bodies.h"

#include <algorithm>
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
  spec.numbered = true;
  spec.before_number = (folder / name.substr(0, mark)).string();
  spec.after_number = name.substr(at + 1);
}

std::string triangle_text(const Triangle& t) {
  return "(" + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) +
         ")";
}

// What tells the frame's topology from that of the mesh; empty when nothing does.
// A face that is a triangle must be that one; of a polygon, one with its corners.
bool fills(const Triangle& triangle, const std::vector<std::uint32_t>& face) {
  if (face.size() == 3) return std::equal(face.begin(), face.end(), triangle.begin());
  return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
    return std::find(face.begin(), face.end(), corner) != face.end();
  });
}

std::size_t triangles_in(const mesh::PolygonSoup& frame) {
  std::size_t count = 0;
  for (const auto& polygon : frame.polygons) count += polygon.size() - 2;
  return count;
}

// Where faces are polygons, a later frame might split them otherwise by itself: what it must have
// are the same faces, which the mesh's triangles fill, one face after the other.
std::string topology_fault(const mesh::PolygonSoup& frame, const BodyShape& shape) {
  const std::vector<Triangle> given = shape.given.numbered(shape.mesh.triangles);
  const auto counts = [](std::size_t vertices, std::size_t triangles) {
    return std::to_string(vertices) + " vertices and " + std::to_string(triangles) + " triangles";
  };
  const std::size_t triangles = triangles_in(frame);
  if (frame.points.size() != shape.given_vertex_count() || triangles != given.size())
    return "has " + counts(frame.points.size(), triangles) + ", the body's mesh has " +
           counts(shape.given_vertex_count(), given.size());
  std::size_t t = 0;
  for (const std::vector<std::uint32_t>& face : frame.polygons)
    for (std::size_t k = 2; k < face.size(); ++k, ++t)
      if (!fills(given[t], face))
        return "has other triangles than the body's mesh: triangle " + std::to_string(t) + " is " +
               triangle_text({face[0], face[k - 1], face[k]}) + ", there " +
               triangle_text(given[t]);
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
  if (!numbered) return before_number;
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
  field.only_keys({"frames", "cache", "first", "step", "scale", "translate"});
  RecordingSpec spec;
  if (field.exactly_one_of({"frames", "cache"}) == "frames") {
    parse_pattern(field.at("frames"), folder, spec);
  } else {
    spec.before_number = (folder / field.at("cache").text()).lexically_normal().string();
  }
  if (field.has("first")) spec.first = field.at("first").whole(0, kLargestNumber);
  if (field.has("step")) spec.step = field.at("step").whole(1, kLargestNumber);
  if (field.has("scale")) spec.scale = field.at("scale").number(kScale);
  if (field.has("translate")) spec.translate = field.at("translate").vector(kTranslation);
  return spec;
}

RecordedFrames::RecordedFrames(RecordingSpec spec, const text::JsonField& field)
    : spec_(std::move(spec)), field_(field) {
  if (spec_.numbered) return;
  try {
    cache_ = read_point_cache(spec_.before_number);
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
  if (cache_ && spec_.first < cache_->samples()) {
    count = std::min(most, (cache_->samples() - spec_.first - 1) / spec_.step + 1);
  } else if (!cache_) {
    while (count < most && is_there(spec_.file_of(count))) ++count;
    if (count > 0 && count < most) refuse_gap(count, most);
  }
  if (count == 0 && cache_)
    field_.at("first").refuse("below " + std::to_string(cache_->samples()) +
                              ", the number of samples");
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
    return mesh::read_mesh_file(spec_.file_of(0));
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
  const std::string fault = topology_fault(loaded, shape);
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
    return cache_->sample(spec_.number_of(frame));
  } catch (const InputError& error) {
    field_.fail("cannot be used: " + text::without_full_stop(error.what()));
  }
}

std::string RecordedFrames::described() const {
  const std::string file = spec_.file_of(0);
  return spec_.numbered ? "recorded frames, " + file + " and on" : "recorded samples of " + file;
}

namespace {

void require_no_other_motion(const text::JsonField& body, const Scene& scene) {
  if (scene.simulation) body.at("recording").fail("is not allowed in a simulated scene");
  for (const char* key : {"copies", "motion", "material", "velocity"})
    if (body.has(key)) body.at(key).fail("is not allowed beside a \"recording\"");
}

// The recording has the vertices that the mesh has; what changes them would make the two differ.
mesh::LoadedMesh mesh_of(const text::JsonField& body, const RecordedFrames& frames,
                         const std::filesystem::path& folder) {
  if (!body.has("mesh") && frames.spec().numbered) return frames.first_mesh();
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
