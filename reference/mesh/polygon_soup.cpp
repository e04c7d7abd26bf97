// CGAL 5.5.1's Stream_support (LGPL-3.0-or-later). Seen with that version:
// - the readers stop at "nan", "inf" and overflowing numbers and return false without a reason;
// - the OBJ reader refuses the keyword "l" (polylines), which is legal: those lines are left out.
#include "reference/mesh/polygon_soup.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <sstream>

namespace contactcheck::mesh {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Points = std::vector<Point>;
using Polygons = std::vector<std::vector<std::size_t>>;

std::string without_polylines(const std::string& bytes) {
  std::string out;
  out.reserve(bytes.size());
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t");
    const bool polyline = first != std::string::npos && line[first] == 'l' &&
                          first + 1 < line.size() &&
                          (line[first + 1] == ' ' || line[first + 1] == '\t');
    if (!polyline) out += line;
    out += '\n';
  }
  return out;
}

bool read(SoupFormat format, const std::string& bytes, Points& points, Polygons& polygons) {
  std::istringstream in(format == SoupFormat::kObj ? without_polylines(bytes) : bytes,
                        std::ios::in | std::ios::binary);
  switch (format) {
    case SoupFormat::kObj:
      return CGAL::IO::read_OBJ(in, points, polygons);
    case SoupFormat::kOff:
      return CGAL::IO::read_OFF(in, points, polygons);
    case SoupFormat::kPly:
      return false;
    case SoupFormat::kStl:
      return CGAL::IO::read_STL(in, points, polygons);
  }
  return false;
}

}  // namespace

const char* name_of(SoupFormat format) {
  switch (format) {
    case SoupFormat::kObj:
      return "OBJ";
    case SoupFormat::kOff:
      return "OFF";
    case SoupFormat::kPly:
      return "PLY";
    case SoupFormat::kStl:
      return "STL";
  }
  return "unknown";
}

bool read_polygon_soup(SoupFormat format, const std::string& bytes, PolygonSoup& out) {
  Points points;
  Polygons polygons;
  try {
    if (!read(format, bytes, points, polygons)) return false;
  } catch (const std::exception&) {
    return false;  // CGAL's own checks throw, and a lying header may ask for too much memory
  }
  out.points.clear();
  out.polygons.clear();
  for (const Point& p : points) out.points.emplace_back(p.x(), p.y(), p.z());
  constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max();
  for (const std::vector<std::size_t>& polygon : polygons) {
    std::vector<std::uint32_t>& indices = out.polygons.emplace_back();
    for (const std::size_t i : polygon) {
      indices.push_back(static_cast<std::uint32_t>(std::min(i, kLargest)));
    }
  }
  return true;
}

}  // namespace contactcheck::mesh
