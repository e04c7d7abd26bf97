#include "reference/view/scene_view.h"

#include <algorithm>
#include <map>

#include "reference/view/placement.h"
#include "reference/view/shape_view.h"
#include "reference/view/view_buffers.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

void add_bodies(const Recording& recording, ViewBuffers& buffers, Json& header) {
  Json shapes = Json::array(), bodies = Json::array();
  std::map<const BodyShape*, std::size_t> numbers;
  for (const Body& body : recording.bodies) {
    const auto [shape, fresh] = numbers.try_emplace(body.shape.get(), shapes.size());
    if (fresh) shapes.push_back(shape_view(*body.shape, buffers));
    bodies.push_back({{"name", body.name}, {"shape", shape->second}});
  }
  header["shapes"] = std::move(shapes);
  header["bodies"] = std::move(bodies);
}

Json to_json(const std::vector<Placement>& placements) {
  Json out = Json::array();
  for (const Placement& p : placements)
    out.push_back({{"origin", {p.origin.x(), p.origin.y(), p.origin.z()}}, {"scale", p.scale}});
  return out;
}

void add_frames(const Recording& recording, ViewBuffers& buffers, Json& header) {
  const std::vector<Placement> placements = view_placements(recording.frames);
  std::vector<Vec3> nodes;
  for (std::size_t f = 0; f < recording.frames.size(); ++f)
    for (const std::vector<Vec3>& body : recording.frames[f])
      for (const Vec3& p : body)
        nodes.push_back(placements[std::min(f, placements.size() - 1)].in_view(p));
  header["placements"] = to_json(placements);
  header["nodes"] = buffers.points(nodes);
}

}  // namespace

SceneView scene_view(const Recording& recording, const Json& contacts) {
  ViewBuffers buffers;
  Json header = {{"id", recording.scene},
                 {"frames", recording.frames.size()},
                 {"time_step", recording.time_step}};
  add_bodies(recording, buffers, header);
  add_frames(recording, buffers, header);
  header["truth"] = contacts.is_null() ? Json::array() : contacts.at("truth");
  header["detectors"] = contacts.is_null() ? Json::array() : contacts.at("detectors");
  std::string arrays = buffers.bytes();
  arrays.resize((arrays.size() + 3) / 4 * 4);
  return {std::move(header), std::move(arrays)};
}

}  // namespace contactcheck
