// The folder of an export: the surfaces of bodies frame by frame, the certificates of these, the
// script that checks them, and an index with the CRC-32 of every file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/scene/frame_positions.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// The last file of an export: without it a folder is none.
struct ExportIndex {
  const char *name, *schema;
};
inline constexpr ExportIndex kFramesIndex{"scene.json", "contactcheck-certificates/1"},
    kStepsIndex{"steps.json", "contactcheck-step-certificates/1"};

class ExportFolder {
 public:
  /// Writes check.py and what check.py wants to know of bodies: `orders` has, per body, the order
  /// of its triangles that certificates speak of. `scene` must outlive it.
  /// @throws InputError, as all of this, if a file cannot be written
  ExportFolder(const scene::Scene& scene, const std::vector<std::vector<std::uint32_t>>& orders,
               const std::filesystem::path& folder);

  /// bodies/B/frame_N.ply: the vertices that were judged, to the bit.
  void write_surfaces(std::size_t frame, const scene::FramePosition& position);
  /// truth/KIND_N.json
  void write_truth(const std::string& kind, std::size_t number, const std::string& text);
  /// What the index says of bodies.
  const nlohmann::ordered_json& bodies() const { return bodies_; }
  /// Comes last. Adds `crc32`.
  void write_index(const ExportIndex& kind, nlohmann::ordered_json index);

 private:
  void make_folder(const std::string& name) const;
  void write(const std::string& name, const std::string& bytes);

  const scene::Scene& scene_;
  std::filesystem::path folder_;
  nlohmann::ordered_json bodies_, checksums_;
};

/// Writes check.py, which checks exports of frames, of steps and of queries.
/// @throws InputError if it cannot be written
void write_check_script(const std::filesystem::path& folder);

/// True if `folder` is a complete export of a scene's frames or steps.
bool is_export(const std::filesystem::path& folder);

/// One item a line.
template <typename Items, typename Text>
std::string list_text(const Items& items, const Text& text) {
  std::string out = "[";
  for (const auto& item : items) out += (out.size() > 1 ? ",\n  " : "\n  ") + text(item);
  return out + (items.empty() ? "]" : "\n ]");
}

}  // namespace contactcheck::judge
