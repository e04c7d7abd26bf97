#include "reference/view/view_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "core/types/check.h"
#include "core/types/input_file.h"
#include "reference/view/contacts_file.h"
#include "reference/view/scene_view.h"
#include "reference/view/view_buffers.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kMagic = "CCVIEW1\n";

// A recording of this many times the limit is not even read: compressed, the view of one has been
// between a third and a seventh of it.
constexpr std::size_t kReadLimits = 10;

struct Candidate {
  std::string scene;
  SceneView view;
  std::string why;  ///< why it is left out; empty: it is not
};

std::string file_bytes(const fs::path& folder, const std::string& name) {
  std::ifstream in = open_input_file(folder / name, "\"" + name + "\"");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// Names come from files, which may hold any bytes.
std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::size_t compressed_size(const SceneView& view) {
  const std::string bytes = dumped(view.header) + view.arrays;
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int result =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_SPEED);
  return result == Z_OK ? size : bytes.size();
}

std::string too_large(std::size_t limit) {
  return "it does not fit into the " + std::to_string(limit / 1000) +
         " kB that the report has for 3D scenes; the smallest ones come first.";
}

// "" where no run of the scene names one.
std::string recording_of(const results::Index& index, const results::Scene& scene) {
  for (const results::Run* run : index.runs_of(scene.id))
    if (!run->recording.empty()) return run->recording;
  return "";
}

SceneView read_scene(const fs::path& folder, const std::string& recording_name,
                     const results::Scene& scene) {
  const Recording recording =
      read_recording_bytes(file_bytes(folder, recording_name), recording_name);
  if (recording.scene != scene.id)
    throw InputError("recording \"" + recording_name + "\": it is of the scene \"" +
                     recording.scene + "\".");
  if (scene.contacts.empty()) return scene_view(recording, nullptr);
  const std::string& name = scene.contacts;
  return scene_view(recording, read_contacts(file_bytes(folder, name), name, recording));
}

Candidate candidate(const fs::path& folder, const std::string& recording,
                    const results::Scene& scene, std::size_t limit) {
  Candidate out{scene.id, {}, ""};
  std::error_code error;  // is told by the read
  const std::uintmax_t size = fs::file_size(folder / recording, error);
  if (!error && size / kReadLimits > limit) {
    out.why = too_large(limit);
    return out;
  }
  try {
    out.view = read_scene(folder, recording, scene);
  } catch (const InputError& e) {
    out.why = e.what();
  }
  return out;
}

// The smallest scenes first: they are the most for the room.
void leave_out_beyond(std::size_t limit, std::vector<Candidate>& scenes) {
  std::vector<std::size_t> sizes, order(scenes.size());
  for (const Candidate& scene : scenes) sizes.push_back(compressed_size(scene.view));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  std::size_t used = 0;
  for (std::size_t i : order) {
    if (!scenes[i].why.empty()) continue;
    if (used + sizes[i] > limit)
      scenes[i] = {scenes[i].scene, {}, too_large(limit)};
    else
      used += sizes[i];
  }
}

std::string container(std::vector<Candidate>& scenes) {
  Json header = {
      {"schema", "contactcheck-view/1"}, {"left_out", Json::array()}, {"scenes", Json::array()}};
  std::string arrays;
  for (Candidate& scene : scenes) {
    if (!scene.why.empty()) {
      header["left_out"].push_back({{"scene", scene.scene}, {"why", scene.why}});
      continue;
    }
    scene.view.header["base"] = arrays.size();
    header["scenes"].push_back(std::move(scene.view.header));
    arrays += scene.view.arrays;
  }
  std::string text = dumped(header);
  text.resize((text.size() + kViewAlignment - 1) / kViewAlignment * kViewAlignment, ' ');
  std::string out(kMagic);
  for (int i = 0; i < 4; ++i) out += static_cast<char>(text.size() >> (8 * i) & 0xff);
  return out + text + arrays;
}

}  // namespace

std::string view_bytes(const results::Results& results, const fs::path& folder, std::size_t limit) {
  const results::Index index(results);
  std::vector<Candidate> scenes;
  for (const results::Scene& scene : results.scenes) {
    const std::string recording = recording_of(index, scene);
    if (!recording.empty()) scenes.push_back(candidate(folder, recording, scene, limit));
  }
  if (scenes.empty()) return "";
  leave_out_beyond(limit, scenes);
  return container(scenes);
}

}  // namespace contactcheck
