#include "core/modeller/bezier_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/model/errors.h"

namespace limber {
namespace {

Vec3 weighted(const std::array<Vec3, 16>& control, const std::array<double, 4>& along_v,
              const std::array<double, 4>& along_u) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) sum += along_v[i] * along_u[j] * control[4 * i + j];
  }
  return sum;
}

// Reads words line by line; `#` starts a comment.
class PatchReader {
 public:
  PatchReader(std::string_view text, std::string source)
      : text_(std::string(text)), source_(std::move(source)) {}

  std::vector<PatchPart> read() {
    std::vector<PatchPart> parts;
    while (next_line()) {
      const std::string keyword = word();
      if (keyword == "points") {
        read_points(count());
      } else if (keyword == "part") {
        const std::string name = word();
        parts.push_back({name, read_patches(count())});
      } else {
        fail("'" + keyword + "' is unknown", "write 'points N' or 'part NAME N'");
      }
    }
    return parts;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw InputError({source_ + ": line " + std::to_string(line_number_), what, remedy});
  }

  // The next line that says something; false at the end.
  bool next_line() {
    std::string line;
    while (std::getline(text_, line)) {
      ++line_number_;
      line = line.substr(0, line.find('#'));
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      line_ = std::istringstream(line);
      return true;
    }
    return false;
  }

  void require_line(const std::string& what) {
    if (!next_line()) fail("the text ends before " + what, "add the missing lines");
  }

  std::string word() {
    std::string w;
    if (!(line_ >> w)) fail("a word is missing", "see the header of the format");
    return w;
  }

  template <class T>
  T number() {
    T value;
    if (!(line_ >> value)) fail("a number is missing or unreadable", "write plain decimal numbers");
    return value;
  }

  int count() {
    const int n = number<int>();
    if (n < 0) fail("a count is " + std::to_string(n), "write 0 or more");
    return n;
  }

  void end_of_line() {
    std::string rest;
    if (line_ >> rest) fail("'" + rest + "' is too much on this line", "remove it");
  }

  void read_points(int n) {
    end_of_line();
    for (int i = 0; i < n; ++i) {
      require_line("all points are there");
      const double x = number<double>(), y = number<double>(), z = number<double>();
      end_of_line();
      points_.emplace_back(x, y, z);
    }
  }

  std::vector<BezierPatch> read_patches(int n) {
    end_of_line();
    std::vector<BezierPatch> patches(static_cast<std::size_t>(n));
    for (BezierPatch& patch : patches) {
      require_line("all patches are there");
      for (Vec3& control : patch.control) control = point(number<int>());
      end_of_line();
    }
    return patches;
  }

  const Vec3& point(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= points_.size()) {
      fail("there is no point " + std::to_string(index),
           "name one of the " + std::to_string(points_.size()) + " points, counted from 0");
    }
    return points_[static_cast<std::size_t>(index)];
  }

  std::istringstream text_;
  std::istringstream line_;
  std::string source_;
  int line_number_ = 0;
  std::vector<Vec3> points_;
};

}  // namespace

std::array<double, 4> bernstein(double t) {
  const double s = 1.0 - t;
  return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

std::array<double, 4> bernstein_derivative(double t) {
  const double s = 1.0 - t;
  return {-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t};
}

Vec3 BezierPatch::position(double u, double v) const {
  return weighted(control, bernstein(v), bernstein(u));
}

Vec3 BezierPatch::derivative_u(double u, double v) const {
  return weighted(control, bernstein(v), bernstein_derivative(u));
}

Vec3 BezierPatch::derivative_v(double u, double v) const {
  return weighted(control, bernstein_derivative(v), bernstein(u));
}

Vec3 BezierPatch::normal(double u, double v) const {
  // The cross product grows in proportion to the distance from a pole, so its direction is that of
  // the limit up to the step itself.
  for (double inward = 0.0; inward < 0.1; inward = std::max(1e-6, 10.0 * inward)) {
    const double un = std::lerp(u, 0.5, inward), vn = std::lerp(v, 0.5, inward);
    const Vec3 du = derivative_u(un, vn), dv = derivative_v(un, vn);
    const Vec3 cross = du.cross(dv);
    const double size = std::max(du.squaredNorm(), dv.squaredNorm());
    if (cross.norm() > 1e-9 * size) return cross.normalized();
  }
  return Vec3::Zero();  // a patch without area
}

std::vector<PatchPart> parse_bezier_patches(std::string_view text, const std::string& source) {
  return PatchReader(text, source).read();
}

}  // namespace limber
