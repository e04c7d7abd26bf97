#include "reference/scene/mesh_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/name_check.h"
#include "core/types/check.h"
#include "core/types/mesh_topology.h"
#include "core/types/semantics.h"
#include "core/types/vec3.h"
#include "reference/mesh/mesh_file.h"
#include "reference/oracle/closed_chain.h"
#include "reference/scene/approach.h"
#include "reference/text/file_text.h"
#include "reference/text/id_check.h"
#include "reference/text/json_field.h"
#include "reference/text/json_value.h"
#include "reference/text/lists.h"

namespace contactcheck::scene {
namespace {

// The text of a scene made of meshes, laid out as a person would write it.

/// One body of the scene to be written.
struct BodyPlan {
  struct Key {
    double time = 0.0;  ///< seconds
    Vec3 position = Vec3::Zero();
  };
  struct Deformation {
    std::string kind;    ///< "twist", "stretch" or "bend"
    std::string amount;  ///< its key of the curve: "degrees" or "amount"
    int axis = 0;
    std::vector<std::pair<double, double>> keys;  ///< time and value
    std::optional<int> toward;                    ///< of "bend": another axis
  };

  std::string name, path;
  bool repair = false;
  std::optional<double> size;  ///< metres
  std::vector<Key> keys;       ///< empty: it stays in the origin
  std::optional<int> turned_about;
  std::vector<Deformation> deformations;
};

struct ScenePlan {
  std::string id, title;
  std::size_t frames = 60;
  double duration = 2.0;  ///< seconds
  bool lattices = true;
  std::vector<BodyPlan> bodies;
};

// As many kept cells as the paper's objects have (97 to 224).
constexpr const char* kLattice = R"("lattice": {"kept": 150})";

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::string axis_name(int axis) { return std::string("\"") + "xyz"[axis] + "\""; }

std::string joined_lines(const std::vector<std::string>& parts, const std::string& indent) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : ",") + indent + part;
  return out;
}

std::string vector_text(const Vec3& v) {
  return "[" + text::shown(v.x()) + ", " + text::shown(v.y()) + ", " + text::shown(v.z()) + "]";
}

std::string body_text(const BodyPlan& body, bool lattices) {
  std::string mesh = "\"mesh\": {\"file\": " + quoted(body.path);
  if (body.repair) mesh += ", \"repair\": true";
  if (body.size) mesh += ", \"size\": " + text::shown(*body.size);
  std::vector<std::string> parts = {"\"name\": " + quoted(body.name),
                                    mesh + ", \"center\": [0, 0, 0]}"};
  if (lattices) parts.emplace_back(kLattice);

  std::vector<std::string> motion;
  if (!body.keys.empty()) {
    std::vector<std::string> keys;
    for (const BodyPlan::Key& key : body.keys)
      keys.push_back("[" + text::shown(key.time) + ", " + vector_text(key.position) + "]");
    motion.push_back("\"position\": [" + joined_lines(keys, "\n          ") + "\n        ]");
  }
  if (body.turned_about)
    motion.push_back("\"spins\": [{\"axis\": " + axis_name(*body.turned_about) +
                     ", \"degrees\": 90}]");
  std::vector<std::string> deformers;
  for (const BodyPlan::Deformation& d : body.deformations) {
    std::vector<std::string> keys;
    for (const auto& [time, value] : d.keys)
      keys.push_back("[" + text::shown(time) + ", " + text::shown(value) + "]");
    deformers.push_back("{" + quoted(d.kind) + ": {\"axis\": " + axis_name(d.axis) + ", " +
                        (d.toward ? "\"toward\": " + axis_name(*d.toward) + ", " : "") +
                        quoted(d.amount) + ": [" + joined_lines(keys, " ").substr(1) + "]}}");
  }
  if (!deformers.empty())
    motion.push_back("\"deformers\": [" + joined_lines(deformers, "\n          ") + "\n        ]");
  if (!motion.empty()) {
    motion.insert(motion.begin(), "\"ease\": \"smooth\"");
    parts.push_back("\"motion\": {" + joined_lines(motion, "\n        ") + "\n      }");
  }
  return "{" + joined_lines(parts, "\n      ") + "\n    }";
}

std::string scene_text(const ScenePlan& plan) {
  std::vector<std::string> bodies;
  for (const BodyPlan& body : plan.bodies) bodies.push_back(body_text(body, plan.lattices));
  // One body meets itself, several each other.
  nlohmann::json levels = nlohmann::json::array();
  for (const Level level : kLevels)
    if (!is_impact(level) && is_self(level) == (plan.bodies.size() == 1))
      levels.push_back(name_of(level));
  const std::vector<std::string> parts = {
      "\"id\": " + quoted(plan.id),
      "\"title\": " + quoted(plan.title),
      "\"frames\": " + std::to_string(plan.frames),
      "\"duration\": " + text::shown(plan.duration),
      "\"levels\": " + levels.dump(),
      "\"bodies\": [" + joined_lines(bodies, "\n    ") + "\n  ]"};
  return "{" + joined_lines(parts, "\n  ") + "\n}\n";
}

namespace fs = std::filesystem;

constexpr const char* kDocument = "the scene of these meshes";
constexpr double kLargest = 1e6;  // metres, of a mesh as it is in its file
// Shares of the smaller body's largest side: the gap out of contact, how much deeper press goes.
constexpr double kGap = 0.35, kDeeper = 0.1;
constexpr double kStretch = -0.15, kTwist = 30.0;  // at the deepest; degrees over the body
// Seconds: in contact, at the deepest, in contact, out of contact. (pass: a shorter stay.)
constexpr double kMeet = 0.8, kDeepest = 1.0, kPart = 1.2, kEnd = 2.0;
constexpr double kPassMeet = 0.9, kPassPart = 1.1;
// For one mesh, at the end, degrees: more than a ring, so that its ends intersect.
constexpr double kRing = 400.0, kTurn = 360.0;

std::string stem_of(const fs::path& mesh) {
  const std::string stem = mesh.stem().string();
  return name_fault(stem).empty() ? stem : "mesh";
}

std::string free_name(const std::string& wanted, const std::vector<BodyPlan>& bodies) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(bodies.begin(), bodies.end(),
                       [&](const BodyPlan& body) { return body.name == name; });
  };
  std::string name = wanted;
  for (std::size_t i = 2; taken(name); ++i) name = wanted + "-" + std::to_string(i);
  return name;
}

// What an id allows of it, and 64 characters in all.
std::string id_of(const MeshSceneRequest& request) {
  constexpr std::size_t kLongestPart = 20;
  std::string id;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, request.meshes.size()); ++i) {
    std::string part;
    for (const char c : stem_of(request.meshes[i]))
      if (part.size() < kLongestPart) part += text::is_id(std::string("a") + c) ? c : '_';
    id += part + "-";
  }
  if (request.meshes.size() > 2)
    id += "and-" + std::to_string(request.meshes.size() - 2) + "-more-";
  id += request.motion;
  return text::is_id(id) ? id : "m" + id;
}

void check(const MeshSceneRequest& request) {
  std::vector<std::string> names = motion_names();
  names.emplace_back("fold");
  if (std::find(names.begin(), names.end(), request.motion) == names.end())
    throw InputError("--motion: " + text::in_quotes(request.motion) + " is not one of " +
                     text::joined(names));
  if (request.meets_itself()) return;
  if (request.meshes.size() < 2)
    throw InputError("--mesh " + text::in_quotes(request.meshes.front().string()) +
                     ": one mesh meets nothing; name a second, the same once more, or --motion "
                     "fold or twist for contacts with itself");
  if (request.motion == "fold")
    throw InputError("--motion fold is for one mesh; " + std::to_string(request.meshes.size()) +
                     " are named");
  const std::size_t most = request.motion == "pass" ? 2 : MeshSceneRequest::kMostMeshes;
  if (request.meshes.size() > most)
    throw InputError("--mesh is given " + std::to_string(request.meshes.size()) +
                     " times; --motion " + request.motion + " is for at most " +
                     std::to_string(most));
}

double half_side(const TriangleMesh& mesh) { return 0.5 * bounding_box(mesh).extent().maxCoeff(); }

// As every other scene gets them: from the text of the scene, here without lattices and motions.
std::vector<TriangleMesh> load_meshes(ScenePlan plan, const fs::path& folder) {
  plan.lattices = false;
  const Scene scene = load_scene_text({scene_text(plan), kDocument, folder});
  std::vector<TriangleMesh> meshes;
  for (const Body& body : scene.bodies) {
    const double side = 2.0 * half_side(body.shape->mesh);
    const std::string what =
        std::string(kDocument) + ": the mesh of body " + text::in_quotes(body.name);
    if (!(side > 0.0)) throw InputError(what + " is a point and can meet nothing");
    if (!(side <= kLargest))
      throw InputError(what + " is " + text::shown(side) +
                       " m large; --size file allows at most 1000000 m");
    meshes.push_back(body.shape->mesh);
  }
  return meshes;
}

// The approaches of the second body and those after it, each along another direction.
std::vector<Approach> find_approaches(const ScenePlan& plan,
                                      const std::vector<TriangleMesh>& meshes) {
  std::vector<AxisDirection> free;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) free.push_back({axis, sign});
  std::vector<Approach> approaches;
  for (std::size_t i = 1; i < meshes.size(); ++i) {
    const auto found = find_approach(meshes[0], meshes[i], free);
    if (!found)
      throw InputError(std::string(kDocument) + ": no axis on which body " +
                       text::in_quotes(plan.bodies[i].name) + " comes leads into contact with " +
                       text::in_quotes(plan.bodies[0].name) +
                       "; a scene file of your own can place them");
    free.erase(std::find(free.begin(), free.end(), found->from));
    approaches.push_back(*found);
  }
  return approaches;
}

}  // namespace

const std::vector<std::string>& motion_names() {
  static const std::vector<std::string> names = {"approach", "press", "twist", "pass"};
  return names;
}

std::string mesh_path_from(const fs::path& folder, const fs::path& mesh) {
  std::error_code ignored, error;
  const fs::path to = fs::weakly_canonical(fs::absolute(mesh), error);
  if (error)
    throw InputError("--mesh " + text::in_quotes(mesh.string()) +
                     " cannot be followed to a file: " + error.message());
  const fs::path from = fs::weakly_canonical(fs::absolute(folder), ignored);
  return to.lexically_proximate(from).string();
}

std::vector<std::string> mesh_notes(const MeshSceneRequest& request) {
  constexpr double kDoubtful = 100.0;  // times as large: millimetres beside metres
  const auto digits = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, value < 1000.0 ? "%.3g" : "%.0f", value);
    return std::string(text);
  };
  std::vector<std::string> notes;
  std::pair<double, std::string> smallest, largest;
  for (const fs::path& file : request.meshes) {
    const std::string name = stem_of(file);
    mesh::LoadedMesh loaded =
        mesh::read_mesh_file(file, request.repair ? mesh::Folded::kFanned : mesh::Folded::kLeftOut);
    const double side = 2.0 * half_side(loaded.mesh);
    if (smallest.second.empty() || side < smallest.first) smallest = {side, name};
    if (largest.second.empty() || side > largest.first) largest = {side, name};
    std::string note = name + ": " + digits(side) + " m";
    if (request.size && *request.size != side)
      note += ", scaled to " + digits(*request.size) + " m (--size file keeps it)";
    if (std::find(notes.begin(), notes.end(), note) != notes.end()) continue;
    notes.push_back(note);
    const std::string defects = describe(analyse_topology(loaded.mesh));
    std::string dropped;
    const GivenVertices given = drop_unused_vertices(loaded.mesh);
    mesh::add_note_of_dropped(dropped, given.dropped);
    for (const std::string& found : {loaded.notes, dropped, defects})
      if (!found.empty()) notes.push_back(name + ": " + found);
    const auto chain = oracle::surface_chain(loaded.mesh.triangles, loaded.mesh.vertices);
    if (!chain.closed())
      notes.push_back(name +
                      ": containment not judged: " + oracle::open_reason(*chain.open, given));
  }
  if (largest.first > kDoubtful * smallest.first)
    notes.push_back("warning: " + largest.second + " is " + digits(largest.first / smallest.first) +
                    " times as large as " + smallest.second +
                    " in its file; do both have one unit of length?");
  return notes;
}

SceneText mesh_scene(const MeshSceneRequest& request, const fs::path& folder) {
  check(request);
  const std::string& motion = request.motion;
  ScenePlan plan;
  plan.id = id_of(request);
  for (const fs::path& mesh : request.meshes) {
    BodyPlan body;
    body.name = free_name(stem_of(mesh), plan.bodies);
    body.path = mesh_path_from(folder, mesh);
    body.repair = request.repair;
    body.size = request.size;
    plan.title += (plan.title.empty() ? "" : ", ") + body.name;
    plan.bodies.push_back(std::move(body));
  }
  plan.title += ": " + motion;
  const std::vector<TriangleMesh> meshes = load_meshes(plan, folder);
  if (request.meets_itself()) {
    int longest = 0, shortest = 0;
    const Vec3 extent = bounding_box(meshes[0]).extent();
    extent.maxCoeff(&longest);
    extent.minCoeff(&shortest);
    if (shortest == longest) shortest = (longest + 1) % 3;
    std::vector<BodyPlan::Deformation>& deformations = plan.bodies[0].deformations;
    if (motion == "twist")
      deformations.push_back({"twist", "degrees", longest, {{0.0, 0.0}, {kEnd, kTurn}}, {}});
    deformations.push_back({"bend", "degrees", longest, {{0.0, 0.0}, {kEnd, kRing}}, shortest});
    return {scene_text(plan), kDocument, folder};
  }
  const std::vector<Approach> approaches = find_approaches(plan, meshes);

  const auto deform = [&](int axis, double sign, BodyPlan& body) {
    if (motion == "press")
      body.deformations.push_back(
          {"stretch", "amount", axis, {{kMeet, 0.0}, {kDeepest, kStretch}, {kPart, 0.0}}, {}});
    if (motion == "twist")
      body.deformations.push_back(
          {"twist", "degrees", axis, {{kMeet, 0.0}, {kDeepest, sign * kTwist}, {kPart, 0.0}}, {}});
  };
  // With more than two bodies each one starts beyond all others, on its own side.
  double reach = 0.0;
  for (std::size_t i = 1; i < meshes.size() && meshes.size() > 2; ++i) {
    const Approach& approach = approaches[i - 1];
    Vec3 aside = approach.meeting;
    aside[approach.from.axis] = 0.0;
    reach = std::max(reach, half_side(meshes[i]) + aside.cwiseAbs().maxCoeff());
  }
  for (std::size_t i = 1; i < meshes.size(); ++i) {
    const Approach& approach = approaches[i - 1];
    const Vec3& meeting = approach.meeting;
    const double smaller_side = 2.0 * std::min(half_side(meshes[0]), half_side(meshes[i]));
    BodyPlan& body = plan.bodies[i];
    body.turned_about = approach.turned_about;
    if (motion == "pass") {
      // Across the direction of the approach, from beyond the resting body to beyond it.
      const int across = (approach.from.axis + 1) % 3;
      const double beyond = half_side(meshes[0]) + half_side(meshes[i]) +
                            std::abs(meeting[across]) + kGap * smaller_side;
      const Vec3 out = beyond * Vec3::Unit(across);
      body.keys = {
          {0.0, meeting + out}, {kPassMeet, meeting}, {kPassPart, meeting}, {kEnd, meeting - out}};
    } else {
      const Vec3 from = approach.from.vector();
      const double separated = approach.separated.dot(from), gap = kGap * smaller_side,
                   beyond = reach > 0.0 ? reach + half_side(meshes[i]) + gap : separated + gap;
      const Vec3 start =
          approach.separated + (std::max(separated + gap, beyond) - separated) * from;
      body.keys = {{0.0, start}, {kMeet, meeting}};
      if (motion == "press")
        body.keys.push_back({kDeepest, meeting - kDeeper * smaller_side * from});
      body.keys.push_back({kPart, meeting});
      body.keys.push_back({kEnd, start});
    }
    // Deformers come before the turn, which leads one axis of the body to that of the approach.
    int own = approach.from.axis;
    if (approach.turned_about && own != *approach.turned_about)
      own = 3 - own - *approach.turned_about;
    deform(own, 1.0, body);
  }
  deform(approaches.front().from.axis, -1.0, plan.bodies[0]);
  return {scene_text(plan), kDocument, folder};
}

}  // namespace contactcheck::scene
