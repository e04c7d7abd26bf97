#include "reference/scene/lattice_spec.h"

#include <string>
#include <utility>

namespace contactcheck::scene {
namespace {

// More would take minutes to embed and is beyond any lattice of the paper (97 to 224 cells kept).
constexpr std::size_t kMostCellsPerAxis = 128;
constexpr std::size_t kMostKept = 10'000;
constexpr double kPadding = 0.02;
constexpr double kSmoothing = 1e-6;
constexpr text::NumberRange kSmoothingRange = {1e-12, false, 1.0, false};

// Said aloud in the file, because it changes what all detectors are given.
void parse_fit(const text::JsonField& field, LatticeSpec& spec) {
  if (!field.has("fit"))
    field.fail("has no \"fit\"; beside a recording it must be true: the lattice is fitted to it");
  const text::JsonField fit = field.at("fit");
  if (!fit.is(text::JsonValue::Kind::kBool) || !fit.value().boolean)
    fit.refuse("true: beside a recording a lattice is fitted to it");
  spec.fit = true;
  spec.smoothing =
      field.has("smoothing") ? field.at("smoothing").number(kSmoothingRange) : kSmoothing;
}

}  // namespace

LatticeSpec parse_lattice_spec(const text::JsonField& field, bool recorded) {
  LatticeSpec spec;
  if (field.is(text::JsonValue::Kind::kNull)) return spec;
  std::vector<std::string> keys = {"cells", "kept", "padding"};
  if (recorded) keys.insert(keys.end(), {"fit", "smoothing"});
  field.only_keys(keys);
  if (recorded) parse_fit(field, spec);
  if (field.exactly_one_of({"cells", "kept"}) == "cells") {
    spec.kind = LatticeSpec::Kind::kCells;
    const text::JsonField cells = field.at("cells");
    if (!cells.is(text::JsonValue::Kind::kArray) || cells.value().items.size() != 3) {
      cells.refuse("an array of three whole numbers");
    }
    const std::vector<text::JsonField> parts = cells.items();
    for (std::size_t k = 0; k < 3; ++k) spec.cells[k] = parts[k].whole(1, kMostCellsPerAxis);
  } else {
    spec.kind = LatticeSpec::Kind::kKept;
    spec.kept = field.at("kept").whole(1, kMostKept);
  }
  spec.padding =
      field.has("padding") ? field.at("padding").number({0.0, false, 1.0, false}) : kPadding;
  return spec;
}

std::shared_ptr<const BodyShape> build_shape(TriangleMesh mesh, const LatticeSpec& spec) {
  if (spec.kind == LatticeSpec::Kind::kNone) return make_bare_shape(std::move(mesh));
  Resolution resolution;
  if (spec.kind == LatticeSpec::Kind::kCells) {
    resolution = {static_cast<std::uint32_t>(spec.cells[0]),
                  static_cast<std::uint32_t>(spec.cells[1]),
                  static_cast<std::uint32_t>(spec.cells[2])};
  } else {
    resolution = resolution_for_cells(mesh, spec.kept, spec.padding);
  }
  return make_shape(std::move(mesh), resolution, spec.padding);
}

}  // namespace contactcheck::scene
