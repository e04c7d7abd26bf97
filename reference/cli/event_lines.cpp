#include "reference/cli/event_lines.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace contactcheck::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto kInterval = std::chrono::milliseconds(250);

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// Messages of libraries may hold any bytes; JSON takes UTF-8 alone.
std::string line_of(const Json& event) {
  return event.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string start_event(const suite::SuiteRequest& request) {
  Json scenes = Json::array();
  for (const suite::SceneTask& task : request.tasks)
    scenes.push_back({{"scene", task.id}, {"frames", task.frames}, {"detectors", task.detectors}});
  return line_of({{"event", "start"},
                  {"schema", "contactcheck-events/1"},
                  {"version", CONTACTCHECK_VERSION},
                  {"command", request.command},
                  {"out", request.out.string()},
                  {"scenes", std::move(scenes)}});
}

std::string progress_event(const suite::SuiteProgress& p, std::optional<double> seconds_left) {
  return line_of({{"event", "progress"},
                  {"scene", p.scene_id},
                  {"detector", p.detector.empty() ? Json(nullptr) : Json(p.detector)},
                  {"frame", or_null(p.frame)},
                  {"of", p.frames},
                  {"share", p.share},
                  {"seconds_left", or_null(seconds_left)}});
}

std::string scene_event(const suite::SceneEnd& end) {
  Json runs = Json::array();
  for (const results::Run& run : end.runs)
    runs.push_back(
        {{"detector", run.detector}, {"status", name_of(run.status)}, {"message", run.message}});
  return line_of({{"event", "scene"},
                  {"scene", end.scene_id},
                  {"resumed", end.resumed},
                  {"runs", std::move(runs)}});
}

std::string end_event(const std::filesystem::path& out, int exit_code) {
  return line_of({{"event", "end"},
                  {"out", out.string()},
                  {"results", (out / "results.json").string()},
                  {"exit_code", exit_code}});
}

void EventLines::print(const std::string& event) const {
  if (!wanted_) return;
  std::printf("%s\n", event.c_str());
  std::fflush(stdout);
}

void EventLines::progress(const suite::SuiteProgress& progress,
                          std::optional<double> seconds_left) {
  const auto now = std::chrono::steady_clock::now();
  if (progress.scene_id == last_scene_ && now - last_ < kInterval) return;
  last_scene_ = progress.scene_id;
  last_ = now;
  print(progress_event(progress, seconds_left));
}

}  // namespace contactcheck::cli
