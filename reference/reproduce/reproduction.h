// Our measurements compared with the paper's: counts, step times, ratios. Everything is taken from
// a results.json and from fixtures/paper; nothing is measured here.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reference/reproduce/paper_tables.h"
#include "reference/results/results.h"

namespace contactcheck::reproduce {

/// One way to read the paper's method, as the end of a detector's name.
struct MethodReading {
  const char* id;      ///< key in the document
  const char* suffix;  ///< after the method's id
  const char* says;    ///< for a report
};

/// Headlines are at `safe`; `paper` stands beside it with what it missed.
inline constexpr std::array<MethodReading, 3> kReadings = {
    MethodReading{"safe", ":bounds=safe",
                  "bounds that contain what they bound, node against plane"},
    MethodReading{"paper", "", "as the paper is written, node against plane"},
    MethodReading{"exact", "+tri", "safe bounds, exact triangle test"}};

/// Methods in the paper's order: no spheres, one level, two, N.
inline constexpr std::array<const char*, 4> kMethods = {"ffd-aabb", "ffd-aabb-sphere",
                                                        "ffd-aabb-sphere2", "ffd-aabb-sphereN"};

/// What the paper's methods are to be tighter than: the cells themselves collide.
inline constexpr const char* kTraditional = "ffd-grid";

/// The scene of fixtures/scenes that stands for a scene of the paper: "paper-" and its id.
std::string scene_of_paper(const std::string& id);

/// Per scene of the paper: `counts`, `steps` per method and reading, `ratios` between methods with
/// the range over repeats, `frame_rate`, `closed_loop`, `sentences` where ours disagrees; then
/// `means` over the scenes. Scenes that the results do not hold are left out. Described in
/// fixtures/README.md, "The paper".
/// @pre results of `contactcheck reproduce`: runs with `step_ms` and `closed_loop`
nlohmann::ordered_json reproduce(const results::Results& results, const PaperTables& tables);

}  // namespace contactcheck::reproduce
