#include "reference/reduce/reduction.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "reference/reduce/number_moves.h"

namespace contactcheck::reduce {
namespace {

using Items = std::vector<std::size_t>;

/// Part `part` of `parts` nearly equal ones.
struct Span {
  std::size_t from = 0, to = 0;
};
Span part_of(const Items& items, std::size_t part, std::size_t parts) {
  return {items.size() * part / parts, items.size() * (part + 1) / parts};
}

Items inside(const Items& items, Span span) {
  return {items.begin() + static_cast<std::ptrdiff_t>(span.from),
          items.begin() + static_cast<std::ptrdiff_t>(span.to)};
}

Items outside(const Items& items, Span span) {
  Items out = inside(items, {0, span.from});
  out.insert(out.end(), items.begin() + static_cast<std::ptrdiff_t>(span.to), items.end());
  return out;
}

}  // namespace

Items minimal_subset(Items items, const ShowsSubset& shows,
                     const std::function<bool()>& may_go_on) {
  std::size_t parts = 2;
  const auto take_first = [&](auto&& choose) {
    for (std::size_t p = 0; p < parts && may_go_on(); ++p) {
      Items fewer = choose(items, part_of(items, p, parts));
      if (fewer.empty() || fewer.size() == items.size() || !shows(fewer)) continue;
      items = std::move(fewer);
      return true;
    }
    return false;
  };
  while (items.size() >= 2 && may_go_on()) {
    parts = std::min(parts, items.size());
    if (take_first(inside)) {
      parts = 2;
    } else if (parts > 2 && take_first(outside)) {
      parts = std::max<std::size_t>(parts - 1, 2);
    } else if (parts < items.size()) {
      parts *= 2;
    } else {
      break;
    }
  }
  return items;
}

namespace {

// Triangles per mesh: how many times more each next surroundings of a pair has.
constexpr std::size_t kGrowth = 4;

/// Asks each candidate once, and no more than the budget allows.
class Questions {
 public:
  Questions(const ShowsCandidate& shows, std::size_t budget) : shows_(shows), budget_(budget) {}

  bool operator()(const CaseCandidate& candidate) {
    for (const TriangleMesh& mesh : candidate.meshes)
      if (mesh.triangles.empty()) return false;
    const auto [known, is_new] = answers_.try_emplace(key_of(candidate), false);
    if (!is_new) return known->second;
    if (!left()) return false;
    ++asked_;
    known->second = shows_(candidate);
    return known->second;
  }
  bool left() const { return asked_ < budget_; }
  std::size_t asked() const { return asked_; }

 private:
  template <typename T>
  static void append(const T& value, std::string& key) {
    key.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  static std::string key_of(const CaseCandidate& candidate) {
    std::string key(1, candidate.on_nodes ? 'n' : 'b');
    for (const TriangleMesh& mesh : candidate.meshes) {
      append(mesh.triangles.size(), key);
      for (const Triangle& t : mesh.triangles) append(t, key);
    }
    for (const double x : coordinates_of(candidate)) append(x, key);
    return key;
  }

  const ShowsCandidate& shows_;
  std::size_t budget_, asked_ = 0;
  std::unordered_map<std::string, bool> answers_;
};

Vec3 centre(const TriangleMesh& mesh, std::uint32_t triangle) {
  Vec3 out = Vec3::Zero();
  for (const std::uint32_t v : mesh.triangles[triangle]) out += mesh.vertices[v] / 3.0;
  return out;
}

/// Round each triangle of `pair` the `count` of its mesh whose centres lie nearest to its own,
/// which comes first among equals; in the order of the mesh. Other meshes stay whole.
CaseCandidate surroundings_of(const CaseCandidate& whole, const TrianglePair& pair,
                              std::size_t count) {
  std::vector<std::set<std::uint32_t>> nearest(whole.meshes.size());
  for (std::size_t side = 0; side < 2; ++side) {
    const TriangleMesh& mesh = whole.meshes[whole.mesh_of(side)];
    const Vec3 place = centre(mesh, pair[side]);
    std::vector<std::pair<double, std::uint32_t>> by_distance;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      by_distance.emplace_back(t == pair[side] ? -1.0 : (centre(mesh, t) - place).squaredNorm(), t);
    std::sort(by_distance.begin(), by_distance.end());
    for (std::size_t i = 0; i < by_distance.size() && i < count; ++i)
      nearest[whole.mesh_of(side)].insert(by_distance[i].second);
  }
  std::vector<Piece> pieces;
  for (const Piece& piece : pieces_of(whole)) {
    const bool of_pair = piece.mesh == whole.mesh_of(0) || piece.mesh == whole.mesh_of(1);
    if (!of_pair || nearest[piece.mesh].contains(piece.triangle)) pieces.push_back(piece);
  }
  return with_pieces(whole, pieces);
}

CaseCandidate with_fewer_meshes(CaseCandidate now, Questions& shows) {
  for (std::size_t m = now.meshes.size(); m-- > 0 && now.meshes.size() > 2;)
    if (CaseCandidate fewer = without_mesh(now, m); shows(fewer)) now = std::move(fewer);
  return now;
}

CaseCandidate with_fewer_triangles(const CaseCandidate& now, Questions& shows) {
  const std::vector<Piece> pieces = pieces_of(now);
  const auto subset = [&](const std::vector<std::size_t>& items) {
    std::vector<Piece> kept;
    for (const std::size_t i : items) kept.push_back(pieces[i]);
    return with_pieces(now, kept);
  };
  std::vector<std::size_t> all(pieces.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<std::size_t> kept = minimal_subset(
      all, [&](const auto& items) { return shows(subset(items)); }, [&] { return shows.left(); });
  // A cell has more nodes than its triangle has corners.
  return kept.size() == all.size() ? now : subset(kept);
}

CaseCandidate with_simpler_numbers(const CaseCandidate& now, Questions& shows) {
  const std::vector<int> dimensions = dimensions_of(now);
  const auto shows_moved = [&](const Coordinates& coordinates) {
    const CaseCandidate moved = with_coordinates(now, coordinates);
    const std::vector<int> after = dimensions_of(moved);
    // A triangle that has become a segment or a point is another kind of hard case.
    return std::equal(after.begin(), after.end(), dimensions.begin(), std::greater_equal<>()) &&
           shows(moved);
  };
  return with_coordinates(now, simplify(coordinates_of(now), 3 * now.meshes[0].vertices.size(),
                                        shows_moved, [&] { return shows.left(); }));
}

}  // namespace

std::optional<Reduction> reduce(const CaseCandidate& whole, const std::optional<TrianglePair>& pair,
                                const ShowsCandidate& shows, std::size_t budget,
                                const std::vector<CaseCandidate>& cells) {
  Questions questions(shows, budget);
  std::optional<CaseCandidate> start;
  for (const CaseCandidate& candidate : cells)
    if (!start && questions(candidate)) start = candidate;
  // Without a lattice there is less to understand.
  const auto try_start = [&](CaseCandidate candidate) {
    for (const bool on_nodes : {false, true}) {
      candidate.on_nodes = on_nodes;
      if (!start && questions(candidate)) start = candidate;
    }
  };
  const std::size_t largest = std::max(whole.meshes[whole.mesh_of(0)].triangles.size(),
                                       whole.meshes[whole.mesh_of(1)].triangles.size());
  for (std::size_t n = 1; !start && pair && n < largest; n *= kGrowth)
    try_start(surroundings_of(whole, *pair, n));
  try_start(whole);
  if (!start) return std::nullopt;

  CaseCandidate now = *start;
  while (true) {
    const std::size_t triangles = now.triangles();
    now = with_fewer_triangles(with_fewer_meshes(std::move(now), questions), questions);
    const std::vector<double> before = coordinates_of(now);
    now = with_simpler_numbers(now, questions);
    const bool changed = now.triangles() < triangles || coordinates_of(now) != before;
    if (!changed || !questions.left()) break;
  }
  return Reduction{now, questions.asked(), questions.left()};
}

}  // namespace contactcheck::reduce
