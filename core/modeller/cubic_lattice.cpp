#include "core/modeller/cubic_lattice.h"

#include <algorithm>
#include <cmath>

#include "core/model/diagnostic_list.h"
#include "core/modeller/box_lattice.h"

namespace limber {
namespace {

using GridIndex = std::array<int, 3>;  // of a point, along each axis

[[noreturn]] void refuse(const CubicLattice& lattice, std::string what, const char* remedy) {
  throw InputError({lattice.name, std::move(what), remedy});
}

void require_not_negative(const CubicLattice& lattice, const char* what, double x) {
  if (!(std::isfinite(x) && x >= 0.0))
    refuse(lattice, say(what, " is ", x), "give a finite value, 0 or above");
}

void require_usable(const CubicLattice& lattice) {
  for (int axis = 0; axis < 3; ++axis)
    if (lattice.points[axis] < 1)
      refuse(lattice, say("axis ", axis, " has ", lattice.points[axis], " points"),
             "give at least one point along every axis");
  if (!(std::isfinite(lattice.spacing) && lattice.spacing > 0.0))
    refuse(lattice, say("spacing (m) is ", lattice.spacing), "give a finite value above 0");
  if (!(std::isfinite(lattice.mass) && lattice.mass > 0.0))
    refuse(lattice, say("mass (kg) is ", lattice.mass), "give a finite value above 0");
  require_not_negative(lattice, "axial stiffness (N/m)", lattice.springs.axial);
  require_not_negative(lattice, "face diagonal stiffness (N/m)", lattice.springs.face_diagonal);
  require_not_negative(lattice, "body diagonal stiffness (N/m)", lattice.springs.body_diagonal);
  require_not_negative(lattice, "damping per stiffness (s)", lattice.damping_per_stiffness);
}

CellEdges wanted_edges(const CubicSprings& springs) {
  return {.axial = springs.axial > 0.0,
          .face_diagonals = springs.face_diagonal > 0.0,
          .body_diagonals = springs.body_diagonal > 0.0};
}

std::vector<int> long_axes(const GridIndex& points) {
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (points[axis] > 1) axes.push_back(axis);
  return axes;
}

PointId point_at(const GridIndex& points, const GridIndex& at) {
  const auto i = [](int n) { return static_cast<std::size_t>(n); };
  return PointId(i(at[0]) + i(points[0]) * (i(at[1]) + i(points[1]) * i(at[2])));
}

GridIndex index_of(const GridIndex& points, PointId p) {
  return {p.value % points[0], p.value / points[0] % points[1], p.value / points[0] / points[1]};
}

void add_points(GeometricModelBuilder& builder, const CubicLattice& lattice) {
  const auto& [nx, ny, nz] = lattice.points;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        builder.add_point(lattice.origin + lattice.spacing * Vec3(x, y, z));
}

void add_rope(GeometricModelBuilder& builder, const CubicLattice& lattice) {
  if (lattice.springs.axial <= 0.0) return;
  const int n = *std::max_element(lattice.points.begin(), lattice.points.end());
  for (int i = 1; i < n; ++i) builder.edge(PointId(std::size_t(i - 1)), PointId(std::size_t(i)));
}

// The corners of the square at `at`, anticlockwise about the axis without extent.
std::array<PointId, 4> square_at(const GridIndex& points, const GridIndex& at, int u, int v) {
  const auto corner = [&](int du, int dv) {
    GridIndex shifted = at;
    shifted[u] += du;
    shifted[v] += dv;
    return point_at(points, shifted);
  };
  return {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
}

void add_square(GeometricModelBuilder& builder, const std::array<PointId, 4>& c,
                const CellEdges& wanted) {
  const std::array<PointId, 2> sides[] = {{c[0], c[1]}, {c[1], c[2]}, {c[2], c[3]}, {c[3], c[0]}};
  const std::array<PointId, 2> diagonals[] = {{c[0], c[2]}, {c[1], c[3]}};
  std::vector<std::array<PointId, 2>> edges;
  if (wanted.axial) edges.insert(edges.end(), std::begin(sides), std::end(sides));
  if (wanted.face_diagonals) edges.insert(edges.end(), std::begin(diagonals), std::end(diagonals));
  if (wanted.axial) {
    builder.add_cell(edges, split_square(c));
    return;
  }
  for (const auto& [a, b] : edges) builder.edge(a, b);
}

// u, v and the axis without extent are right-handed, in this order.
void add_sheet(GeometricModelBuilder& builder, const CubicLattice& lattice) {
  const GridIndex& n = lattice.points;
  const int flat = static_cast<int>(std::find(n.begin(), n.end(), 1) - n.begin());
  const int u = (flat + 1) % 3, v = (flat + 2) % 3;
  const CellEdges wanted = wanted_edges(lattice.springs);
  GridIndex at = {0, 0, 0};
  for (at[v] = 0; at[v] + 1 < n[v]; ++at[v])
    for (at[u] = 0; at[u] + 1 < n[u]; ++at[u]) add_square(builder, square_at(n, at, u, v), wanted);
}

GeometricModel block_geometry(const CubicLattice& lattice) {
  const auto& [nx, ny, nz] = lattice.points;
  return box_lattice({nx - 1, ny - 1, nz - 1}, Vec3::Constant(lattice.spacing), lattice.origin,
                     lattice.name, wanted_edges(lattice.springs));
}

GeometricModel cubic_geometry(const CubicLattice& lattice) {
  const std::size_t dimensions = long_axes(lattice.points).size();
  const auto& [k1, k2, k3] = lattice.springs;
  if (dimensions == 3 && k1 + k2 + k3 > 0.0) return block_geometry(lattice);
  GeometricModelBuilder builder;
  builder.begin_subobject(lattice.name);
  add_points(builder, lattice);
  if (dimensions == 2) add_sheet(builder, lattice);
  if (dimensions == 1) add_rope(builder, lattice);
  return builder.finish();
}

// The share of the unit cells around an inner edge that hold the edge from p to q, or of those
// around an inner point when p == q: one half for every axis across which it lies in the surface.
double share_of_cells(const GridIndex& points, const GridIndex& p, const GridIndex& q) {
  double share = 1.0;
  for (int axis : long_axes(points)) {
    const bool in_surface = p[axis] == 0 || p[axis] == points[axis] - 1;
    if (p[axis] == q[axis] && in_surface) share *= 0.5;
  }
  return share;
}

double family_stiffness(const CubicSprings& springs, const GridIndex& p, const GridIndex& q) {
  const int differing = (p[0] != q[0]) + (p[1] != q[1]) + (p[2] != q[2]);
  return differing == 1   ? springs.axial
         : differing == 2 ? springs.face_diagonal
                          : springs.body_diagonal;
}

}  // namespace

PhysicalModel cubic_lattice(const CubicLattice& lattice) {
  require_usable(lattice);
  const GridIndex& n = lattice.points;
  const auto share = [&](const GridIndex& p, const GridIndex& q) {
    return lattice.surface == CubicSurface::kShared ? share_of_cells(n, p, q) : 1.0;
  };
  PhysicalModel model = with_default_attributes(cubic_geometry(lattice), lattice.name);
  for (PointId p : ids_of(model.points))
    model.points[p].mass = lattice.mass * share(index_of(n, p), index_of(n, p));
  for (EdgeId e : ids_of(model.edges)) {
    const auto& [a, b] = model.geometry.edges[e];
    const GridIndex p = index_of(n, a), q = index_of(n, b);
    EdgeAttributes& edge = model.edges[e];
    edge.stiffness = family_stiffness(lattice.springs, p, q) * share(p, q);
    edge.damping = lattice.damping_per_stiffness * edge.stiffness;
  }
  return model;
}

}  // namespace limber
