// What the paper reports, as data (fixtures/README.md, "The paper"): no number of it stands in
// code.
// Jeon, Hong, Choi, Jeong: Hierarchical Bounding Sphere FFD-AABB Algorithm for Fast Collision
// Handling of 3D Deformable Objects on Smart Devices, 2013.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace contactcheck::reproduce {

struct PaperSource {
  std::vector<std::string> authors;  ///< family names, in the paper's order
  std::string title, journal, doi;
  std::size_t year = 0;
};

/// A figure of the paper's text, and the computed figures that would bear it out.
struct PaperClaim {
  std::string says;             ///< the paper's figure or word: "12 %", "negligible"
  std::optional<double> value;  ///< none for a word
  double low = 0.0, high = 0.0;

  bool holds(double computed) const { return computed >= low && computed <= high; }
};

struct PaperDevice {
  std::string name;
  PaperClaim average_frame_rate;  ///< fps
};

/// A scene of Table 2. Counts are totals over its objects.
struct PaperScene {
  std::string id;
  std::size_t objects = 0, vertices = 0, triangles = 0, cells = 0;
  std::optional<std::size_t> objects_in_text;  ///< where the text gives another number
};

/// Milliseconds per simulated step, as printed.
struct PaperRow {
  std::string scene, method;  ///< an id of Table 2, the id of a detector
  double mss = 0.0;           ///< "Updating MSS"
  double cell = 0.0;          ///< "Updating CELL" (Table 3) or "Updating MAP" (Table 1)
  double test = 0.0;          ///< the collision test
  double response = 0.0;
  double total = 0.0;  ///< as printed, which need not be steps()

  /// The sum of the four steps.
  double steps() const { return mss + cell + test + response; }
};

/// A table of step times on one device: every scene in it has one row for each of two methods.
struct PaperTable {
  std::string name;           ///< "Table 3"
  std::string device;         ///< of PaperTables::devices
  std::string before, after;  ///< methods: the one compared with, then the one compared
  std::vector<PaperRow> rows;

  /// The scenes, in the order of their first rows.
  std::vector<std::string> scenes() const;
  /// @pre the table has this row
  const PaperRow& row(const std::string& scene, const std::string& method) const;
};

struct PaperClaims {
  PaperClaim frame_rate_gain;           ///< percent more fps than with one level
  PaperClaim best_frame_rate;           ///< fps
  std::string best_device, best_scene;  ///< where that was
  PaperClaim test_share;                ///< percent of a step's time in the collision test
  PaperClaim cell_share;                ///< percent of a step's time in the cell update
  PaperClaim one_level_gain;            ///< percent more fps than plain FFD-AABB, earlier paper
};

struct PaperTables {
  PaperSource source;
  std::vector<PaperDevice> devices;
  std::vector<PaperScene> scenes;  ///< Table 2
  PaperTable table_1;              ///< one level of spheres against none
  PaperTable table_3;              ///< two levels against one
  PaperClaims claims;

  std::array<const PaperTable*, 2> time_tables() const { return {&table_1, &table_3}; }
};

/// Reads `file` strictly. What it returns satisfies every comment above, and a total is above its
/// collision test.
/// @throws InputError, one sentence: file, path of the field, value, what is allowed
PaperTables load_paper_tables(const std::filesystem::path& file);

}  // namespace contactcheck::reproduce
