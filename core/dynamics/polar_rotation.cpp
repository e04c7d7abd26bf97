#include "core/dynamics/polar_rotation.h"

#include <array>
#include <cmath>
#include <optional>

namespace contactcheck {
namespace {

// Determinant of a matrix whose largest entry is 1, above which Newton's iteration is used. Its
// accuracy falls and its number of steps grows with the condition number; below, the matrix is
// nearly flat or inverted, and the slower eigenvector is taken, which gives the same rotation.
constexpr double kLeastDeterminant = 1e-6;
// Newton's iteration converges quadratically: a step shorter than this leaves an error of its
// square, below rounding.
constexpr double kLastStep = 0x1p-27;
// Matrices above the least determinant need up to 9 steps.
constexpr int kMostSteps = 20;
// Jacobi's method needs up to 6 sweeps for a 4x4 matrix.
constexpr int kMostSweeps = 20;

using Mat4 = std::array<std::array<double, 4>, 4>;

double squared_norm(const Mat3& m) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += ordered_dot(m.col(k), m.col(k));
  return sum;
}

double determinant(const Mat3& m, const Mat3& cofactor) {
  return ordered_dot(m.col(0), cofactor.col(0));
}

// Higham's iteration: the mean of a matrix and its inverse transposed, scaled to the same size.
std::optional<Mat3> newton_rotation(Mat3 x) {
  for (int i = 0; i < kMostSteps; ++i) {
    const Mat3 cofactor = cofactors(x);
    const Mat3 inverse = cofactor / determinant(x, cofactor);
    const double scale = std::sqrt(std::sqrt(squared_norm(inverse) / squared_norm(x)));
    const Mat3 next = x * (0.5 * scale) + inverse * (0.5 / scale);
    const double step = (next - x).cwiseAbs().maxCoeff();
    x = next;
    if (step < kLastStep) return x;
  }
  return std::nullopt;
}

// Horn's matrix: q^T N q = tr(R(q)^T m) for a unit quaternion q = (w, x, y, z).
Mat4 horn_matrix(const Mat3& m) {
  const double xx = m(0, 0), yy = m(1, 1), zz = m(2, 2);
  const double wx = m(2, 1) - m(1, 2), wy = m(0, 2) - m(2, 0), wz = m(1, 0) - m(0, 1);
  const double xy = m(0, 1) + m(1, 0), xz = m(0, 2) + m(2, 0), yz = m(1, 2) + m(2, 1);
  return {{{xx + yy + zz, wx, wy, wz},
           {wx, xx - yy - zz, xy, xz},
           {wy, xy, yy - xx - zz, yz},
           {wz, xz, yz, zz - xx - yy}}};
}

// One plane rotation that makes n[p][q] zero; the eigenvectors are collected in the columns of v.
void turn(Mat4& n, Mat4& v, int p, int q) {
  // tan of the turn: the smaller root of t^2 + 2 t (n_qq - n_pp) / (2 n_pq) = 1.
  const double half = (n[q][q] - n[p][p]) / (2.0 * n[p][q]);
  const double root = std::abs(half) + std::sqrt(half * half + 1.0);
  const double t = (half < 0.0 ? -1.0 : 1.0) / root;
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  const auto mix = [c, s](double& a, double& b) {
    const double old = a;
    a = c * old - s * b;
    b = s * old + c * b;
  };
  for (int k = 0; k < 4; ++k) mix(n[k][p], n[k][q]);
  for (int k = 0; k < 4; ++k) mix(n[p][k], n[q][k]);
  for (int k = 0; k < 4; ++k) mix(v[k][p], v[k][q]);
  n[p][q] = n[q][p] = 0.0;
}

// Turns every off-diagonal entry above `least` away; false when there was none.
bool sweep(Mat4& n, Mat4& v, double least) {
  bool turned = false;
  for (int p = 0; p < 3; ++p)
    for (int q = p + 1; q < 4; ++q) {
      if (std::abs(n[p][q]) <= least) continue;
      turn(n, v, p, q);
      turned = true;
    }
  return turned;
}

Mat3 rotation_of(double w, double x, double y, double z) {
  const double scale = 2.0 / (w * w + x * x + y * y + z * z);
  Mat3 r;
  r << 1.0 - scale * (y * y + z * z), scale * (x * y - w * z), scale * (x * z + w * y),
      scale * (x * y + w * z), 1.0 - scale * (x * x + z * z), scale * (y * z - w * x),
      scale * (x * z - w * y), scale * (y * z + w * x), 1.0 - scale * (x * x + y * y);
  return r;
}

std::optional<Mat3> horn_rotation(const Mat3& m) {
  Mat4 n = horn_matrix(m);
  Mat4 v = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  // Entries are up to 1: off-diagonal ones below this turn the result by no more than rounding.
  constexpr double kLeastEntry = 0x1p-54;
  int sweeps = 0;
  while (sweep(n, v, kLeastEntry))
    if (++sweeps == kMostSweeps) return std::nullopt;
  int best = 0;
  for (int k = 1; k < 4; ++k)
    if (n[k][k] > n[best][best]) best = k;
  return rotation_of(v[0][best], v[1][best], v[2][best], v[3][best]);
}

}  // namespace

PolarRotation polar_rotation(const Mat3& m) {
  if (!m.allFinite()) return {Mat3::Identity(), false};
  const double largest = m.cwiseAbs().maxCoeff();
  if (largest == 0.0) return {};
  const Mat3 scaled = m / largest;
  std::optional<Mat3> rotation;
  if (determinant(scaled, cofactors(scaled)) > kLeastDeterminant)
    rotation = newton_rotation(scaled);
  if (!rotation) rotation = horn_rotation(scaled);
  if (!rotation) return {Mat3::Identity(), false};
  return {*rotation, true};
}

}  // namespace contactcheck
