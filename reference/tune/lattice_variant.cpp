#include "reference/tune/lattice_variant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/types/check.h"
#include "reference/run/frame_positions.h"
#include "reference/tune/scene_variant.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void scale_lattice(Json& body, double factor, const std::string& document) {
  if (!body.contains("lattice"))
    throw InputError(document + ": body \"" + body.value("name", "") +
                     "\" has no lattice, whose resolution could be another");
  Json& lattice = body["lattice"];
  if (lattice.contains("kept")) {
    const double kept = std::round(lattice["kept"].get<double>() * factor);
    lattice["kept"] = static_cast<std::size_t>(std::max(1.0, kept));
  } else if (lattice.contains("cells")) {
    for (Json& cells : lattice["cells"]) {
      const double along = std::round(cells.get<double>() * std::cbrt(factor));
      cells = static_cast<std::size_t>(std::max(1.0, along));
    }
  } else {
    throw InputError(document + ": the lattice of body \"" + body.value("name", "") +
                     "\" has neither \"kept\" nor \"cells\"");
  }
}

}  // namespace

fs::path write_lattice_variant(const fs::path& file, double factor, const fs::path& folder) {
  return write_scene_variant(
      file, fmt::format("lattice-{:g}", 100.0 * factor),
      [&](Json& scene, const std::string& document) {
        for (Json& body : scene["bodies"]) scale_lattice(body, factor, document);
      },
      folder);
}

double deviation(const Scene& scene, const Scene& variant) {
  const FramePositions first(scene), second(variant);
  double largest = 0.0;
  for (std::size_t f = 0; f < scene.frames; ++f)
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const auto &one = first[f].vertices[b], &other = second[f].vertices[b];
      if (one.size() != other.size())
        throw InputError("scene " + variant.id + " has other meshes than " + scene.id);
      for (std::size_t v = 0; v < one.size(); ++v)
        largest = std::max(largest, (one[v] - other[v]).norm());
    }
  return largest;
}

}  // namespace contactcheck
