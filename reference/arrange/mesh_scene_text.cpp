#include "reference/arrange/mesh_scene_text.h"

#include <nlohmann/json.hpp>

#include "core/types/semantics.h"
#include "reference/scene/json_value.h"

namespace contactcheck {
namespace {

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
  return "[" + shown(v.x()) + ", " + shown(v.y()) + ", " + shown(v.z()) + "]";
}

std::string mesh_text(const BodyPlan& body) {
  std::string out = "\"mesh\": {\"file\": " + quoted(body.path);
  if (body.size) out += ", \"size\": " + shown(*body.size);
  return out + ", \"center\": [0, 0, 0]}";
}

std::string position_text(const std::vector<BodyPlan::Key>& keys) {
  std::vector<std::string> lines;
  for (const BodyPlan::Key& key : keys)
    lines.push_back("[" + shown(key.time) + ", " + vector_text(key.position) + "]");
  return "\"position\": [" + joined_lines(lines, "\n          ") + "\n        ]";
}

std::string deformation_text(const BodyPlan::Deformation& d) {
  std::vector<std::string> keys;
  for (const auto& [time, value] : d.keys)
    keys.push_back("[" + shown(time) + ", " + shown(value) + "]");
  return "{" + quoted(d.kind) + ": {\"axis\": " + axis_name(d.axis) + ", " + quoted(d.amount) +
         ": [" + joined_lines(keys, " ").substr(1) + "]}}";
}

// Empty for a body that rests.
std::string motion_text(const BodyPlan& body) {
  std::vector<std::string> parts;
  if (!body.keys.empty()) parts.push_back(position_text(body.keys));
  if (body.turned_about)
    parts.push_back("\"spins\": [{\"axis\": " + axis_name(*body.turned_about) +
                    ", \"degrees\": 90}]");
  std::vector<std::string> deformers;
  for (const BodyPlan::Deformation& d : body.deformations) deformers.push_back(deformation_text(d));
  if (!deformers.empty())
    parts.push_back("\"deformers\": [" + joined_lines(deformers, "\n          ") + "\n        ]");
  if (parts.empty()) return "";
  parts.insert(parts.begin(), "\"ease\": \"smooth\"");
  return "\"motion\": {" + joined_lines(parts, "\n        ") + "\n      }";
}

std::string body_text(const BodyPlan& body, bool lattices) {
  std::vector<std::string> parts = {"\"name\": " + quoted(body.name), mesh_text(body)};
  if (lattices) parts.emplace_back(kLattice);
  if (const std::string motion = motion_text(body); !motion.empty()) parts.push_back(motion);
  return "{" + joined_lines(parts, "\n      ") + "\n    }";
}

}  // namespace

std::string scene_text(const ScenePlan& plan) {
  std::vector<std::string> bodies;
  for (const BodyPlan& body : plan.bodies) bodies.push_back(body_text(body, plan.lattices));
  const std::vector<std::string> parts = {
      "\"id\": " + quoted(plan.id),
      "\"title\": " + quoted(plan.title),
      "\"frames\": " + std::to_string(plan.frames),
      "\"duration\": " + shown(plan.duration),
      "\"levels\": " + nlohmann::json(level_names()).dump(),
      "\"bodies\": [" + joined_lines(bodies, "\n    ") + "\n  ]"};
  return "{" + joined_lines(parts, "\n  ") + "\n}\n";
}

}  // namespace contactcheck
