#include "reference/judge/export_folder.h"

#include <fmt/format.h>
#include <zlib.h>

#include <span>
#include <system_error>

#include "check_script.h"
#include "core/deform/atomic_file.h"
#include "core/deform/byte_stream.h"
#include "core/types/check.h"
#include "core/types/mesh.h"
#include "reference/text/file_text.h"

namespace contactcheck::judge {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A binary little-endian PLY file: x, y, z as doubles in metres, faces as lists of three ints.
// `comment`, one line, says what it is.
std::string ply_bytes(std::span<const Vec3> vertices, const std::vector<Triangle>& triangles,
                      const std::string& comment) {
  ByteWriter out;
  out.raw("ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " +
          std::to_string(vertices.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
          std::to_string(triangles.size()) +
          "\nproperty list uchar int vertex_indices\nend_header\n");
  for (const Vec3& v : vertices)
    for (int axis = 0; axis < 3; ++axis) out.f64(v[axis]);
  for (const Triangle& t : triangles) {
    out.raw("\3");
    for (std::uint32_t corner : t) out.u32(corner);
  }
  return out.bytes();
}

// Names of bodies may contain anything; the number distinguishes those that end up alike.
std::string folder_of_body(std::size_t index, const std::string& name) {
  constexpr std::size_t kLongest = 60;
  std::string out = "bodies/" + std::to_string(index) + "-";
  for (char c : name.substr(0, kLongest)) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       c == '-' || c == '_';
    out += plain ? c : '_';
  }
  return out;
}

}  // namespace

ExportFolder::ExportFolder(const scene::Scene& scene,
                           const std::vector<std::vector<std::uint32_t>>& orders,
                           const fs::path& folder)
    : scene_(scene), folder_(folder), bodies_(Json::array()), checksums_(Json::object()) {
  make_folder("truth");
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    const std::string body_folder = folder_of_body(b, body.name);
    make_folder(body_folder);
    bodies_.push_back({{"name", body.name},
                       {"folder", body_folder},
                       {"vertices", body.shape->given_vertex_count()},
                       {"triangles", body.shape->mesh.triangles.size()},
                       {"welded", !body.shape->welded.empty()}});
    if (!body.shape->welded.empty())
      write(body_folder + "/welded.json",
            Json(body.shape->given.numbered(body.shape->welded)).dump() + "\n");
    write(body_folder + "/order.json", Json(orders[b]).dump() + "\n");
  }
  write_check_script(folder);
}

void ExportFolder::write_surfaces(std::size_t frame, const scene::FramePosition& position) {
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const BodyShape& shape = *scene_.bodies[b].shape;
    write(fmt::format("{}/frame_{:04}.ply", bodies_[b].at("folder").get<std::string>(), frame),
          ply_bytes(shape.given.spread(position.vertices[b]),
                    shape.given.numbered(shape.mesh.triangles),
                    "contactcheck export: vertices in metres"));
  }
}

void ExportFolder::write_truth(const std::string& kind, std::size_t number,
                               const std::string& text) {
  write(fmt::format("truth/{}_{:04}.json", kind, number), text);
}

void ExportFolder::write_index(const ExportIndex& kind, Json index) {
  index["crc32"] = checksums_;
  write_file_atomically(folder_ / kind.name, index.dump(1) + "\n");
}

void ExportFolder::make_folder(const std::string& name) const {
  std::error_code error;
  fs::create_directories(folder_ / name, error);
  if (error)
    throw InputError("cannot create " + text::in_quotes((folder_ / name).string()) + ": " +
                     error.message());
}

void ExportFolder::write(const std::string& name, const std::string& bytes) {
  write_file_atomically(folder_ / name, bytes);
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  checksums_[name] = fmt::format("{:08x}", crc32_z(crc32_z(0, nullptr, 0), data, bytes.size()));
}

void write_check_script(const fs::path& folder) {
  write_file_atomically(folder / "check.py", kCheckScript);
}

bool is_export(const fs::path& folder) {
  for (const ExportIndex& kind : {kFramesIndex, kStepsIndex}) {
    std::error_code ignored;
    if (!fs::is_regular_file(folder / kind.name, ignored)) continue;
    const Json index =
        Json::parse(text::read_file_bytes(folder / kind.name, "export"), nullptr, false);
    if (index.is_object() && index.value("schema", Json()) == kind.schema) return true;
  }
  return false;
}

}  // namespace contactcheck::judge
