#include "reference/scene/simulation_spec.h"

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "core/types/check.h"

namespace contactcheck::scene {
namespace {

// The paper moves all of its scenes by its two-level method; this is the one that also answers
// exactly.
constexpr const char* kUsualDriver = "ffd-aabb-sphere2+tri";

// Steps above a second are typing errors: a body falls 5 m within one.
constexpr text::NumberRange kStep = {0.0, true, 1.0, false};  // seconds
constexpr std::size_t kMostSubsteps = 1000;
constexpr std::size_t kMostEvery = 10'000;
// A hundred times the earth's.
constexpr text::NumberRange kAcceleration = {-1000.0, false, 1000.0, false};  // m/s^2
constexpr text::NumberRange kHeight = {-1e6, false, 1e6, false};  // metres, as positions
// Faster, a body crosses its own size within a step of 1/60 s many times over.
constexpr text::NumberRange kSpeed = {-1000.0, false, 1000.0, false};  // m/s, per axis

constexpr text::NumberRange kMass = {0.0, true, 1e9, false};            // kg
constexpr text::NumberRange kStiffness = {0.0, true, 1e12, false};      // N/m
constexpr text::NumberRange kDamping = {0.0, false, 1e9, false};        // N s/m
constexpr text::NumberRange kYoungsModulus = {0.0, true, 1e12, false};  // Pa; diamond: 1.2e12
constexpr text::NumberRange kPoissonRatio = {0.0, false, 0.5,
                                             true};  // 0.5: no volume change, singular
constexpr text::NumberRange kDampingTime = {0.0, false, 1.0, false};  // seconds
constexpr text::NumberRange kRelaxation = {0.0, true, 100.0, false};  // seconds
constexpr std::size_t kLargestRegion = 128;  // cells per axis of any lattice
constexpr text::NumberRange kRestitution = {0.0, false, 1.0, false};  // above 1 would make energy
constexpr text::NumberRange kFriction = {0.0, false, 10.0, false};    // rubber reaches 2

// A key that may be left out keeps its default.
void read(const text::JsonField& field, const char* key, const text::NumberRange& range,
          double& value) {
  if (field.has(key)) value = field.at(key).number(range);
}

Ground parse_ground(const text::JsonField& field) {
  field.only_keys({"axis", "height", "restitution", "friction"});
  Ground ground;
  if (field.has("axis")) ground.axis = field.at("axis").one_of({"x", "y", "z"})[0] - 'x';
  read(field, "height", kHeight, ground.height);
  read(field, "restitution", kRestitution, ground.restitution);
  read(field, "friction", kFriction, ground.friction);
  return ground;
}

struct ModelRule {
  const char* name;
  DeformableModel model;
  std::vector<std::string> own_keys;
};

const std::vector<ModelRule>& model_rules() {
  static const std::vector<ModelRule> rules = {
      {"mass-spring", DeformableModel::kMassSpring, {"stiffness", "damping"}},
      {"finite-elements",
       DeformableModel::kFiniteElements,
       {"youngs_modulus", "poisson_ratio", "damping_time"}},
      {"shape-matching", DeformableModel::kShapeMatching, {"relaxation_time", "region"}}};
  return rules;
}

const ModelRule& rule_named(std::string_view name) {
  const auto rule = std::find_if(model_rules().begin(), model_rules().end(),
                                 [&](const ModelRule& r) { return name == r.name; });
  CONTACTCHECK_INVARIANT(rule != model_rules().end(), "only known models are asked for");
  return *rule;
}

bool goes_on(const Curve& curve) { return curve.keys.size() > 1; }

bool goes_on(const Deformer& deformer) {
  struct Visitor {
    bool operator()(const Twist& twist) const { return goes_on(twist.angle); }
    bool operator()(const Bend& bend) const { return goes_on(bend.angle); }
    bool operator()(const Taper& taper) const { return goes_on(taper.amount); }
    bool operator()(const Stretch& stretch) const { return goes_on(stretch.amount); }
    bool operator()(const NodeKeys& nodes) const { return nodes.keys.size() > 1; }
  };
  return std::visit(Visitor(), deformer);
}

[[noreturn]] void refuse_keys(const text::JsonField& field) {
  field.fail("has keys over time; in a simulated scene a motion gives the pose at time 0 alone");
}

void require_pose(const text::JsonField& field, const Motion& motion) {
  if (goes_on(motion.path.position[0])) refuse_keys(field.at("position"));
  for (std::size_t i = 0; i < motion.path.spins.size(); ++i) {
    if (goes_on(motion.path.spins[i].angle)) refuse_keys(field.at("spins").items()[i]);
  }
  for (std::size_t i = 0; i < motion.deformers.size(); ++i) {
    if (goes_on(motion.deformers[i])) refuse_keys(field.at("deformers").items()[i]);
  }
}

}  // namespace

const char* name_of(DeformableModel model) {
  const auto rule = std::find_if(model_rules().begin(), model_rules().end(),
                                 [&](const ModelRule& r) { return model == r.model; });
  CONTACTCHECK_INVARIANT(rule != model_rules().end(), "every model has a rule");
  return rule->name;
}

DeformableModel model_named(std::string_view name) { return rule_named(name).model; }

const std::vector<std::string>& model_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const ModelRule& rule : model_rules()) all.emplace_back(rule.name);
    return all;
  }();
  return names;
}

SimulationSpec parse_simulation(const text::JsonField& field) {
  field.only_keys({"step", "substeps", "gravity", "ground", "driver", "every"});
  SimulationSpec spec;
  read(field, "step", kStep, spec.settings.time_step);
  if (field.has("substeps")) {
    spec.settings.substeps =
        static_cast<std::uint32_t>(field.at("substeps").whole(0, kMostSubsteps));
  }
  if (field.has("gravity")) spec.settings.gravity = field.at("gravity").vector(kAcceleration);
  if (field.has("ground")) spec.settings.ground = parse_ground(field.at("ground"));
  spec.driver = field.has("driver") ? field.at("driver").text() : kUsualDriver;
  if (field.has("every")) spec.every = field.at("every").whole(1, kMostEvery);
  return spec;
}

Material parse_material(const text::JsonField& field) {
  const ModelRule& rule = rule_named(field.at("model").one_of(model_names()));
  std::vector<std::string> keys = {"model", "mass", "restitution", "friction"};
  keys.insert(keys.end(), rule.own_keys.begin(), rule.own_keys.end());
  field.only_keys(keys);
  Material material;
  material.model = rule.model;
  material.mass = field.at("mass").number(kMass);
  // Keys of the other models are not here: only_keys refused them.
  read(field, "stiffness", kStiffness, material.stiffness);
  read(field, "damping", kDamping, material.damping);
  read(field, "youngs_modulus", kYoungsModulus, material.youngs_modulus);
  read(field, "poisson_ratio", kPoissonRatio, material.poisson_ratio);
  read(field, "damping_time", kDampingTime, material.damping_time);
  read(field, "relaxation_time", kRelaxation, material.relaxation_time);
  if (field.has("region")) {
    material.region = static_cast<std::uint32_t>(field.at("region").whole(0, kLargestRegion));
  }
  read(field, "restitution", kRestitution, material.restitution);
  read(field, "friction", kFriction, material.friction);
  return material;
}

void add_simulated_body(const text::JsonField& body, const BodyShape& shape, const Motion& motion,
                        SimulationSpec& simulation) {
  if (body.has("motion")) require_pose(body.at("motion"), motion);
  std::optional<Material> material;
  if (body.has("material")) {
    material = parse_material(body.at("material"));
    if (!shape.lattice) body.at("material").fail("needs a lattice; this body has none");
  }
  Vec3 velocity = Vec3::Zero();
  if (body.has("velocity")) {
    velocity = body.at("velocity").vector(kSpeed);
    if (!material) body.at("velocity").fail("needs a material; this body has none");
  }
  simulation.materials.push_back(material);
  simulation.velocities.push_back(velocity);
}

void require_no_simulation_keys(const text::JsonField& body) {
  for (const char* key : {"material", "velocity"}) {
    if (body.has(key)) body.at(key).fail("needs \"simulation\" in the scene; there is none");
  }
}

}  // namespace contactcheck::scene
