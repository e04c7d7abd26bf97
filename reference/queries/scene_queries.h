// The elementary queries of a scene's steps: what its bodies ask a narrow phase between frames.
//
// A step goes from a frame to the next; vertices move straight. A query is a pair of a vertex and a
// triangle, or of two edges, whose closed boxes over the step meet: of two bodies, and of one body,
// if the scene judges self-contact, where the elements share no vertex (nor a welded one). Vertices
// are those that triangles use; edges are unordered pairs of two different vertices of a triangle,
// each once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "reference/scene/scene.h"

namespace contactcheck::queries {

struct QuerySample {
  std::optional<std::size_t> most;  ///< of each kind; none: all
  std::uint64_t seed = 1;           ///< of the draw; all queries of a kind are equally likely
  bool certificates = false;        ///< proofs of the truth, for check.py
};

/// The queries of one kind, over all steps.
struct ExportedQueries {
  std::size_t found = 0, written = 0, contacts = 0, starts_in_contact = 0;
  std::size_t proved = 0;  ///< with certificates: queries that have one
};

struct QueryExport {
  std::size_t steps = 0;
  ExportedQueries vertex_face, edge_edge;
};

/// Writes vertex-face.csv and edge-edge.csv, in the format of query_file.h with the oracle's truth
/// in the seventh column, and last queries.json: counts by step, CRC-32 of the files, version.
/// With certificates also vertex-face.certificates.jsonl and edge-edge.certificates.jsonl: a line
/// for each query with its proof (check.py documents it), or null where none was found.
/// Calls `before_step` before each step. @pre `folder` exists; a simulated scene has been simulated
/// @throws InputError, one sentence, if a vertex is not finite or a file cannot be written
QueryExport export_queries(const scene::Scene& scene, const QuerySample& sample,
                           const std::filesystem::path& folder,
                           const std::function<void()>& before_step);

/// True if `folder` is a complete export of queries.
bool is_query_export(const std::filesystem::path& folder);

}  // namespace contactcheck::queries
