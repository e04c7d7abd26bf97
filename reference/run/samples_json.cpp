#include "reference/run/samples_json.h"

#include <nlohmann/json.hpp>

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

Json repeats_to_json(const std::vector<PhaseSample>& repeats) {
  Json out = Json::array();
  for (const PhaseSample& s : repeats) {
    out.push_back({s.map, s.update, s.query});
    if (s.reported) out.back().push_back(*s.reported);
  }
  return out;
}

std::vector<PhaseSample> repeats_from_json(const Json& json) {
  std::vector<PhaseSample> out;
  for (const Json& s : json) {
    out.push_back({s.at(0).get<double>(), s.at(1).get<double>(), s.at(2).get<double>()});
    if (s.size() > 3) out.back().reported = s.at(3).get<double>();
  }
  return out;
}

}  // namespace

nlohmann::ordered_json samples_to_json(const QuestionSamples& samples) {
  Json frames = Json::array();
  for (const auto& [frame, s] : samples.frames)
    frames.push_back(
        {{"frame", frame}, {"cold", repeats_to_json(s.cold)}, {"hot", repeats_to_json(s.hot)}});
  return {{"question", static_cast<int>(samples.question)},
          {"lazy_map", samples.lazy_map},
          {"frames", frames}};
}

QuestionSamples samples_from_json(const nlohmann::ordered_json& json) {
  QuestionSamples out;
  out.question = static_cast<Question>(json.at("question").get<int>());
  out.lazy_map = json.at("lazy_map").get<bool>();
  for (const Json& f : json.at("frames"))
    out.frames[f.at("frame").get<std::size_t>()] = {repeats_from_json(f.at("cold")),
                                                    repeats_from_json(f.at("hot"))};
  return out;
}

}  // namespace contactcheck
