#include "reference/plugin/declaration.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>

#include "core/types/check.h"
#include "reference/results/results_json.h"
#include "reference/text/id_check.h"

namespace contactcheck::plugin {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestText = 200;  // bytes of a summary or a sentence
constexpr std::size_t kMostOptions = 64, kMostChoices = 64;

template <typename Values>
auto named_value(const text::JsonField& field, const Values& all) {
  std::vector<std::string> names;
  for (const auto value : all) names.emplace_back(name_of(value));
  const std::string name = field.one_of(names);
  for (const auto value : all)
    if (name == name_of(value)) return value;
  field.fail("has no value");
}

template <typename Values>
auto named_values(const text::JsonField& field, const Values& all) {
  std::vector<std::decay_t<decltype(*std::begin(all))>> out;
  for (const text::JsonField& item : field.items()) out.push_back(named_value(item, all));
  return out;
}

// It goes into tables and on terminals.
std::string one_line(const text::JsonField& field) {
  std::string text = field.text();
  const bool control = std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
  if (text.size() > kLongestText || control)
    field.refuse("one line of " + std::to_string(kLongestText) + " bytes at most");
  return text;
}

std::string optional_line(const text::JsonField& object, const char* key) {
  if (!object.has(key)) return "";
  const text::JsonField field = object.at(key);
  const bool empty = field.is(text::JsonValue::Kind::kText) && field.value().text.empty();
  return empty ? "" : one_line(field);
}

// Names and words of options stand between ':', ',' and '=' in a detector's name.
OptionInfo read_option(const text::JsonField& field) {
  field.no_misspelt_keys({"name", "default", "help", "choices", "min", "max", "integer"});
  OptionInfo option;
  option.name = text::parse_id(field.at("name"));
  option.default_value = one_line(field.at("default"));
  option.help = optional_line(field, "help");
  if (field.has("choices")) {
    for (const text::JsonField& choice : field.at("choices").items(1))
      option.choices.push_back(text::parse_id(choice));
    if (option.choices.size() > kMostChoices) field.fail("has too many choices");
    return option;
  }
  option.min = field.at("min").number();
  option.max = field.at("max").number({option.min});
  option.integer = field.has("integer") && field.at("integer").boolean();
  return option;
}

Json option_json(const OptionInfo& option) {
  Json out = {{"name", option.name}, {"default", option.default_value}, {"help", option.help}};
  if (option.choices.empty()) {
    out["min"] = option.min;
    out["max"] = option.max;
    out["integer"] = option.integer;
  } else {
    out["choices"] = option.choices;
  }
  return out;
}

std::vector<OptionInfo> read_options(const text::JsonField& field) {
  std::vector<OptionInfo> options;
  for (const text::JsonField& item : field.items()) {
    options.push_back(read_option(item));
    for (std::size_t i = 0; i + 1 < options.size(); ++i)
      if (options[i].name == options.back().name) item.fail("is an option that is there already");
  }
  if (options.size() > kMostOptions) field.fail("has too many options");
  return options;
}

ImpactTolerance read_tolerance(const text::JsonField& field) {
  ImpactTolerance out;
  if (field.has("tolerance")) out.absolute = field.at("tolerance").number();
  if (field.has("tolerance_of_start")) out.of_start = field.at("tolerance_of_start").number();
  return out;
}

std::string tolerance_fault(const ImpactTolerance& tolerance) {
  for (const double number : {tolerance.absolute, tolerance.of_start})
    if (!std::isfinite(number) || number < 0.0) return "a tolerance is no number from 0 on";
  return "";
}

Json impacts_json(const ImpactClaims& claims) {
  Json kinds = Json::array();
  for (const ImpactKind kind : claims.kinds) kinds.push_back(name_of(kind));
  return {{"kinds", kinds},
          {"precision", name_of(claims.precision)},
          {"tolerance", claims.tolerance.absolute},
          {"tolerance_of_start", claims.tolerance.of_start}};
}

}  // namespace

Semantics read_semantics(const text::JsonField& field) {
  field.no_misspelt_keys({"levels", "questions", "informative", "body", "touching", "exact",
                          "margin", "tolerance", "tolerance_of_start", "precision", "scale",
                          "depth_kind", "whole_cells", "means"});
  Semantics s;
  s.levels = named_values(field.at("levels"), kLevels);
  s.questions = named_values(field.at("questions"), kQuestions);
  if (field.has("informative")) s.informative = named_values(field.at("informative"), kLevels);
  if (field.has("body")) s.solid = field.at("body").one_of({"surface", "solid"}) == "solid";
  if (field.has("touching")) s.closed = field.at("touching").one_of({"closed", "open"}) == "closed";
  if (field.has("exact")) s.exact = field.at("exact").boolean();
  if (field.has("margin")) s.margin = field.at("margin").number();
  s.tolerance = read_tolerance(field);
  if (field.has("precision")) s.precision = named_value(field.at("precision"), kHeaderPrecisions);
  if (field.has("scale")) s.scale = field.at("scale").number();
  if (field.has("depth_kind")) s.depth = named_value(field.at("depth_kind"), kHeaderDepthKinds);
  if (field.has("whole_cells")) s.whole_cells = field.at("whole_cells").boolean();
  s.means = optional_line(field, "means");
  const std::string fault = semantics_fault(s);
  if (!fault.empty()) field.fail("does not fit together: " + fault);
  return s;
}

ImpactClaims read_impact_claims(const text::JsonField& field) {
  field.no_misspelt_keys({"kinds", "precision", "tolerance", "tolerance_of_start"});
  ImpactClaims claims;
  claims.kinds = named_values(field.at("kinds"), kHeaderKinds);
  if (field.has("precision"))
    claims.precision = named_value(field.at("precision"), kHeaderPrecisions);
  claims.tolerance = read_tolerance(field);
  const std::string fault = claims_fault(claims);
  if (!fault.empty()) field.fail("does not fit together: " + fault);
  return claims;
}

Declaration read_declaration(const text::JsonField& field) {
  field.no_misspelt_keys({"id", "summary", "version", "options", "needs", "unisolated", "transient",
                          "prepares_again", "warm_up", "impacts", "semantics"});
  Declaration out;
  out.id = text::parse_id(field.at("id"));
  out.summary = optional_line(field, "summary");
  out.version = optional_line(field, "version");
  if (field.has("options")) out.options = read_options(field.at("options"));
  if (field.has("needs")) {
    out.needs_vertices = out.needs_nodes = false;
    for (const text::JsonField& item : field.at("needs").items())
      (item.one_of({"vertices", "nodes"}) == "nodes" ? out.needs_nodes : out.needs_vertices) = true;
  }
  if (field.has("unisolated")) out.unisolated = field.at("unisolated").boolean();
  if (field.has("transient")) out.transient = field.at("transient").boolean();
  if (field.has("prepares_again")) out.prepares_again = field.at("prepares_again").boolean();
  if (field.has("warm_up"))
    out.warm_up = static_cast<std::uint32_t>(field.at("warm_up").whole(0, kMostWarmUpFrames));
  if (out.warm_up > 0 && !out.prepares_again)
    field.at("warm_up").fail(
        "needs \"prepares_again\": true, since the bodies of a scene follow those of the warm-up");
  if (field.has("impacts")) out.impacts = read_impact_claims(field.at("impacts"));
  // What answers queries of moving elements may answer nothing else.
  if (!out.impacts || field.has("semantics")) out.semantics = read_semantics(field.at("semantics"));
  return out;
}

nlohmann::ordered_json to_json(const Declaration& d) {
  Json options = Json::array(), needs = Json::array(), semantics = results::to_json(d.semantics);
  for (const OptionInfo& option : d.options) options.push_back(option_json(option));
  if (d.needs_vertices) needs.push_back("vertices");
  if (d.needs_nodes) needs.push_back("nodes");
  semantics["whole_cells"] = d.semantics.whole_cells;  // which results.json does not have
  Json out = {{"id", d.id},
              {"summary", d.summary},
              {"version", d.version},
              {"options", options},
              {"needs", needs},
              {"unisolated", d.unisolated},
              {"transient", d.transient},
              {"prepares_again", d.prepares_again},
              {"warm_up", d.warm_up}};
  if (d.answers_frames()) out["semantics"] = semantics;
  if (d.impacts) out["impacts"] = impacts_json(*d.impacts);
  return out;
}

std::string semantics_fault(const Semantics& s) {
  std::set<Level> levels(s.levels.begin(), s.levels.end());
  levels.insert(s.informative.begin(), s.informative.end());
  if (levels.empty()) return "it claims no level";
  if (levels.size() != s.levels.size() + s.informative.size())
    return "it names a level twice (one that is claimed is not informative beside)";
  if (s.exact && s.levels.empty()) return "it is exact at no level";

  // What is judged must have been asked for.
  if (s.questions.empty()) return "it answers no question";
  if (std::set<Question>(s.questions.begin(), s.questions.end()).size() != s.questions.size())
    return "it names a question twice";
  if (s.claims(Level::kTriangle) && !s.answers(Question::kTriangles))
    return "it claims the level triangle and does not answer the question triangles";
  if (s.claims(Level::kCell) && !s.answers(Question::kCells))
    return "it claims the level cell and does not answer the question cells";
  if (std::any_of(levels.begin(), levels.end(), is_self) != s.answers(Question::kSelf))
    return "the levels self, self-vertex, self-edge, self-body, self-cell, self-near and the "
           "question self go together, and it declares one of them";
  const auto between = [](Level level) { return is_impact(level) && !is_self_impact(level); };
  if (std::any_of(levels.begin(), levels.end(), between) != s.answers(Question::kImpacts))
    return "the levels impact-vf, impact-ee, impact-triangle, impact and the question impacts go "
           "together, and it declares one of them";
  if (std::any_of(levels.begin(), levels.end(), is_self_impact) !=
      s.answers(Question::kSelfImpacts))
    return "the levels impact-self-vf, impact-self-ee and the question self-impacts go together, "
           "and it declares one of them";
  if (s.answers(Question::kContacts) != (s.depth != DepthKind::kNone))
    return "the question contacts and a kind of depth go together, and it declares one of them";

  if (!std::isfinite(s.margin) || s.margin < 0.0) return "its margin is no number from 0 on";
  for (const Level level : {Level::kNear, Level::kSelfNear})
    if (s.claims(level) && s.margin == 0.0)
      return "it claims the level " + std::string(name_of(level)) +
             " with a margin of 0: nothing is nearer than that";
  if (!std::isfinite(s.scale) || s.scale <= 0.0) return "its scale is no number above 0";
  if (s.precision == Precision::kDouble && s.scale != 1.0)
    return "it has a scale and no single precision";
  if (s.local_origin && (s.precision == Precision::kDouble || s.scale != 1.0))
    return "it has a local origin and no single precision at scale 1";
  const bool tolerates = s.tolerance.absolute != 0.0 || s.tolerance.of_start != 0.0;
  if (tolerates && !s.answers(Question::kImpacts) && !s.answers(Question::kSelfImpacts))
    return "it has a tolerance and answers no question about steps";
  return tolerance_fault(s.tolerance);
}

std::string claims_fault(const ImpactClaims& claims) {
  if (claims.kinds.empty()) return "it answers no kind of queries";
  if (std::set<ImpactKind>(claims.kinds.begin(), claims.kinds.end()).size() != claims.kinds.size())
    return "it names a kind twice";
  return tolerance_fault(claims.tolerance);
}

void read_self_answer(const std::string& from, ContactSet& answer) {
  const auto require_one = [&](const std::string& what, std::uint32_t a, std::uint32_t b) {
    if (a != b)
      throw InputError(from + " answers the question self with " + what + ", " + std::to_string(a) +
                       " and " + std::to_string(b));
  };
  const auto take = [&](const std::string& elements, std::vector<ElementPair>& pairs,
                        std::vector<SelfPair>& out) {
    for (const ElementPair& p : pairs) {
      require_one(elements + " of two bodies", p.body_a, p.body_b);
      out.push_back({p.body_a, p.a, p.b});
    }
    pairs.clear();
  };
  take("triangles", answer.triangles, answer.self);
  take("cells", answer.cells, answer.self_cells);
  for (const NearPair& p : answer.near)
    require_one("a vertex and a triangle of two bodies", p.body, p.other);
  answer.self_near = std::move(answer.near);
  answer.near.clear();
  for (const BodyPair& p : answer.bodies) {
    require_one("a pair of bodies", p.a, p.b);
    answer.self_bodies.push_back(p.a);
  }
  answer.bodies.clear();
}

void require_same_claims(const std::string& from, const Semantics& before, const Semantics& now) {
  const struct {
    bool changed;
    const char* key;  // in a declaration
  } claims[] = {{before.levels != now.levels, "levels"},
                {before.informative != now.informative, "informative"},
                {before.questions != now.questions, "questions"},
                {before.solid != now.solid, "body"},
                {before.closed != now.closed, "touching"},
                {before.exact != now.exact, "exact"},
                {before.precision != now.precision, "precision"},
                {before.depth != now.depth, "depth_kind"},
                {before.whole_cells != now.whole_cells, "whole_cells"},
                {before.means != now.means, "means"}};
  for (const auto& claim : claims)
    if (claim.changed) refuse_change(from, claim.key);
}

void require_same_claims(const std::string& from, const ImpactClaims& before,
                         const ImpactClaims& now) {
  if (now.kinds != before.kinds)
    throw InputError(from + " answers other kinds of queries with these options");
  if (now.precision != before.precision)
    throw InputError(from + " computes in another precision with these options");
}

void refuse_change(const std::string& from, const std::string& key) {
  throw InputError(
      from + " declares another \"" + key +
      "\" after prepare than before: only scale, margin and tolerances may change then");
}

}  // namespace contactcheck::plugin
