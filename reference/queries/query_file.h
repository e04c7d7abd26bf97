// Files of elementary impact queries, as public collections have them.
//
// Text, eight lines a query: x_num,x_den,y_num,y_den,z_num,z_den and, in some collections, a
// seventh column, the truth (0 or 1, the same on all eight). Vertex-face: v, f0, f1, f2 at t = 0,
// then at t = 1; edge-edge: a0, a1, b0, b1 at t = 0, then at t = 1. Coordinates are rationals of
// any size. Source: "A Large-Scale Benchmark and an Inclusion-Based Algorithm for Continuous
// Collision Detection" (Wang et al. 2021) and its successor, whose truth is a JSON list beside the
// file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/impact.h"
#include "reference/oracle/elementary_impact.h"

namespace contactcheck::queries {

struct FileQuery {
  ImpactQuery query;  ///< if in_doubles
  bool in_doubles = true;
  oracle::RationalImpactQuery rational;  ///< if not in_doubles: some coordinate is no finite double
  std::optional<bool> truth;             ///< as the file says
  std::size_t line = 0;                  ///< of its first line, from 1
};

/// From the file's name (vf.csv, 326vf.csv, ee.csv, 326ee.csv) or the folder closest to it that is
/// named vertex-face or edge-edge.
std::optional<ImpactKind> kind_of_file(const std::filesystem::path& file);

/// Reads one query after the other: memory does not grow with the file.
class QueryReader {
 public:
  /// @throws InputError when the file cannot be read
  QueryReader(std::filesystem::path file, ImpactKind kind);

  /// False at the end of the file. @throws InputError naming file and line
  bool next(FileQuery& query);

 private:
  [[noreturn]] void fail(const std::string& what) const;
  /// False at the end of the file.
  bool next_line();

  std::filesystem::path file_;
  std::ifstream in_;
  ImpactKind kind_;
  std::vector<char> text_;      ///< room for the longest line
  std::string_view line_text_;  ///< the last line, in it
  std::size_t line_ = 0;
  std::size_t columns_ = 0;  ///< of the file; 0 before its first line
};

/// A JSON list of booleans (or of 0 and 1), one a query.
/// @throws InputError naming the file and the place
std::vector<bool> read_truth(const std::filesystem::path& file);

}  // namespace contactcheck::queries
