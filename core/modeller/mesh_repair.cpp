#include "core/modeller/mesh_repair.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "core/model/disjoint_sets.h"
#include "core/modeller/mesh_defects.h"
#include "core/modeller/winding_number.h"

namespace limber {
namespace {

constexpr std::int32_t kLoose = -1;

void turn(MeshTriangle& t) { std::swap(t[1], t[2]); }

double area_of(const TriangleMesh& mesh, const MeshTriangle& t) {
  const Vec3& a = mesh.positions[t[0]];
  return 0.5 * (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm();
}

void drop_useless(RepairedMesh& out) {
  std::map<MeshTriangle, std::size_t> seen;  // how often
  std::vector<MeshTriangle> kept;
  kept.reserve(out.mesh.triangles.size());
  for (const MeshTriangle& t : out.mesh.triangles) {
    const std::size_t times = ++seen[lowest_first(t)];
    out.most_copied = std::max(out.most_copied, times - 1);
    if (times > 1)
      ++out.doubled_triangles;
    else if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      ++out.collapsed_triangles;
    else
      kept.push_back(t);
  }
  out.mesh.triangles = std::move(kept);
}

// Triangles that share an edge with nobody else; `against` where they run the same way along it.
struct Neighbours {
  std::int32_t a = 0, b = 0;
  bool against = false;
};

std::vector<Neighbours> manifold_neighbours(const TriangleMesh& mesh) {
  const std::vector<MeshSide> sides = sorted_sides(mesh);
  std::vector<Neighbours> pairs;
  for (std::size_t i = 0, n = 0; i < sides.size(); i += n) {
    n = sides_of_edge(sides, i);
    if (n != 2) continue;
    const MeshSide &s = sides[i], &t = sides[i + 1];
    pairs.push_back({s.triangle, t.triangle, s.from == t.from});
  }
  return pairs;
}

// Patches of triangles joined by manifold edges.
struct Patches {
  std::vector<std::int32_t> of;       // triangle -> patch
  std::vector<std::uint8_t> against;  // triangle -> runs against the patch's first one
  std::int32_t count = 0;
};

struct Link {
  std::int32_t to = 0;
  bool against = false;
};

std::vector<std::vector<Link>> links_of(const TriangleMesh& mesh) {
  std::vector<std::vector<Link>> links(mesh.triangles.size());
  for (const Neighbours& pair : manifold_neighbours(mesh)) {
    links[pair.a].push_back({pair.b, pair.against});
    links[pair.b].push_back({pair.a, pair.against});
  }
  return links;
}

// A one-sided patch (a Moebius strip) has no orientation; it keeps whatever the walk finds first.
Patches patches_of(const TriangleMesh& mesh) {
  const std::vector<std::vector<Link>> links = links_of(mesh);
  Patches patches;
  patches.of.assign(mesh.triangles.size(), -1);
  patches.against.assign(mesh.triangles.size(), 0);
  std::vector<std::int32_t> stack;
  for (std::size_t first = 0; first < links.size(); ++first) {
    if (patches.of[first] >= 0) continue;
    patches.of[first] = patches.count;
    stack.push_back(static_cast<std::int32_t>(first));
    while (!stack.empty()) {
      const std::int32_t t = stack.back();
      stack.pop_back();
      for (const Link& link : links[t]) {
        if (patches.of[link.to] >= 0) continue;
        patches.of[link.to] = patches.count;
        patches.against[link.to] = patches.against[t] ^ static_cast<std::uint8_t>(link.against);
        stack.push_back(link.to);
      }
    }
    ++patches.count;
  }
  return patches;
}

void make_consistent(RepairedMesh& out, const Patches& patches) {
  std::vector<double> balance(patches.count, 0.0);  // m^2: area against - area with the first
  for (std::size_t i = 0; i < patches.of.size(); ++i) {
    const double area = area_of(out.mesh, out.mesh.triangles[i]);
    balance[patches.of[i]] += patches.against[i] ? area : -area;
  }
  for (std::size_t i = 0; i < patches.of.size(); ++i) {
    const bool minority_is_against = balance[patches.of[i]] <= 0.0;
    if (static_cast<bool>(patches.against[i]) != minority_is_against) continue;
    turn(out.mesh.triangles[i]);
    ++out.turned_triangles;
  }
}

void turn_whole(RepairedMesh& out) {
  if (solid_moments(out.mesh).volume >= 0.0) return;
  for (MeshTriangle& t : out.mesh.triangles) turn(t);
  out.turned_whole = true;
}

// m^3 of each patch, closed towards the middle of the whole mesh where it is open.
std::vector<double> volumes_of(const TriangleMesh& mesh, const Patches& patches) {
  const auto [low, high] = bounding_box(mesh);
  const Vec3 middle = 0.5 * (low + high);
  std::vector<double> volumes(patches.count, 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3 p = mesh.positions[a] - middle, q = mesh.positions[b] - middle;
    volumes[patches.of[i]] += p.dot(q.cross(mesh.positions[c] - middle)) / 6.0;
  }
  return volumes;
}

bool is_closed_patch(const std::vector<std::int32_t>& open, std::int32_t patch) {
  return !std::binary_search(open.begin(), open.end(), patch);
}

// Patches with an edge that is not of exactly two triangles, ascending.
std::vector<std::int32_t> open_patches(const TriangleMesh& mesh, const Patches& patches) {
  const std::vector<MeshSide> sides = sorted_sides(mesh);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0, n = 0; i < sides.size(); i += n) {
    n = sides_of_edge(sides, i);
    if (n == 2) continue;
    for (std::size_t k = 0; k < n; ++k) open.push_back(patches.of[sides[i + k].triangle]);
  }
  std::sort(open.begin(), open.end());
  open.erase(std::unique(open.begin(), open.end()), open.end());
  return open;
}

// Position -> its shell, a patch that is closed as it is; kLoose where other triangles use it. To
// join two shells that touch would make one patch of edges that nobody can tell apart.
std::vector<std::int32_t> shells_of(const TriangleMesh& mesh) {
  const Patches patches = patches_of(mesh);
  const std::vector<std::int32_t> open = open_patches(mesh, patches);
  std::vector<std::int32_t> shell(mesh.positions.size(), kLoose);
  const auto assign = [&](bool closed) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      if (is_closed_patch(open, patches.of[i]) == closed)
        for (std::int32_t c : mesh.triangles[i]) shell[c] = closed ? patches.of[i] : kLoose;
  };
  assign(true);
  assign(false);
  return shell;
}

// Each position -> the first equal one of its group.
std::vector<std::int32_t> first_equal(const std::vector<Vec3>& positions,
                                      const std::vector<std::int32_t>& group) {
  std::vector<std::int32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::int32_t i) {
    return std::tuple(group[i], positions[i].x(), positions[i].y(), positions[i].z());
  };
  std::sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) {
    return key(i) != key(j) ? key(i) < key(j) : i < j;
  });
  std::vector<std::int32_t> first(positions.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool equal = k > 0 && key(order[k - 1]) == key(order[k]);
    first[order[k]] = equal ? first[order[k - 1]] : order[k];
  }
  return first;
}

void join_positions(RepairedMesh& out) {
  const std::vector<std::int32_t> first = first_equal(out.mesh.positions, shells_of(out.mesh));
  std::vector<std::int32_t> renumbered(first.size());
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == static_cast<std::int32_t>(i)) {
      renumbered[i] = static_cast<std::int32_t>(kept.size());
      kept.push_back(out.mesh.positions[i]);
    } else {
      renumbered[i] = renumbered[first[i]];
      ++out.joined_positions;
    }
  }
  out.mesh.positions = std::move(kept);
  for (MeshTriangle& t : out.mesh.triangles)
    for (std::int32_t& corner : t) corner = renumbered[corner];
}

// Whether each patch has a vertex outside `around`; only patches that are `asked` about are looked
// at. One vertex inside does not make a cavity: a handle is stuck into its pot, too.
std::vector<std::uint8_t> reach_out(const TriangleMesh& mesh, const Patches& patches,
                                    const std::vector<std::uint8_t>& asked,
                                    const FastWindingNumber& around) {
  std::vector<std::uint8_t> out(patches.count, 0);
  for (std::size_t i = 0; i < patches.of.size(); ++i) {
    const std::int32_t patch = patches.of[i];
    if (!asked[patch]) continue;
    for (std::int32_t c : mesh.triangles[i])
      if (!out[patch]) out[patch] = around.at(mesh.positions[c]) < 0.5;
  }
  return out;
}

// Only closed patches are turned: of an open one nobody knows which side is out.
void turn_parts(RepairedMesh& out, const Patches& patches) {
  const std::vector<double> volumes = volumes_of(out.mesh, patches);
  const std::vector<std::int32_t> open = open_patches(out.mesh, patches);
  std::vector<std::uint8_t> negative(patches.count, 0);
  for (std::int32_t p = 0; p < patches.count; ++p)
    negative[p] = volumes[p] < 0.0 && is_closed_patch(open, p);
  TriangleMesh positive{out.mesh.name, out.mesh.positions, {}};
  for (std::size_t i = 0; i < patches.of.size(); ++i)
    if (volumes[patches.of[i]] > 0.0) positive.triangles.push_back(out.mesh.triangles[i]);
  const std::vector<std::uint8_t> inside_out =
      reach_out(out.mesh, patches, negative, FastWindingNumber(positive));
  out.turned_parts =
      static_cast<std::size_t>(std::count(inside_out.begin(), inside_out.end(), std::uint8_t{1}));
  for (std::size_t i = 0; i < patches.of.size(); ++i)
    if (inside_out[patches.of[i]]) turn(out.mesh.triangles[i]);
}

}  // namespace

RepairedMesh repaired(TriangleMesh mesh) {
  RepairedMesh out;
  out.mesh = std::move(mesh);
  join_positions(out);
  drop_useless(out);
  const Patches patches = patches_of(out.mesh);
  make_consistent(out, patches);
  turn_whole(out);
  turn_parts(out, patches);
  return out;
}

}  // namespace limber
