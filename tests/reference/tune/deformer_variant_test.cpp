#include "reference/tune/simulated_models.h"

#include <gmock/gmock.h>

#include "core/dynamics/equivalent_material.h"
#include "tests/reference/scene/installed.h"
#include "tests/reference/tune/falling_scene.h"

namespace contactcheck::tune {
namespace {

using test::falling_scene;
using test::Scratch;
using test::sentence_of;
using ::testing::HasSubstr;

class DeformerVariant : public ::testing::Test {
 protected:
  scene::Scene load(const std::string& text) {
    return scene::load_scene(scratch_.write("falling.json", text));
  }

  Scratch scratch_;
};

TEST_F(DeformerVariant, HasTheEquivalentMaterialInEveryCopyAndLeavesWhatCannotBeMoved) {
  const scene::Scene scene = load(falling_scene());
  for (const DeformableModel model :
       {DeformableModel::kFiniteElements, DeformableModel::kShapeMatching}) {
    const auto file =
        write_deformer_variant(scratch_.folder() / "falling.json", model, scratch_.folder());
    const scene::Scene variant = scene::load_scene(file);
    EXPECT_EQ(variant.bodies.size(), 3u);
    const Material wanted =
        equivalent_material(*scene.simulation()->materials[0], model, *scene.bodies[0].shape);
    for (const std::size_t copy : {0, 1}) {
      const Material& made = *variant.simulation()->materials[copy];
      EXPECT_EQ(made.model, model);
      EXPECT_EQ(made.mass, 5.0);
      if (model == DeformableModel::kFiniteElements) {
        EXPECT_EQ(made.youngs_modulus, wanted.youngs_modulus);
        EXPECT_EQ(made.damping_time, 1.0 / 600.0);
      } else {
        EXPECT_EQ(made.relaxation_time, wanted.relaxation_time);
        EXPECT_GE(made.relaxation_time * variant.simulation()->settings.substeps, 1.0 / 60);
      }
    }
    EXPECT_FALSE(variant.simulation()->materials[2]);
    EXPECT_EQ(deformer_of(variant), variant.id.substr(std::string("falling-").size()));
  }
}

TEST_F(DeformerVariant, KnowsTheScenesOwn) {
  EXPECT_EQ(deformer_of(load(falling_scene())), "mass-spring");
  scene::Scene mixed = load(falling_scene());
  mixed.simulation()->materials[1]->model = DeformableModel::kShapeMatching;
  EXPECT_EQ(deformer_of(mixed), "mixed");
  scene::Scene still = load(falling_scene());
  for (auto& material : still.simulation()->materials) material.reset();
  EXPECT_THAT(sentence_of([&] { deformer_of(still); }), HasSubstr("none of its bodies"));
}

}  // namespace
}  // namespace contactcheck::tune
