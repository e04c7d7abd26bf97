#include "tests/reference/report/sample_results.h"

#include "tests/support/files.h"

namespace contactcheck::test {

nlohmann::ordered_json sample_results() {
  return nlohmann::ordered_json::parse(text_of(CONTACTCHECK_REPORT_SAMPLES "/sample.json"));
}

nlohmann::ordered_json drawn_sample_results(std::size_t count) {
  nlohmann::ordered_json results = sample_results();
  auto scene = results["scenes"][0], run = results["runs"][0];
  for (const char* list : {"scenes", "runs", "disagreements"})
    results[list] = nlohmann::ordered_json::array();
  for (std::size_t i = 1; i <= count; ++i) {
    scene["id"] = run["scene"] = "drawn-7-" + std::to_string(i);
    scene["contact_frames"] = i % 2 == 0 ? 0 : 4;
    scene["drawn"] = {{"seed", 7},
                      {"number", i},
                      {"redrawn", 0},
                      {"happens", "touch"},
                      {"parameters", {{"triangles", 100.0}, {"speed", 0.5}}}};
    results["scenes"].push_back(scene);
    results["runs"].push_back(run);
  }
  return results;
}

}  // namespace contactcheck::test
