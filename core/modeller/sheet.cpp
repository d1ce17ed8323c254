#include "core/modeller/sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"
#include "core/modeller/hexahedral_cell.h"
#include "core/modeller/prismatic_cell.h"
#include "core/modeller/shape_checks.h"

namespace limber {
namespace {

using Triangle = std::array<PointId, 3>;  // anticlockwise from the outer side
using Square = std::array<PointId, 4>;

struct Parameters {
  double u, v;
};

// The points of a grid, row by row, and how cells join them.
struct GridMesh {
  std::vector<Parameters> points;
  std::vector<Triangle> triangles;
  std::vector<Square> squares;
};

// One row of points; those of a joined row are counted round and round.
struct Row {
  std::size_t first;
  std::size_t size;
  bool joined;

  std::size_t steps() const { return joined ? size : size - 1; }
  PointId operator[](std::size_t i) const { return PointId(first + i % size); }
};

// A shifted row that is not joined keeps the ends of the straight ones.
Row add_row(GridMesh& mesh, const SheetGrid& grid, double v, bool shifted) {
  const Row row{mesh.points.size(), 0, grid.joined_u};
  const int n = grid.cells_u;
  if (shifted && !grid.joined_u) mesh.points.push_back({0.0, v});
  const int steps = shifted || grid.joined_u ? n : n + 1;
  for (int i = 0; i < steps; ++i) mesh.points.push_back({(i + (shifted ? 0.5 : 0.0)) / n, v});
  if (shifted && !grid.joined_u) mesh.points.push_back({1.0, v});
  return {row.first, mesh.points.size() - row.first, grid.joined_u};
}

std::vector<Row> add_rows(GridMesh& mesh, const SheetGrid& grid) {
  std::vector<Row> rows;
  for (int j = 0; j <= grid.cells_v; ++j) {
    const bool shifted = grid.cells == SheetCells::kTriangles && j % 2 == 1;
    rows.push_back(add_row(mesh, grid, double(j) / grid.cells_v, shifted));
  }
  return rows;
}

// Between a straight row and a shifted one: a triangle on every step of either. `turned` when the
// shifted one is the lower.
void add_triangles(GridMesh& mesh, const Row& straight, const Row& shifted, bool turned) {
  const auto add = [&](PointId a, PointId b, PointId c) {
    mesh.triangles.push_back(turned ? Triangle{a, c, b} : Triangle{a, b, c});
  };
  // A shifted row that is not joined begins with the end of the straight one.
  const std::size_t above = straight.joined ? 0 : 1;
  for (std::size_t i = 0; i < straight.steps(); ++i) {
    add(straight[i], straight[i + 1], shifted[i + above]);
  }
  for (std::size_t i = 0; i < shifted.steps(); ++i) {
    add(shifted[i + 1], shifted[i], straight[i + 1 - above]);
  }
}

void add_squares(GridMesh& mesh, const Row& low, const Row& high) {
  for (std::size_t i = 0; i < low.steps(); ++i) {
    mesh.squares.push_back({low[i], low[i + 1], high[i + 1], high[i]});
  }
}

GridMesh mesh_of(const SheetGrid& grid) {
  GridMesh mesh;
  const std::vector<Row> rows = add_rows(mesh, grid);
  for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
    if (grid.cells == SheetCells::kSquares) {
      add_squares(mesh, rows[j], rows[j + 1]);
    } else if (j % 2 == 0) {
      add_triangles(mesh, rows[j], rows[j + 1], false);
    } else {
      add_triangles(mesh, rows[j + 1], rows[j], true);
    }
  }
  return mesh;
}

void require_usable(const SheetGrid& grid, const std::string& name) {
  require_at_least(name, "cells along u", grid.cells_u, grid.joined_u ? 3 : 1);
  require_at_least(name, "cells along v", grid.cells_v, 1);
  require_affordable(name, (grid.cells_u + 1.0) * (grid.cells_v + 1.0), "give fewer cells");
}

void add_points(GeometricModelBuilder& builder, const ParametricSurface& surface,
                const GridMesh& mesh, const std::string& name) {
  for (const auto& [u, v] : mesh.points) {
    const Vec3 position = surface(u, v);
    require_finite(name, say("its point at u = ", u, ", v = ", v), position);
    builder.add_point(position);
  }
}

void add_triangle_cell(GeometricModelBuilder& builder, const Triangle& t) {
  const std::array<std::array<PointId, 2>, 3> edges = {{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}};
  builder.add_cell(edges, std::array<Triangle, 1>{t});
}

void add_square_cell(GeometricModelBuilder& builder, const Square& s) {
  const std::array<std::array<PointId, 2>, 6> edges = {
      {{s[0], s[1]}, {s[1], s[2]}, {s[2], s[3]}, {s[3], s[0]}, {s[0], s[2]}, {s[1], s[3]}}};
  builder.add_cell(edges, split_square(s));
}

// Rest lengths have to be above 0; edges shorter than this part of the model are a pole.
constexpr double kCoincident = 1e-9;

void require_apart(const GeometricModel& model, const std::string& name) {
  double longest = 0.0;
  const auto length = [&](const Edge& e) { return (model.points[e.b] - model.points[e.a]).norm(); };
  for (const Edge& e : model.edges) longest = std::max(longest, length(e));
  for (const Edge& e : model.edges) {
    if (length(e) > kCoincident * longest) continue;
    throw InputError(
        {name,
         say("the neighbouring points ", e.a.value, " and ", e.b.value, " are in the same place"),
         "end the surface before its poles, and join rings with joined_u"});
  }
}

// Differences over this part of the whole range of a parameter.
constexpr double kNormalStep = 1e-5;

// Central differences; one-sided at the ends of the range.
Vec3 unit_normal(const ParametricSurface& surface, const Parameters& at, const std::string& name) {
  const auto less = [](double x) { return std::max(0.0, x - kNormalStep); };
  const auto more = [](double x) { return std::min(1.0, x + kNormalStep); };
  const Vec3 du = surface(more(at.u), at.v) - surface(less(at.u), at.v);
  const Vec3 dv = surface(at.u, more(at.v)) - surface(at.u, less(at.v));
  const Vec3 cross = du.cross(dv);
  if (cross.norm() > 1e-6 * std::max(du.squaredNorm(), dv.squaredNorm())) return cross.normalized();
  throw InputError({name, say("the surface has no normal at u = ", at.u, ", v = ", at.v),
                    "end the surface before its poles"});
}

void require_positive_volumes(const GeometricModel& model, double thickness,
                              const std::string& name) {
  for (CellId c : ids_of(model.cells)) {
    if (cell_volume(model, c) > 0.0) continue;
    throw InputError({say(name, ": cell ", c.value),
                      say("a wall of ", thickness, " m turns it inside out"),
                      "thin the wall, or turn the surface (swap u and v) so that the wall lies on "
                      "the side that it curves away from"});
  }
}

}  // namespace

SheetGrid grid_for(const ParametricSurface& surface, double spacing_m, SheetCells cells) {
  require_positive("surface", "spacing", spacing_m, "m");
  constexpr int kLines = 33;   // over which lengths are averaged
  constexpr int kSteps = 256;  // along each
  double along_u = 0.0, along_v = 0.0;
  for (int line = 0; line < kLines; ++line) {
    const double at = double(line) / (kLines - 1);
    for (int i = 0; i < kSteps; ++i) {
      const double low = double(i) / kSteps, high = double(i + 1) / kSteps;
      along_u += (surface(high, at) - surface(low, at)).norm() / kLines;
      along_v += (surface(at, high) - surface(at, low)).norm() / kLines;
    }
  }
  const double row = cells == SheetCells::kTriangles ? std::numbers::sqrt3 / 2.0 : 1.0;
  const double n_u = along_u / spacing_m, n_v = along_v / (row * spacing_m);
  require_positive("surface", "area", along_u * along_v, "m^2");
  require_affordable("surface", (n_u + 1.0) * (n_v + 1.0), "give a larger spacing");
  const auto steps = [](double n) { return std::max(1, static_cast<int>(std::lround(n))); };
  return {steps(n_u), steps(n_v), cells, false};
}

GeometricModel sheet(const ParametricSurface& surface, const SheetGrid& grid,
                     const std::string& name) {
  require_usable(grid, name);
  const GridMesh mesh = mesh_of(grid);
  GeometricModelBuilder builder;
  builder.begin_subobject(name);
  add_points(builder, surface, mesh, name);
  for (const Triangle& t : mesh.triangles) add_triangle_cell(builder, t);
  for (const Square& s : mesh.squares) add_square_cell(builder, s);
  GeometricModel model = builder.finish();
  require_apart(model, name);
  return model;
}

GeometricModel shell_patch(const ParametricSurface& surface, const SheetGrid& grid,
                           double wall_thickness_m, const std::string& name) {
  require_usable(grid, name);
  require_positive(name, "wall thickness", wall_thickness_m, "m");
  const GridMesh mesh = mesh_of(grid);
  const ParametricSurface inner_surface = [&](double u, double v) -> Vec3 {
    return surface(u, v) - wall_thickness_m * unit_normal(surface, {u, v}, name);
  };
  GeometricModelBuilder builder;
  builder.begin_subobject(name);
  add_points(builder, surface, mesh, name);
  add_points(builder, inner_surface, mesh, name);
  const auto inner = [&](PointId outer) { return PointId(outer.index() + mesh.points.size()); };
  for (const Triangle& t : mesh.triangles) {
    add_prism(builder, t, {inner(t[0]), inner(t[1]), inner(t[2])});
  }
  const auto pairs = corner_pairs({});
  for (const auto& [a, b, c, d] : mesh.squares) {
    add_hexahedron(builder, {inner(a), inner(b), inner(d), inner(c), a, b, d, c}, pairs);
  }
  GeometricModel model = builder.finish();
  require_apart(model, name);
  require_positive_volumes(model, wall_thickness_m, name);
  return model;
}

}  // namespace limber
