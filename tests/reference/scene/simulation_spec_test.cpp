// Every key of a simulated scene, and every refusal: the whole sentence.
#include "reference/scene/simulation_spec.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

using test::Scratch;
using test::sentence_of;

const std::string kSpring = R"({"model": "mass-spring", "mass": 10, "stiffness": 2000,
  "damping": 3, "restitution": 0.25, "friction": 0.5})";

const std::string kGoodSimulation = R"({
  "id": "s", "frames": 4, "levels": ["body"],
  "simulation": {"step": 0.01, "substeps": 7, "gravity": [0, 1, -2], "every": 3,
                 "ground": {"axis": "z", "height": -1.5, "restitution": 0.125, "friction": 0.75},
                 "driver": "ffd-grid"},
  "bodies": [
    {"name": "falls", "mesh": {"shape": "box"}, "lattice": {"cells": [1, 1, 1]},
     "motion": {"position": [0, 2, 0], "spins": [{"axis": "z", "degrees": 90}],
                "deformers": [{"bend": {"axis": "y", "toward": "x", "degrees": [[0, 20]]}}]},
     "material": )" + kSpring +
                                    R"(,
     "velocity": [1, -2, 3]},
    {"name": "rests", "mesh": {"shape": "sphere", "divisions": 1}}
  ]
})";

// The good scene with one text replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kGoodSimulation;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

Scene load_simulated(const std::string& text, std::size_t frames = 0) {
  const Scratch scratch;
  return load_scene(scratch.write("s.json", text), frames);
}

Material material_of(const std::string& text) {
  return *load_simulated(changed(kSpring, text)).simulation()->materials[0];
}

TEST(SimulationSpec, ReadsEveryKeyOfTheRoot) {
  const Scene scene = load_simulated(kGoodSimulation);
  ASSERT_NE(scene.simulation(), nullptr);
  const SimulationSettings& settings = scene.simulation()->settings;
  EXPECT_EQ(settings.time_step, 0.01);
  EXPECT_EQ(settings.substeps, 7u);
  EXPECT_EQ(settings.gravity, Vec3(0, 1, -2));
  ASSERT_TRUE(settings.ground.has_value());
  EXPECT_EQ(settings.ground->axis, 2);
  EXPECT_EQ(settings.ground->height, -1.5);
  EXPECT_EQ(settings.ground->restitution, 0.125);
  EXPECT_EQ(settings.ground->friction, 0.75);
  EXPECT_EQ(scene.simulation()->driver, "ffd-grid");
  EXPECT_EQ(scene.simulation()->every, 3u);
}

TEST(SimulationSpec, FillsInTheDefaultsOfTheRoot) {
  std::string text = kGoodSimulation;
  const std::size_t begin = text.find(R"({"step")"), end = text.find(R"("bodies")");
  const Scene scene = load_simulated(text.replace(begin, end - begin, "{}, "));
  const SimulationSettings& settings = scene.simulation()->settings;
  EXPECT_EQ(settings.time_step, 1.0 / 60);
  EXPECT_EQ(settings.substeps, 0u);
  EXPECT_EQ(settings.gravity, Vec3(0, -9.81, 0));
  EXPECT_FALSE(settings.ground.has_value());
  EXPECT_EQ(scene.simulation()->driver, "ffd-aabb-sphere2+tri");
  EXPECT_EQ(scene.simulation()->every, 1u);
  EXPECT_EQ(scene.time_step, 1.0 / 60);
}

TEST(SimulationSpec, EmptyGroundLiesLevelAtTheOrigin) {
  const Scene scene = load_simulated(
      changed(R"({"axis": "z", "height": -1.5, "restitution": 0.125, "friction": 0.75})", "{}"));
  ASSERT_TRUE(scene.simulation()->settings.ground.has_value());
  EXPECT_EQ(scene.simulation()->settings.ground->axis, 1);
  EXPECT_EQ(scene.simulation()->settings.ground->height, 0.0);
}

TEST(SimulationSpec, ReadsBodiesInTheirOrder) {
  const Scene scene = load_simulated(kGoodSimulation);
  ASSERT_EQ(scene.simulation()->materials.size(), 2u);
  ASSERT_EQ(scene.simulation()->velocities.size(), 2u);
  ASSERT_TRUE(scene.simulation()->materials[0].has_value());
  EXPECT_FALSE(scene.simulation()->materials[1].has_value());
  EXPECT_EQ(scene.simulation()->velocities[0], Vec3(1, -2, 3));
  EXPECT_EQ(scene.simulation()->velocities[1], Vec3(0, 0, 0));
}

TEST(SimulationSpec, ReadsMassSpring) {
  const Material material = material_of(kSpring);
  EXPECT_EQ(material.model, DeformableModel::kMassSpring);
  EXPECT_EQ(material.mass, 10.0);
  EXPECT_EQ(material.stiffness, 2000.0);
  EXPECT_EQ(material.damping, 3.0);
  EXPECT_EQ(material.restitution, 0.25);
  EXPECT_EQ(material.friction, 0.5);
}

TEST(SimulationSpec, ReadsFiniteElements) {
  const Material material =
      material_of(R"({"model": "finite-elements", "mass": 2, "youngs_modulus": 5e4,
                      "poisson_ratio": 0.45, "damping_time": 0.01})");
  EXPECT_EQ(material.model, DeformableModel::kFiniteElements);
  EXPECT_EQ(material.mass, 2.0);
  EXPECT_EQ(material.youngs_modulus, 5e4);
  EXPECT_EQ(material.poisson_ratio, 0.45);
  EXPECT_EQ(material.damping_time, 0.01);
}

TEST(SimulationSpec, ReadsShapeMatching) {
  const Material material = material_of(
      R"({"model": "shape-matching", "mass": 3, "relaxation_time": 0.125, "region": 0})");
  EXPECT_EQ(material.model, DeformableModel::kShapeMatching);
  EXPECT_EQ(material.mass, 3.0);
  EXPECT_EQ(material.relaxation_time, 0.125);
  EXPECT_EQ(material.region, 0u);
}

TEST(SimulationSpec, KeysLeftOutKeepTheMaterialsDefaults) {
  const Material usual;
  const Material material = material_of(R"({"model": "mass-spring", "mass": 5})");
  EXPECT_EQ(material.stiffness, usual.stiffness);
  EXPECT_EQ(material.damping, usual.damping);
  EXPECT_EQ(material.restitution, usual.restitution);
  EXPECT_EQ(material.friction, usual.friction);
}

TEST(SimulatedScene, FramesCountJudgedFramesAndStepsKeepTheirLength) {
  const Scene scene = load_simulated(kGoodSimulation), longer = load_simulated(kGoodSimulation, 9);
  EXPECT_EQ(scene.frames, 4u);
  EXPECT_DOUBLE_EQ(scene.time_step, 0.03);
  EXPECT_EQ(longer.frames, 9u);
  EXPECT_EQ(longer.time_step, scene.time_step);
  EXPECT_EQ(longer.simulation()->settings.time_step, 0.01);
}

TEST(SimulatedScene, HasAStartAndIsNotScripted) {
  const Scene scene = load_simulated(kGoodSimulation);
  EXPECT_FALSE(scene.scripted());
  EXPECT_TRUE(load_simulated(R"({"id": "s", "frames": 1, "duration": 1, "levels": ["body"],
                       "bodies": [{"name": "a", "mesh": {"shape": "box"}}]})")
                  .scripted());
  const std::vector<std::vector<Vec3>> start = scene.nodes_at(0.0);
  ASSERT_EQ(start.size(), 2u);
  // Turned and bent about its centre, which is 2 m up.
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : start[0]) centre += p / static_cast<double>(start[0].size());
  EXPECT_NEAR(centre.y(), 2.0, 0.2);
  EXPECT_EQ(start[1], scene.bodies[1].shape->mesh.vertices);
}

TEST(SimulatedScene, FramesComeFromTheRunAlone) {
  Scene scene = load_simulated(kGoodSimulation);
  scene.recorded.assign(scene.frames, scene.nodes_at(0.0));
  scene.recorded[2][0][0] = Vec3(7, 8, 9);
  EXPECT_EQ(scene.nodes_of_frame(2)[0][0], Vec3(7, 8, 9));
  EXPECT_FALSE(scene.scripted());
}

TEST(SimulatedSceneDeathTest, FramesBeforeTheRunAndLaterTimesAreABug) {
  const Scene scene = load_simulated(kGoodSimulation);
  EXPECT_DEATH((void)scene.nodes_of_frame(0), "a simulated scene has been run");
  EXPECT_DEATH((void)scene.nodes_at(0.5), "neither has times");
}

struct Refusal {
  std::string name, from, to, sentence;  // the sentence after: scene file "PATH":
};
void PrintTo(const Refusal& p, std::ostream* out) { *out << p.name; }

class BadSimulation : public ::testing::TestWithParam<Refusal> {};

TEST_P(BadSimulation, IsRefusedWithOneSentence) {
  const Scratch scratch;
  const auto file = scratch.write("s.json", changed(GetParam().from, GetParam().to));
  EXPECT_EQ(sentence_of([&] { load_scene(file); }),
            "scene file \"" + file.string() + "\": " + GetParam().sentence);
}

std::string name_of_refusal(const ::testing::TestParamInfo<Refusal>& test) {
  return test.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Root, BadSimulation,
    ::testing::Values(
        Refusal{"Duration", R"("frames": 4)", R"("frames": 4, "duration": 2)",
                "duration is not allowed beside \"simulation\", whose step and every give the "
                "time."},
        Refusal{"TimeStep", R"("frames": 4)", R"("frames": 4, "time_step": 2)",
                "time_step is not allowed beside \"simulation\", whose step and every give the "
                "time."},
        Refusal{"NoFrames", R"("frames": 4, )", "", "frames is missing."},
        Refusal{"UnknownKey", R"("substeps")", R"("substep")",
                "simulation.substep is not a known key; did you mean substeps? allowed here: step, "
                "substeps, gravity, ground, driver, every."},
        Refusal{"ZeroStep", R"("step": 0.01)", R"("step": 0)",
                "simulation.step is 0; it must be a number above 0 and at most 1."},
        Refusal{"LongStep", R"("step": 0.01)", R"("step": 1.5)",
                "simulation.step is 1.5; it must be a number above 0 and at most 1."},
        Refusal{"TooManySubsteps", R"("substeps": 7)", R"("substeps": 1001)",
                "simulation.substeps is 1001; it must be a whole number from 0 to 1000."},
        Refusal{"GravityAsNumber", "[0, 1, -2]", "-9.81",
                "simulation.gravity is -9.81; it must be an array of three numbers."},
        Refusal{"HugeGravity", "[0, 1, -2]", "[0, 1, -2000]",
                "simulation.gravity[2] is -2000; it must be a number of at least -1000 and at most "
                "1000."},
        Refusal{"ZeroEvery", R"("every": 3)", R"("every": 0)",
                "simulation.every is 0; it must be a whole number from 1 to 10000."},
        Refusal{"EmptyDriver", R"("driver": "ffd-grid")", R"("driver": "")",
                "simulation.driver is \"\"; it must be a text that is not empty."},
        Refusal{"GroundKey", R"("height")", R"("heigth")",
                "simulation.ground.heigth is not a known key; did you mean height? allowed here: "
                "axis, height, restitution, friction."},
        Refusal{"GroundAxis", R"("axis": "z", "height")", R"("axis": "up", "height")",
                "simulation.ground.axis is \"up\"; it must be one of x, y, z."},
        Refusal{"GroundHeight", R"("height": -1.5)", R"("height": "low")",
                "simulation.ground.height is \"low\"; it must be a number of at least -1e+06 and "
                "at most 1e+06."},
        Refusal{"GroundRestitution", R"("restitution": 0.125)", R"("restitution": 1.5)",
                "simulation.ground.restitution is 1.5; it must be a number of at least 0 and at "
                "most 1."},
        Refusal{"GroundFriction", R"("friction": 0.75)", R"("friction": -1)",
                "simulation.ground.friction is -1; it must be a number of at least 0 and at most "
                "10."}),
    name_of_refusal);

INSTANTIATE_TEST_SUITE_P(
    Bodies, BadSimulation,
    ::testing::Values(
        Refusal{"NoLattice", R"(, "lattice": {"cells": [1, 1, 1]})", "",
                "bodies[0].material needs a lattice; this body has none."},
        Refusal{"VelocityWithoutMaterial", R"({"shape": "sphere", "divisions": 1})",
                R"({"shape": "sphere"}, "velocity": [0, 0, 0])",
                "bodies[1].velocity needs a material; this body has none."},
        Refusal{"HugeVelocity", "[1, -2, 3]", "[1, -2000, 3]",
                "bodies[0].velocity[1] is -2000; it must be a number of at least -1000 and at most "
                "1000."},
        Refusal{"PositionOverTime", R"("position": [0, 2, 0])",
                R"("position": [[0, [0, 2, 0]], [1, [0, 0, 0]]])",
                "bodies[0].motion.position has keys over time; in a simulated scene a motion gives "
                "the pose at time 0 alone."},
        Refusal{"SpinOverTime", R"("degrees": 90)", R"("degrees": [[0, 90], [1, 0]])",
                "bodies[0].motion.spins[0] has keys over time; in a simulated scene a motion gives "
                "the pose at time 0 alone."},
        Refusal{"BendOverTime", R"([[0, 20]])", R"([[0, 20], [1, 0]])",
                "bodies[0].motion.deformers[0] has keys over time; in a simulated scene a motion "
                "gives the pose at time 0 alone."},
        Refusal{"TwistOverTime", R"({"bend": {"axis": "y", "toward": "x", "degrees": [[0, 20]]}})",
                R"({"twist": {"axis": "y", "degrees": [[0, 20], [1, 0]]}})",
                "bodies[0].motion.deformers[0] has keys over time; in a simulated scene a motion "
                "gives the pose at time 0 alone."},
        Refusal{"TaperOverTime", R"({"bend": {"axis": "y", "toward": "x", "degrees": [[0, 20]]}})",
                R"({"taper": {"axis": "y", "amount": [[0, 0.2], [1, 0]]}})",
                "bodies[0].motion.deformers[0] has keys over time; in a simulated scene a motion "
                "gives the pose at time 0 alone."},
        Refusal{"StretchOverTime",
                R"({"bend": {"axis": "y", "toward": "x", "degrees": [[0, 20]]}})",
                R"({"stretch": {"axis": "y", "amount": [[0, 0.2], [1, 0]]}})",
                "bodies[0].motion.deformers[0] has keys over time; in a simulated scene a motion "
                "gives the pose at time 0 alone."},
        Refusal{"NodesOverTime", R"({"bend": {"axis": "y", "toward": "x", "degrees": [[0, 20]]}})",
                R"({"nodes": [[0, []], [1, []]]})",
                "bodies[0].motion.deformers[0] has keys over time; in a simulated scene a motion "
                "gives the pose at time 0 alone."},
        Refusal{"RestingBodyMoves", R"({"shape": "sphere", "divisions": 1})",
                R"({"shape": "sphere"}, "motion": {"position": [[0, [0, 2, 0]], [1, [0, 0, 0]]]})",
                "bodies[1].motion.position has keys over time; in a simulated scene a motion gives "
                "the pose at time 0 alone."}),
    name_of_refusal);

// A material that is refused, with the sentence after: bodies[0].material
Refusal material(const std::string& name, const std::string& text, const std::string& sentence) {
  return {name, kSpring, text, "bodies[0].material" + sentence};
}

INSTANTIATE_TEST_SUITE_P(
    Materials, BadSimulation,
    ::testing::Values(
        material("NotAnObject", "5", " is 5; it must be an object."),
        material("NoModel", R"({"mass": 1})", ".model is missing."),
        material("NoMass", R"({"model": "mass-spring"})", ".mass is missing."),
        material("UnknownModel", R"({"model": "jelly", "mass": 1})",
                 ".model is \"jelly\"; it must be one of mass-spring, finite-elements, "
                 "shape-matching."),
        material("SpringsWithKeyOfElements",
                 R"({"model": "mass-spring", "mass": 1, "poisson_ratio": 0.3})",
                 ".poisson_ratio is not a known key; allowed here: model, mass, restitution, "
                 "friction, stiffness, damping."),
        material("ElementsWithKeyOfSprings",
                 R"({"model": "finite-elements", "mass": 1, "stiffness": 100})",
                 ".stiffness is not a known key; allowed here: model, mass, restitution, friction, "
                 "youngs_modulus, poisson_ratio, damping_time."),
        material("ShapesWithKeyOfElements",
                 R"({"model": "shape-matching", "mass": 1, "youngs_modulus": 100})",
                 ".youngs_modulus is not a known key; allowed here: model, mass, restitution, "
                 "friction, relaxation_time, region.")),
    name_of_refusal);

// A value that is refused: of "mass" and "KEY" for a model, with what is allowed.
Refusal value(const std::string& name, const std::string& model, const std::string& key,
              const std::string& shown, const std::string& allowed) {
  return material(name,
                  R"({"model": ")" + model + R"(", "mass": )" + (key == "mass" ? shown : "1") +
                      (key == "mass" ? "" : R"(, ")" + key + R"(": )" + shown) + "}",
                  "." + key + " is " + shown + "; it must be " + allowed + ".");
}

INSTANTIATE_TEST_SUITE_P(
    Values, BadSimulation,
    ::testing::Values(
        value("ZeroMass", "mass-spring", "mass", "0", "a number above 0 and at most 1e+09"),
        value("NegativeStiffness", "mass-spring", "stiffness", "-1",
              "a number above 0 and at most 1e+12"),
        value("NegativeDamping", "mass-spring", "damping", "-1",
              "a number of at least 0 and at most 1e+09"),
        value("Restitution", "mass-spring", "restitution", "1.5",
              "a number of at least 0 and at most 1"),
        value("Friction", "mass-spring", "friction", "-0.5",
              "a number of at least 0 and at most 10"),
        value("ZeroModulus", "finite-elements", "youngs_modulus", "0",
              "a number above 0 and at most 1e+12"),
        value("Incompressible", "finite-elements", "poisson_ratio", "0.5",
              "a number of at least 0 and below 0.5"),
        value("DampingTime", "finite-elements", "damping_time", "-1",
              "a number of at least 0 and at most 1"),
        value("ZeroRelaxation", "shape-matching", "relaxation_time", "0",
              "a number above 0 and at most 100"),
        value("HalfRegion", "shape-matching", "region", "0.5", "a whole number from 0 to 128")),
    name_of_refusal);

TEST(SimulationKeys, NeedASimulatedScene) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& key) {
    const auto file = scratch.write("s.json", R"({"id": "s", "frames": 1, "duration": 1,
      "levels": ["body"], "bodies": [{"name": "a", "mesh": {"shape": "box"}, )" +
                                                  key + "}]}");
    const std::string sentence = sentence_of([&] { load_scene(file); });
    return sentence.substr(std::min(sentence.size(), file.string().size() + 15));
  };
  EXPECT_EQ(refusal(R"("material": {})"),
            "bodies[0].material needs \"simulation\" in the scene; there is none.");
  EXPECT_EQ(refusal(R"("velocity": [0, 0, 0])"),
            "bodies[0].velocity needs \"simulation\" in the scene; there is none.");
}

}  // namespace
}  // namespace contactcheck::scene
