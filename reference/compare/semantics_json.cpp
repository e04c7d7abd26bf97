#include "reference/compare/semantics_json.h"

#include <nlohmann/json.hpp>
#include <vector>

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

template <typename Value>
Json names_json(const std::vector<Value>& values) {
  Json out = Json::array();
  for (const Value value : values) out.push_back(name_of(value));
  return out;
}

}  // namespace

Json to_json(const Semantics& s) {
  Json out = {{"levels", names_json(s.levels)},
              {"informative", names_json(s.informative)},
              {"questions", names_json(s.questions)},
              {"body", s.solid ? "solid" : "surface"},
              {"touching", s.closed ? "closed" : "open"},
              {"exact", s.exact},
              {"margin", s.margin},
              {"precision", name_of(s.precision)},
              {"scale", s.scale},
              {"depth_kind", name_of(s.depth)},
              {"means", s.means}};
  if (s.local_origin) out["local_origin"] = true;
  return out;
}

}  // namespace contactcheck
