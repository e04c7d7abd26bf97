#include "reference/check/checked_frame.h"

#include <utility>

namespace contactcheck::check {
namespace {

Json pairs_json(const std::vector<BodyPair>& pairs) {
  Json out = Json::array();
  for (const BodyPair& pair : pairs) out.push_back({pair.a, pair.b});
  return out;
}

std::vector<BodyPair> pairs_of(const Json& json) {
  std::vector<BodyPair> out;
  for (const Json& pair : json)
    out.push_back({pair.at(0).get<std::uint32_t>(), pair.at(1).get<std::uint32_t>()});
  return out;
}

Json found_json(const FoundContacts& found) {
  if (found.empty()) return nullptr;
  return {{"event", found.event},
          {"words", found.words},
          {"found", found.found},
          {"pairs", found.pairs}};
}

FoundContacts found_of(const Json& json) {
  if (json.is_null()) return {};
  return {json.at("event"), json.at("words").get<std::vector<std::string>>(),
          json.at("found").get<std::vector<bool>>(), json.at("pairs").get<FlatPairs>()};
}

Json totals_json(const judge::StepTotals& totals) {
  Json out = {{"element_tests", totals.element_tests}, {"motion", nullptr}, {"turn", nullptr}};
  if (const auto& motion = totals.motion)
    out["motion"] = {motion->edges, motion->step, motion->body};
  if (const auto& turn = totals.turn)
    out["turn"] = {turn->degrees, turn->step, turn->body, turn->triangle};
  return out;
}

judge::StepTotals totals_of(const Json& json) {
  judge::StepTotals out;
  out.element_tests = json.at("element_tests").get<std::uint64_t>();
  if (const Json& m = json.at("motion"); !m.is_null())
    out.motion = {m.at(0).get<double>(), m.at(1).get<std::size_t>(), m.at(2).get<std::uint32_t>()};
  if (const Json& t = json.at("turn"); !t.is_null())
    out.turn = {t.at(0).get<double>(), t.at(1).get<std::size_t>(), t.at(2).get<std::uint32_t>(),
                t.at(3).get<std::uint32_t>()};
  return out;
}

}  // namespace

Json to_json(const CheckedFrame& frame) {
  Json open = Json::array();
  for (const auto& [body, why] : frame.open) open.push_back({body, why});
  return {{"frame", frame.frame},
          {"stamp", frame.stamp},
          {"here", found_json(frame.here)},
          {"step", found_json(frame.step)},
          {"touching", pairs_json(frame.contacts.touching)},
          {"inside", pairs_json(frame.contacts.inside)},
          {"self", frame.contacts.self},
          {"open", std::move(open)},
          {"totals", totals_json(frame.totals)}};
}

CheckedFrame checked_frame(const Json& json) {
  CheckedFrame out;
  out.frame = json.at("frame").get<std::size_t>();
  out.stamp = json.at("stamp").get<std::string>();
  out.here = found_of(json.at("here"));
  out.step = found_of(json.at("step"));
  out.contacts = {pairs_of(json.at("touching")), pairs_of(json.at("inside")),
                  json.at("self").get<std::vector<std::uint32_t>>()};
  for (const Json& entry : json.at("open"))
    out.open[entry.at(0).get<std::uint32_t>()] = entry.at(1).get<std::string>();
  out.totals = totals_of(json.at("totals"));
  return out;
}

}  // namespace contactcheck::check
