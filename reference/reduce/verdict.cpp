#include "reference/reduce/verdict.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/types/check.h"

namespace contactcheck::reduce {
namespace {

using Json = nlohmann::json;

constexpr const char* kError = "error";

Level level_from(const std::string& name) {
  const std::optional<Level> level = level_from_name(name);
  if (!level) throw std::runtime_error("a verdict names the level \"" + name + "\"");
  return *level;
}

bool matches(const std::string& wanted, const std::string& is) {
  return wanted.empty() || wanted == is;
}

const judge::Disagreement* find(const ProbeVerdict& verdict, const std::string& level,
                                const std::string& kind) {
  for (const judge::Disagreement& d : verdict.disagreements)
    if (d.level == level && matches(kind, d.kind)) return &d;
  return nullptr;
}

bool crosses(const ProbeVerdict& verdict, const std::string& level, const std::string& kind) {
  return level == name_of(Level::kTriangle) && kind == "missed" && verdict.missed_length > 0.0;
}

}  // namespace

std::string to_text(const ProbeVerdict& v) {
  Json levels = Json::object(), not_judged = Json::object(), disagreements = Json::array();
  for (const auto& [level, c] : v.levels)
    levels[name_of(level)] = Json::array({c.truth, c.reported, c.hit, c.missed, c.spurious});
  for (const auto& [level, why] : v.not_judged) not_judged[name_of(level)] = why;
  for (const judge::Disagreement& d : v.disagreements)
    disagreements.push_back(
        Json::array({d.level, d.kind, d.pair.body_a, d.pair.body_b, d.pair.a, d.pair.b}));
  const Json out = {{"status", static_cast<int>(v.status)},
                    {"message", v.message},
                    {"how", v.how},
                    {"levels", levels},
                    {"not_judged", not_judged},
                    {"missed_length", v.missed_length},
                    {"disagreements", disagreements}};
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

ProbeVerdict verdict_from_text(const std::string& text) try {
  const Json j = Json::parse(text);
  ProbeVerdict v;
  v.status = static_cast<results::Status>(j.at("status").get<int>());
  v.message = j.at("message");
  v.how = j.at("how");
  v.missed_length = j.at("missed_length");
  for (const auto& [name, c] : j.at("levels").items())
    v.levels[level_from(name)] = {c.at(0), c.at(1), c.at(2), c.at(3), c.at(4)};
  for (const auto& [name, why] : j.at("not_judged").items()) v.not_judged[level_from(name)] = why;
  for (const Json& from : j.at("disagreements")) {
    judge::Disagreement& d = v.disagreements.emplace_back();
    d.level = from.at(0);
    d.kind = from.at(1);
    d.pair = {from.at(2), from.at(3), from.at(4), from.at(5)};
  }
  return v;
} catch (const Json::exception& e) {
  throw std::runtime_error(std::string("a worker's verdict cannot be read: ") + e.what());
}

std::string described(const Finding& finding) {
  return finding.kind == kError ? "error: " + finding.how
                                : finding.kind + " at level " + finding.level;
}

std::optional<Finding> finding_of(const ProbeVerdict& verdict, const std::string& level,
                                  const std::string& kind) {
  if (verdict.status == results::Status::kError && level.empty() && matches(kind, kError))
    return Finding{"", kError, verdict.how};
  if (verdict.status != results::Status::kOk) return std::nullopt;
  for (const Level l : kFineToCoarse) {
    if (!matches(level, name_of(l))) continue;
    const judge::Disagreement* d = find(verdict, name_of(l), kind);
    if (d != nullptr)
      return Finding{d->level, d->kind, "", crosses(verdict, d->level, d->kind), false};
  }
  return std::nullopt;
}

bool shows(const ProbeVerdict& verdict, const Finding& finding) {
  if (finding.kind == kError)
    return verdict.status == results::Status::kError && verdict.how == finding.how;
  return verdict.status == results::Status::kOk &&
         find(verdict, finding.level, finding.kind) != nullptr &&
         (!finding.crossing || crosses(verdict, finding.level, finding.kind));
}

const judge::Disagreement& disagreement_of(const ProbeVerdict& verdict, const Finding& finding) {
  const judge::Disagreement* d = find(verdict, finding.level, finding.kind);
  CONTACTCHECK_INVARIANT(d != nullptr, "the verdict shows the finding");
  return *d;
}

}  // namespace contactcheck::reduce
