#include "tests/support/meshes.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>

namespace limber::test {
namespace {

constexpr double kPi = std::numbers::pi;

std::ofstream open(const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out.precision(std::numeric_limits<double>::max_digits10);
  return out;
}

template <class T>
void put(std::ostream& out, T value) {  // this machine's bytes: little-endian, as the files want
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::ostream& out, const Vec3& v) {
  for (Eigen::Index k = 0; k < 3; ++k) put(out, static_cast<float>(v[k]));
}

std::int32_t middle(TriangleMesh& mesh, std::map<std::pair<int, int>, std::int32_t>& known,
                    std::int32_t a, std::int32_t b, double radius) {
  const auto [entry, is_new] = known.try_emplace(std::minmax(a, b), 0);
  if (is_new) {
    entry->second = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.push_back(radius * (mesh.positions[a] + mesh.positions[b]).normalized());
  }
  return entry->second;
}

void quarter(TriangleMesh& mesh, double radius) {
  std::map<std::pair<int, int>, std::int32_t> known;
  std::vector<MeshTriangle> finer;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::int32_t ab = middle(mesh, known, a, b, radius);
    const std::int32_t bc = middle(mesh, known, b, c, radius);
    const std::int32_t ca = middle(mesh, known, c, a, radius);
    for (const MeshTriangle& t : {MeshTriangle{a, ab, ca}, MeshTriangle{ab, b, bc},
                                  MeshTriangle{ca, bc, c}, MeshTriangle{ab, bc, ca}})
      finer.push_back(t);
  }
  mesh.triangles = std::move(finer);
}

TriangleMesh icosahedron(double radius) {
  const double g = std::numbers::phi;
  TriangleMesh mesh{
      "icosphere",
      {{-1, g, 0},
       {1, g, 0},
       {-1, -g, 0},
       {1, -g, 0},
       {0, -1, g},
       {0, 1, g},
       {0, -1, -g},
       {0, 1, -g},
       {g, 0, -1},
       {g, 0, 1},
       {-g, 0, -1},
       {-g, 0, 1}},
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3& p : mesh.positions) p = radius * p.normalized();
  return mesh;
}

// A grid of squares that closes upon itself along its rows.
void add_band(TriangleMesh& mesh, std::int32_t first, std::int32_t second, std::int32_t n) {
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t j = (i + 1) % n;
    mesh.triangles.push_back({first + i, second + i, second + j});
    mesh.triangles.push_back({first + i, second + j, first + j});
  }
}

void add_fan(TriangleMesh& mesh, std::int32_t apex, std::int32_t ring, std::int32_t n, bool up) {
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t a = ring + i, b = ring + (i + 1) % n;
    mesh.triangles.push_back(up ? MeshTriangle{apex, a, b} : MeshTriangle{apex, b, a});
  }
}

std::int32_t add_ring(TriangleMesh& mesh, double radius, double height, std::int32_t n) {
  const auto first = static_cast<std::int32_t>(mesh.positions.size());
  for (std::int32_t i = 0; i < n; ++i) {
    const double u = 2.0 * kPi * i / n;
    mesh.positions.push_back({radius * std::cos(u), height, -radius * std::sin(u)});
  }
  return first;
}

void facet(std::ostream& out, const TriangleMesh& mesh, const MeshTriangle& t) {
  out << "facet normal 0 0 0\nouter loop\n";
  for (std::int32_t c : t) out << "vertex " << mesh.positions[c].transpose() << "\n";
  out << "endloop\nendfacet\n";
}

}  // namespace

TriangleMesh box_mesh(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh{"box", {}, {}};
  for (int c = 0; c < 8; ++c)
    mesh.positions.push_back(
        {c & 1 ? high.x() : low.x(), c & 2 ? high.y() : low.y(), c & 4 ? high.z() : low.z()});
  mesh.triangles = {{1, 3, 7}, {1, 7, 5}, {0, 4, 6}, {0, 6, 2}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

TriangleMesh icosphere(double radius, int times, const Vec3& centre) {
  TriangleMesh mesh = icosahedron(radius);
  for (int i = 0; i < times; ++i) quarter(mesh, radius);
  for (Vec3& p : mesh.positions) p += centre;
  return mesh;
}

TriangleMesh torus_mesh(double major_radius, double minor_radius, int around, int across) {
  TriangleMesh mesh{"torus", {}, {}};
  std::vector<std::int32_t> rings;
  for (int j = 0; j < across; ++j) {
    const double v = 2.0 * kPi * j / across;
    rings.push_back(add_ring(mesh, major_radius + minor_radius * std::cos(v),
                             minor_radius * std::sin(v), around));
  }
  for (int j = 0; j < across; ++j) add_band(mesh, rings[(j + 1) % across], rings[j], around);
  return mesh;
}

TriangleMesh hemisphere(double radius, int rings, double disc) {
  TriangleMesh mesh{"hemisphere", {{0, radius, 0}}, {}};
  const int n = 4 * rings;
  std::int32_t above = -1;
  for (int k = 1; k <= rings; ++k) {
    const double polar = 0.5 * kPi * k / rings;
    const std::int32_t ring = add_ring(mesh, radius * std::sin(polar), radius * std::cos(polar), n);
    if (above < 0)
      add_fan(mesh, 0, ring, n, true);
    else
      add_band(mesh, above, ring, n);
    above = ring;
  }
  if (disc <= 0.0) return mesh;
  const std::int32_t rim = add_ring(mesh, disc * radius, 0.0, n);
  mesh.positions.push_back(Vec3::Zero());
  add_fan(mesh, rim + n, rim, n, false);
  return mesh;
}

TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::int32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (MeshTriangle t : b.triangles) {
    for (std::int32_t& c : t) c += first;
    a.triangles.push_back(t);
  }
  return a;
}

TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh out{mesh.name, {}, {}};
  for (const MeshTriangle& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(out.positions.size());
    for (std::int32_t c : t) out.positions.push_back(mesh.positions[c]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

TriangleMesh inside_out(TriangleMesh mesh) { return with_flipped(std::move(mesh), 1); }

TriangleMesh with_flipped(TriangleMesh mesh, std::size_t step) {
  for (std::size_t i = 0; i < mesh.triangles.size(); i += step)
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Mat3& linear, const Vec3& shift) {
  for (Vec3& p : mesh.positions) p = linear * p + shift;
  return mesh;
}

void write_obj(const TriangleMesh& mesh, const std::filesystem::path& file) {
  std::ofstream out = open(file);
  for (const Vec3& p : mesh.positions) out << "v " << p.transpose() << "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    out << "f " << a + 1 << " " << b + 1 << " " << c + 1 << "\n";
}

void write_ply(const TriangleMesh& mesh, const std::filesystem::path& file) {
  std::ofstream out = open(file);
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
      << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : mesh.positions) out << p.transpose() << "\n";
  for (const auto& [a, b, c] : mesh.triangles) out << "3 " << a << " " << b << " " << c << "\n";
}

void write_ascii_stl(const TriangleMesh& mesh, const std::filesystem::path& file) {
  std::ofstream out = open(file);
  out << "solid " << mesh.name << "\n";
  for (const MeshTriangle& t : mesh.triangles) facet(out, mesh, t);
  out << "endsolid " << mesh.name << "\n";
}

void write_binary_stl(const TriangleMesh& mesh, const std::filesystem::path& file) {
  std::ofstream out = open(file);
  out << std::string(80, ' ');
  put(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const MeshTriangle& t : mesh.triangles) {
    put(out, Vec3(Vec3::Zero()));
    for (std::int32_t c : t) put(out, mesh.positions[c]);
    put(out, std::uint16_t{0});
  }
}

void write_gltf_twice(const TriangleMesh& mesh, const Vec3& shift,
                      const std::filesystem::path& file) {
  const auto bin = std::filesystem::path(file).replace_extension(".bin");
  {
    std::ofstream out = open(bin);
    for (const Vec3& p : mesh.positions) put(out, p);
    for (const MeshTriangle& t : mesh.triangles)
      for (std::int32_t c : t) put(out, static_cast<std::uint32_t>(c));
  }
  const auto [low, high] = bounding_box(mesh);
  const std::size_t vertex_bytes = 12 * mesh.positions.size();
  const std::size_t index_bytes = 12 * mesh.triangles.size();
  const auto list = [](const Vec3& v) {
    return "[" + std::to_string(v.x()) + "," + std::to_string(v.y()) + "," + std::to_string(v.z()) +
           "]";
  };
  open(file) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[)"
             << R"({"mesh":0},{"translation":)" << list(shift)
             << R"(,"children":[2]},{"mesh":0,"scale":[-1,1,1]}],"meshes":[{"primitives":[)"
             << R"({"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"uri":")"
             << bin.filename().string() << R"(","byteLength":)" << vertex_bytes + index_bytes
             << R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" << vertex_bytes
             << R"(},{"buffer":0,"byteOffset":)" << vertex_bytes << R"(,"byteLength":)"
             << index_bytes << R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)"
             << mesh.positions.size() << R"(,"type":"VEC3","min":)" << list(low) << R"(,"max":)"
             << list(high) << R"(},{"bufferView":1,"componentType":5125,"count":)"
             << 3 * mesh.triangles.size() << R"(,"type":"SCALAR"}]})";
}

}  // namespace limber::test
