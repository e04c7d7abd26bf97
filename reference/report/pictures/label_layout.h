// Places names beside points so that none covers another.
#pragma once

#include <optional>
#include <vector>

namespace contactcheck::report {

/// A box in a picture, in pixels, y downwards; left upper corner and size.
struct Box {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

/// Closed: sharing an edge is overlapping.
bool overlap(const Box& a, const Box& b);

/// A point and the size of the name that wants to be near it.
struct LabelledPoint {
  double x = 0, y = 0;
  double width = 0, height = 0;
};

struct PicturePoint {
  double x = 0, y = 0;
};

struct PictureSegment {
  PicturePoint from, to;
};

struct LabelPlace {
  Box box;
  /// Where the name is not beside its point: the place on the box's edge that a line should join to
  /// the point.
  std::optional<PicturePoint> leader;
};

/// A place for the name of every point, in the order of `points`, as near as can be. No box
/// overlaps another, a marker (a disc of `radius` about each point) or leaves `area`; `lines` and
/// leaders are kept free where that is possible. Nothing where no such place is found. The same
/// points give the same places.
std::vector<std::optional<LabelPlace>> place_labels(const std::vector<LabelledPoint>& points,
                                                    const Box& area, double radius,
                                                    const std::vector<PictureSegment>& lines = {});

}  // namespace contactcheck::report
