#include "reference/report/view_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/deform/recording.h"
#include "core/detect/ffd_model.h"
#include "core/types/check.h"
#include "core/types/input_file.h"
#include "reference/report/contacts_file.h"
#include "reference/report/view_buffers.h"

namespace contactcheck::report {
namespace {

// Below this share of the whole, a frame of its own is shown in a box of its own. At 1/64 a frame
// still has 18 of the 24 bits of a single, and a few pixels on the screen.
constexpr double kSmallestShare = 1.0 / 64.0;

Aabb box_of(const std::vector<std::vector<Vec3>>& bodies) {
  Aabb box;
  for (const std::vector<Vec3>& nodes : bodies)
    for (const Vec3& p : nodes) box.extend(p);
  return box;
}

// Halved first: the extent of a box as large as the doubles is no double.
double half_size(const Aabb& box) {
  return box.empty() ? 0.0 : (0.5 * box.hi - 0.5 * box.lo).maxCoeff();
}

Placement around(const Aabb& box) {
  const double half = half_size(box);
  if (!(half > 0.0)) return {box.empty() ? Vec3(Vec3::Zero()) : box.center(), 1.0};
  // The next power of two, within the doubles; dividing by it rounds nothing that a single keeps.
  const int exponent = std::min(std::ilogb(half) + 1, 1023);
  return {box.center(), std::ldexp(1.0, exponent)};
}

}  // namespace

std::vector<Placement> view_placements(const FrameNodes& frames) {
  Aabb whole;
  std::vector<Aabb> boxes;
  for (const auto& bodies : frames) {
    boxes.push_back(box_of(bodies));
    if (!boxes.back().empty()) whole.extend(boxes.back());
  }
  const auto small = [&](const Aabb& box) {
    return half_size(box) < kSmallestShare * half_size(whole);
  };
  if (std::none_of(boxes.begin(), boxes.end(), small)) return {around(whole)};
  std::vector<Placement> out;
  for (const Aabb& box : boxes) out.push_back(around(box));
  return out;
}

namespace {

// One scene in the view: its entry in the header, and its arrays.

struct SceneView {
  nlohmann::ordered_json header;  ///< without "base"; see view_bytes.h
  std::string arrays;             ///< its size is a multiple of 4
};

// A shape in the view: its triangles, and how its vertices, FFD-AABBs and bounding spheres follow
// from the nodes of a frame.

using Json = nlohmann::ordered_json;

template <std::size_t N>
std::vector<std::uint32_t> flat(const std::vector<std::array<std::uint32_t, N>>& rows) {
  std::vector<std::uint32_t> out;
  out.reserve(N * rows.size());
  for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}

// Boxes and spheres are those of ffd-aabb-sphere and ffd-aabb-sphere2 as the paper has them; both
// have the same sphere of level 1.
FfdModel paper_model(const BodyShape& shape) {
  FfdConfig config;
  config.sphere_levels = 2;
  return make_ffd_model(shape, config);
}

// The paper's reading has one piece per kept cell, in their order.
std::vector<Vec3> local_boxes(const FfdModel& model) {
  std::vector<Vec3> out;
  for (const FfdPiece& piece : model.pieces) {
    out.push_back(piece.local.lo);
    out.push_back(piece.local.hi);
  }
  return out;
}

Json spheres_view(const FfdModel& model, ViewBuffers& buffers) {
  std::vector<std::uint32_t> centers;
  for (const SphereNode& sphere : model.spheres.levels[1]) centers.push_back(sphere.center_node);
  Json radii = Json::array();
  for (double radius : model.rest_radius[1]) radii.push_back(radius);
  return {{"radius1", model.rest_radius[0][0]},
          {"centers2", buffers.ids(centers)},
          {"radii2", std::move(radii)}};
}

Json lattice_view(const BodyShape& shape, ViewBuffers& buffers) {
  const FfdModel model = paper_model(shape);
  Json out;
  out["cell_nodes"] = buffers.ids(flat(shape.lattice->cell_nodes));
  out["home"] = buffers.ids(shape.embedding.home_cell);
  out["local"] = buffers.points(shape.embedding.local);
  out["boxes"] = buffers.points(local_boxes(model));
  out["spheres"] = spheres_view(model, buffers);
  return out;
}

// The header's entry of the shape; see view_bytes.h.
Json shape_view(const BodyShape& shape, ViewBuffers& buffers) {
  Json out = {{"vertices", shape.mesh.vertices.size()}, {"nodes", shape.node_count()}};
  out["triangles"] = buffers.ids(flat(shape.mesh.triangles));
  if (shape.lattice) out["lattice"] = lattice_view(shape, buffers);
  return out;
}

using Json = nlohmann::ordered_json;

void add_bodies(const Recording& recording, ViewBuffers& buffers, Json& header) {
  Json shapes = Json::array(), bodies = Json::array();
  std::map<const BodyShape*, std::size_t> numbers;
  for (const Body& body : recording.bodies) {
    const auto [shape, fresh] = numbers.try_emplace(body.shape.get(), shapes.size());
    if (fresh) shapes.push_back(shape_view(*body.shape, buffers));
    bodies.push_back({{"name", body.name}, {"shape", shape->second}});
  }
  header["shapes"] = std::move(shapes);
  header["bodies"] = std::move(bodies);
}

Json to_json(const std::vector<Placement>& placements) {
  Json out = Json::array();
  for (const Placement& p : placements)
    out.push_back({{"origin", {p.origin.x(), p.origin.y(), p.origin.z()}}, {"scale", p.scale}});
  return out;
}

void add_frames(const Recording& recording, ViewBuffers& buffers, Json& header) {
  const std::vector<Placement> placements = view_placements(recording.frames);
  std::vector<Vec3> nodes;
  for (std::size_t f = 0; f < recording.frames.size(); ++f)
    for (const std::vector<Vec3>& body : recording.frames[f])
      for (const Vec3& p : body)
        nodes.push_back(placements[std::min(f, placements.size() - 1)].in_view(p));
  header["placements"] = to_json(placements);
  header["nodes"] = buffers.points(nodes);
}

// `contacts`: of read_contacts(), or null where the results name none.
SceneView scene_view(const Recording& recording, const Json& contacts) {
  ViewBuffers buffers;
  Json header = {{"id", recording.scene},
                 {"frames", recording.frames.size()},
                 {"time_step", recording.time_step}};
  add_bodies(recording, buffers, header);
  add_frames(recording, buffers, header);
  header["truth"] = contacts.is_null() ? Json::array() : contacts.at("truth");
  header["detectors"] = contacts.is_null() ? Json::array() : contacts.at("detectors");
  std::string arrays = buffers.bytes();
  arrays.resize((arrays.size() + 3) / 4 * 4);
  return {std::move(header), std::move(arrays)};
}

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kMagic = "CCVIEW1\n";

// A recording of this many times the limit is not even read: compressed, the view of one has been
// between a third and a seventh of it.
constexpr std::size_t kReadLimits = 10;

struct Candidate {
  std::string scene;
  SceneView view;
  std::string why;  ///< why it is left out; empty: it is not
};

std::string file_bytes(const fs::path& folder, const std::string& name) {
  std::ifstream in = open_input_file(folder / name, "\"" + name + "\"");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// Names come from files, which may hold any bytes.
std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::size_t compressed_size(const SceneView& view) {
  const std::string bytes = dumped(view.header) + view.arrays;
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int result =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_SPEED);
  return result == Z_OK ? size : bytes.size();
}

std::string too_large(std::size_t limit) {
  return "it does not fit into the " + std::to_string(limit / 1000) +
         " kB that the report has for 3D scenes; the smallest ones come first.";
}

// "" where no run of the scene names one.
std::string recording_of(const results::Index& index, const results::Scene& scene) {
  for (const results::Run* run : index.runs_of(scene.id))
    if (!run->recording.empty()) return run->recording;
  return "";
}

SceneView read_scene(const fs::path& folder, const std::string& recording_name,
                     const results::Scene& scene) {
  const Recording recording =
      read_recording_bytes(file_bytes(folder, recording_name), recording_name);
  if (recording.scene != scene.id)
    throw InputError("recording \"" + recording_name + "\": it is of the scene \"" +
                     recording.scene + "\".");
  if (scene.contacts.empty()) return scene_view(recording, nullptr);
  const std::string& name = scene.contacts;
  return scene_view(recording, read_contacts(file_bytes(folder, name), name, recording));
}

Candidate candidate(const fs::path& folder, const std::string& recording,
                    const results::Scene& scene, std::size_t limit) {
  Candidate out{scene.id, {}, ""};
  std::error_code error;  // is told by the read
  const std::uintmax_t size = fs::file_size(folder / recording, error);
  if (!error && size / kReadLimits > limit) {
    out.why = too_large(limit);
    return out;
  }
  try {
    out.view = read_scene(folder, recording, scene);
  } catch (const InputError& e) {
    out.why = e.what();
  }
  return out;
}

// The smallest scenes first: they are the most for the room.
void leave_out_beyond(std::size_t limit, std::vector<Candidate>& scenes) {
  std::vector<std::size_t> sizes, order(scenes.size());
  for (const Candidate& scene : scenes) sizes.push_back(compressed_size(scene.view));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  std::size_t used = 0;
  for (std::size_t i : order) {
    if (!scenes[i].why.empty()) continue;
    if (used + sizes[i] > limit)
      scenes[i] = {scenes[i].scene, {}, too_large(limit)};
    else
      used += sizes[i];
  }
}

std::string container(std::vector<Candidate>& scenes) {
  Json header = {
      {"schema", "contactcheck-view/1"}, {"left_out", Json::array()}, {"scenes", Json::array()}};
  std::string arrays;
  for (Candidate& scene : scenes) {
    if (!scene.why.empty()) {
      header["left_out"].push_back({{"scene", scene.scene}, {"why", scene.why}});
      continue;
    }
    scene.view.header["base"] = arrays.size();
    header["scenes"].push_back(std::move(scene.view.header));
    arrays += scene.view.arrays;
  }
  std::string text = dumped(header);
  text.resize((text.size() + kViewAlignment - 1) / kViewAlignment * kViewAlignment, ' ');
  std::string out(kMagic);
  for (int i = 0; i < 4; ++i) out += static_cast<char>(text.size() >> (8 * i) & 0xff);
  return out + text + arrays;
}

}  // namespace

std::string view_bytes(const results::Results& results, const fs::path& folder, std::size_t limit) {
  const results::Index index(results);
  std::vector<Candidate> scenes;
  for (const results::Scene& scene : results.scenes) {
    const std::string recording = recording_of(index, scene);
    if (!recording.empty()) scenes.push_back(candidate(folder, recording, scene, limit));
  }
  if (scenes.empty()) return "";
  leave_out_beyond(limit, scenes);
  return container(scenes);
}

}  // namespace contactcheck::report
