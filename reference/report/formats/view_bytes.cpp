#include "reference/report/formats/view_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/deform/body.h"
#include "core/deform/recording.h"
#include "core/detect/ffd_model.h"
#include "core/types/check.h"
#include "core/types/input_file.h"
#include "reference/report/formats/contacts_file.h"
#include "reference/report/tables/scene_choice.h"

namespace contactcheck::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kMagic = "CCVIEW1\n";

// A frame that is smaller than this share of all frames is shown in its own box. At 1/64 a frame
// still has 18 of the 24 bits of a single, and a few pixels on the screen.
constexpr double kSmallestShare = 1.0 / 64.0;

// A recording that is larger than the limit by this factor is not read: the view of a recording,
// compressed, has been between a third and a seventh of it. With contacts, a part of it may do.
constexpr std::size_t kReadLimits = 10, kReadLimitsWithContacts = 50;

// Where not all scenes fit, a view that takes more than this part of the limit is cut to so many
// triangles near its contacts.
constexpr std::size_t kLargePart = 3, kKeptTriangles = 20'000;

// Halved before the difference: the extent of a box as large as the doubles is no double.
double half_size(const Aabb& box) {
  return box.empty() ? 0.0 : (0.5 * box.hi - 0.5 * box.lo).maxCoeff();
}

// A contact without elements names bodies; what a vertex alone lies in has no place of its own.
Json words_of(const NamedElements& named) {
  constexpr const char* kWords[] = {"triangle", "cell", "vertex", "edge", "body"};
  const bool bodies = named.first == Element::kNone;
  const auto word = [&](Element element) {
    return element == Element::kNone && !bodies ? "nothing"
                                                : kWords[static_cast<std::size_t>(element)];
  };
  return {word(named.first), word(named.second)};
}

Placement around(const Aabb& box) {
  const double half = half_size(box);
  if (!(half > 0.0)) return {box.empty() ? Vec3(Vec3::Zero()) : box.center(), 1.0};
  // The next power of two, within the doubles; dividing by it rounds nothing that a single keeps.
  const int exponent = std::min(std::ilogb(half) + 1, 1023);
  return {box.center(), std::ldexp(1.0, exponent)};
}

// Arrays of one scene. They are little-endian, and the JSON header names each by its reference.

// Arrays start at multiples of 4 bytes.
void align(std::string& bytes, char fill) { bytes.resize((bytes.size() + 3) / 4 * 4, fill); }

void append(std::string& bytes, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

// A reference to the array that is appended next.
Json reference(const char* type, std::size_t count, std::string& arrays) {
  align(arrays, '\0');
  return {{"type", type}, {"at", arrays.size()}, {"count", count}};
}

// Three singles for each point, rounded to nearest.
Json add_points(const std::vector<Vec3>& points, std::string& arrays) {
  Json out = reference("f32", 3 * points.size(), arrays);
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k)
      append(arrays, std::bit_cast<std::uint32_t>(static_cast<float>(p[k])), 4);
  return out;
}

// As u16 where all ids fit, as u32 elsewhere.
Json add_ids(const std::vector<std::uint32_t>& ids, std::string& arrays) {
  const bool small =
      std::all_of(ids.begin(), ids.end(), [](std::uint32_t id) { return id <= UINT16_MAX; });
  Json out = reference(small ? "u16" : "u32", ids.size(), arrays);
  for (const std::uint32_t id : ids) append(arrays, id, small ? 2 : 4);
  return out;
}

template <std::size_t N>
std::vector<std::uint32_t> flat(const std::vector<std::array<std::uint32_t, N>>& rows) {
  std::vector<std::uint32_t> out;
  out.reserve(N * rows.size());
  for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}

/// The parts of a shape that are kept, by ascending numbers.
struct KeptParts {
  std::vector<std::uint32_t> triangles, vertices;
};
using KeptShapes = std::map<const BodyShape*, KeptParts>;

// Triangles that share a vertex with what is kept are added, ring after ring, in all shapes alike.
KeptShapes kept_near_contacts(const Recording& recording, const Json& contacts) {
  std::map<const BodyShape*, std::vector<char>> near;  // per vertex
  for (const Body& body : recording.bodies)
    near[body.shape.get()].resize(body.shape->mesh.vertices.size());
  visit_elements(contacts, [&](std::int64_t body, std::int64_t element, Element kind) {
    const BodyShape& shape = *recording.bodies[static_cast<std::size_t>(body)].shape;
    const auto id = static_cast<std::size_t>(element);
    if (kind == Element::kVertex)
      near[&shape][*shape.given.vertex_of(static_cast<std::uint32_t>(id))] = 1;
    if (kind != Element::kTriangle) return;
    for (const std::uint32_t v : shape.mesh.triangles[id]) near[&shape][v] = 1;
  });
  // A shape without named elements starts with one vertex, so that its bodies have a place.
  for (auto& [shape, marks] : near)
    if (std::find(marks.begin(), marks.end(), 1) == marks.end() && !shape->mesh.triangles.empty())
      marks[shape->mesh.triangles[0][0]] = 1;

  KeptShapes out;
  for (std::size_t count = 0, before = 1; count < kKeptTriangles && count != before;) {
    before = count;
    count = 0;
    for (auto& [shape, marks] : near) {
      KeptParts& kept = out[shape] = {};
      const std::vector<Triangle>& triangles = shape->mesh.triangles;
      for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (std::any_of(triangles[t].begin(), triangles[t].end(),
                        [&](std::uint32_t v) { return marks[v] != 0; }))
          kept.triangles.push_back(t);
      for (const std::uint32_t t : kept.triangles)
        for (const std::uint32_t v : triangles[t]) marks[v] = 1;
      for (std::uint32_t v = 0; v < marks.size(); ++v)
        if (marks[v] != 0) kept.vertices.push_back(v);
      count += kept.triangles.size();
    }
  }
  return out;
}

template <typename T>
std::vector<T> picked(const std::vector<T>& all, const KeptParts* kept) {
  if (kept == nullptr) return all;
  std::vector<T> out;
  for (const std::uint32_t v : kept->vertices) out.push_back(all[v]);
  return out;
}

// The header's entry of a shape: its triangles, and how its vertices, FFD-AABBs and bounding
// spheres follow from the nodes of a frame. Boxes and spheres are those of ffd-aabb-sphere and
// ffd-aabb-sphere2 as the paper has them; both have the same sphere of level 1.
// `kept`: null for all of it.
Json shape_view(const BodyShape& shape, const KeptParts* kept, std::string& arrays) {
  const std::size_t vertices = kept ? kept->vertices.size() : shape.mesh.vertices.size();
  std::vector<Triangle> triangles = shape.mesh.triangles;
  if (kept != nullptr) {
    triangles.clear();
    const auto place = [&](std::uint32_t v) {
      const auto found = std::lower_bound(kept->vertices.begin(), kept->vertices.end(), v);
      return static_cast<std::uint32_t>(found - kept->vertices.begin());
    };
    for (const std::uint32_t t : kept->triangles) {
      const Triangle& whole = shape.mesh.triangles[t];
      triangles.push_back({place(whole[0]), place(whole[1]), place(whole[2])});
    }
  }
  Json out = {{"vertices", vertices}, {"nodes", shape.lattice ? shape.node_count() : vertices}};
  out["triangles"] = add_ids(flat(triangles), arrays);
  // Contacts name vertices by the numbers that they were given.
  if (kept != nullptr) {
    std::vector<std::uint32_t> numbers = kept->vertices;
    for (std::uint32_t& vertex : numbers) vertex = shape.given.number_of(vertex);
    out["kept"] = {{"triangles", add_ids(kept->triangles, arrays)},
                   {"vertices", add_ids(numbers, arrays)}};
  } else if (shape.given.dropped > 0) {
    out["numbers"] = add_ids(shape.given.numbers, arrays);
  }
  if (!shape.lattice) return out;
  FfdConfig config;
  config.sphere_levels = 2;
  const FfdModel model = make_ffd_model(shape, config);
  std::vector<Vec3> boxes;  // the paper has one piece per kept cell, in their order
  for (const FfdPiece& piece : model.pieces) {
    boxes.push_back(piece.local.lo);
    boxes.push_back(piece.local.hi);
  }
  std::vector<std::uint32_t> centers;
  for (const SphereNode& sphere : model.spheres.levels[1]) centers.push_back(sphere.center_node);
  Json radii = Json::array();
  for (const double radius : model.rest_radius[1]) radii.push_back(radius);
  Json& lattice = out["lattice"];
  lattice["cell_nodes"] = add_ids(flat(shape.lattice->cell_nodes), arrays);
  lattice["home"] = add_ids(picked(shape.embedding.home_cell, kept), arrays);
  lattice["local"] = add_points(picked(shape.embedding.local, kept), arrays);
  lattice["boxes"] = add_points(boxes, arrays);
  lattice["spheres"] = {{"radius1", model.rest_radius[0][0]},
                        {"centers2", add_ids(centers, arrays)},
                        {"radii2", std::move(radii)}};
  return out;
}

struct SceneView {
  Json header;         ///< without "base"; see view_bytes.h
  std::string arrays;  ///< its size is a multiple of 4
};

// `contacts`: of read_contacts(), or null where the results name none. `kept`: of every shape, or
// of none.
SceneView scene_view(const Recording& recording, const Json& contacts, const KeptShapes& kept) {
  const auto kept_of = [&](const BodyShape* shape) {
    const auto found = kept.find(shape);
    return found == kept.end() ? nullptr : &found->second;
  };
  std::string arrays;
  Json shapes = Json::array(), bodies = Json::array();
  std::map<const BodyShape*, std::size_t> numbers;
  for (const Body& body : recording.bodies) {
    const auto [shape, fresh] = numbers.try_emplace(body.shape.get(), shapes.size());
    if (fresh) shapes.push_back(shape_view(*body.shape, kept_of(body.shape.get()), arrays));
    bodies.push_back({{"name", body.name}, {"shape", shape->second}});
  }

  const std::vector<Placement> placements = view_placements(recording.frames);
  Json placed = Json::array();
  for (const Placement& p : placements)
    placed.push_back({{"origin", {p.origin.x(), p.origin.y(), p.origin.z()}}, {"scale", p.scale}});
  std::vector<Vec3> nodes;
  for (std::size_t f = 0; f < recording.frames.size(); ++f)
    for (std::size_t b = 0; b < recording.bodies.size(); ++b) {
      const BodyShape* shape = recording.bodies[b].shape.get();
      for (const Vec3& p :
           picked(recording.frames[f][b], shape->lattice ? nullptr : kept_of(shape)))
        nodes.push_back(placements[std::min(f, placements.size() - 1)].in_view(p));
    }

  Json header = {{"id", recording.scene},
                 {"frames", recording.frames.size()},
                 {"time_step", recording.time_step},
                 {"shapes", std::move(shapes)},
                 {"bodies", std::move(bodies)},
                 {"placements", std::move(placed)},
                 {"nodes", add_points(nodes, arrays)},
                 {"truth", contacts.is_null() ? Json::array() : contacts.at("truth")},
                 {"detectors", Json::array()}};
  if (!contacts.is_null())
    for (Json detector : contacts.at("detectors")) {
      const auto level = detector.at("level").get<std::string>();
      detector["elements"] = {{"missed", words_of(elements_at(level, true))},
                              {"spurious", words_of(elements_at(level, false))}};
      header["detectors"].push_back(std::move(detector));
    }
  align(arrays, '\0');
  return {std::move(header), std::move(arrays)};
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

struct Candidate {
  const results::Scene* scene = nullptr;
  std::string recording;  ///< its file
  SceneView view;
  std::size_t size = 0;  ///< compressed
  std::string why;       ///< why it is left out; empty: it is not
};

std::string too_large(std::size_t limit) {
  return "it does not fit into the " + std::to_string(limit / 1000) +
         " kB that the report has for 3D scenes; the smallest ones come first.";
}

std::string file_bytes(const fs::path& folder, const std::string& name) {
  std::ifstream in = open_input_file(folder / name, "\"" + name + "\"");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// `cut`: only what is near the contacts, which the results name.
void read_view(const fs::path& folder, std::size_t limit, bool cut, Candidate& out) {
  const std::string &name = out.recording, &contacts_name = out.scene->contacts;
  std::error_code error;  // the read reports it
  const std::uintmax_t size = fs::file_size(folder / name, error);
  if (!error && size / (contacts_name.empty() ? kReadLimits : kReadLimitsWithContacts) > limit) {
    out.why = too_large(limit);
    return;
  }
  try {
    const Recording recording = read_recording_bytes(file_bytes(folder, name), name);
    if (recording.scene != out.scene->id)
      throw InputError("recording \"" + name + "\": it is of the scene \"" + recording.scene +
                       "\".");
    Json contacts;
    if (!contacts_name.empty())
      contacts = read_contacts(file_bytes(folder, contacts_name), contacts_name, recording);
    out.view = scene_view(recording, contacts,
                          cut ? kept_near_contacts(recording, contacts) : KeptShapes());
    out.size = compressed_size(out.view);
  } catch (const InputError& e) {
    out.why = e.what();
  }
}

// Large scenes whole where all fit, else read again and cut; then the smallest first, so that as
// many as possible are kept.
void fit(const fs::path& folder, std::size_t limit, std::vector<Candidate>& scenes) {
  std::size_t whole = 0;
  for (const Candidate& scene : scenes) whole += scene.size;
  for (Candidate& scene : scenes)
    if (whole > limit && scene.size > limit / kLargePart && !scene.scene->contacts.empty())
      read_view(folder, limit, true, scene);
  std::vector<std::size_t> order(scenes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scenes[a].size < scenes[b].size; });
  std::size_t used = 0;
  for (const std::size_t i : order) {
    Candidate& scene = scenes[i];
    if (!scene.why.empty()) continue;
    if (used + scene.size > limit)
      scene.why = too_large(limit);
    else
      used += scene.size;
  }
}

std::string container(std::vector<Candidate>& scenes) {
  Json header = {
      {"schema", "contactcheck-view/1"}, {"left_out", Json::array()}, {"scenes", Json::array()}};
  std::string arrays;
  for (Candidate& scene : scenes) {
    if (!scene.why.empty()) {
      header["left_out"].push_back({{"scene", scene.scene->id}, {"why", scene.why}});
      continue;
    }
    scene.view.header["base"] = arrays.size();
    header["scenes"].push_back(std::move(scene.view.header));
    arrays += scene.view.arrays;
  }
  std::string text = dumped(header), out(kMagic);
  align(text, ' ');
  append(out, static_cast<std::uint32_t>(text.size()), 4);
  return out + text + arrays;
}

}  // namespace

std::vector<Placement> view_placements(const FrameNodes& frames) {
  Aabb whole;
  std::vector<Aabb> boxes;
  for (const auto& bodies : frames) {
    Aabb& box = boxes.emplace_back();
    for (const std::vector<Vec3>& nodes : bodies)
      for (const Vec3& p : nodes) box.extend(p);
    if (!box.empty()) whole.extend(box);
  }
  const auto small = [&](const Aabb& box) {
    return half_size(box) < kSmallestShare * half_size(whole);
  };
  if (std::none_of(boxes.begin(), boxes.end(), small)) return {around(whole)};
  std::vector<Placement> out;
  for (const Aabb& box : boxes) out.push_back(around(box));
  return out;
}

std::string view_bytes(const results::Results& results, const fs::path& folder, std::size_t limit) {
  const results::Index index(results);
  std::vector<Candidate> scenes;
  for (const results::Scene* scene : shown_scenes(results)) {
    const std::vector<const results::Run*>& runs = index.runs_of(scene->id);
    const auto recorded = std::find_if(
        runs.begin(), runs.end(), [](const results::Run* run) { return !run->recording.empty(); });
    if (recorded == runs.end()) continue;
    scenes.push_back({scene, (*recorded)->recording, {}, 0, ""});
    read_view(folder, limit, false, scenes.back());
  }
  if (scenes.empty()) return "";
  fit(folder, limit, scenes);
  return container(scenes);
}

std::string view_bytes(const Recording& recording, const Json& contacts, std::size_t limit) {
  std::vector<Candidate> scenes(1);
  Candidate& scene = scenes.front();
  for (const bool cut : {false, true}) {
    scene.view = scene_view(recording, contacts,
                            cut ? kept_near_contacts(recording, contacts) : KeptShapes());
    scene.size = compressed_size(scene.view);
    if (scene.size <= limit) return container(scenes);
  }
  return "";
}

}  // namespace contactcheck::report
