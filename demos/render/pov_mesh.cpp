#include "demos/render/pov_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "demos/render/crease_normals.h"
#include "demos/render/pov_text.h"

namespace limber::demos {
namespace {

constexpr double kCrease_rad = 0.9;    // about 50 degrees: lips and handles stay crisp
constexpr double kLeastArea = 1e-14;   // m^2; POV-Ray rejects thinner triangles
constexpr double kLatticeLine = 0.03;  // radius of the drawn lines / length of an edge
const Vec3 kAmber = {1.0, 0.30, 0.0};  // linear RGB
const Vec3 kClay = {0.42, 0.11, 0.05};

Vec3 mixed(const Vec3& a, const Vec3& b, double share_of_b) {
  return (1.0 - share_of_b) * a + share_of_b * b;
}

std::string glazed(const SurfaceProperties& s) {
  return fmt::format(
      "texture {{ pigment {{ {} transmit {} }} finish {{ diffuse 0.75 ambient 0 specular {} "
      "roughness 0.012 reflection {{ {}, {} fresnel off falloff 3 }} conserve_energy }} }}\n",
      pov_colour(s.colour), pov(s.transparency), pov(1.4 * s.specularity),
      pov(0.02 * s.specularity), pov(0.5 * s.specularity));
}

std::string amber(const SurfaceProperties& s) {
  const Vec3 colour = mixed(s.colour, kAmber, 0.88);
  return fmt::format(
      "texture {{ pigment {{ {} transmit {} }} finish {{ diffuse 0.7 ambient 0 emission 0.4 "
      "specular 0.1 roughness 0.05 }} }}\n",
      pov_colour(colour), pov(s.transparency));
}

// Mottled at the size of a grain, bumpy, without any gloss; glass stays clear where it broke.
std::string broken(const SurfaceProperties& s, bool flexible) {
  const Vec3 clay = mixed(kClay, s.colour, 0.12);
  const Vec3 light = flexible ? mixed(clay, kAmber, 0.45) : Vec3(1.5 * clay);
  return fmt::format(
      "texture {{ pigment {{ granite colour_map {{ [0.2 {} transmit {}] [0.7 {} transmit {}] }} "
      "scale 0.012 }} "
      "normal {{ granite 0.5 scale 0.008 }} finish {{ diffuse 0.8 ambient 0 emission {} }} }}\n",
      pov_colour(0.6 * clay), pov(s.transparency), pov_colour(light), pov(s.transparency),
      flexible ? 0.15 : 0.0);
}

constexpr int kLooks = 4;  // textures per subobject, in the order of look_of

int look_of(const SurfaceTriangle& t, bool flexible) {
  return kLooks * std::max(t.subobject, 0) + (t.exposed_by_breaking ? 2 : 0) + (flexible ? 1 : 0);
}

std::string texture_list(const SurfaceModel& surface) {
  std::vector<SurfaceProperties> looks = surface.subobject_surfaces;
  if (looks.empty()) looks.emplace_back();
  std::string text = fmt::format("texture_list {{ {}\n", kLooks * looks.size());
  for (const SurfaceProperties& s : looks) {
    text += glazed(s) + amber(s) + broken(s, false) + broken(s, true);
  }
  return text + "}\n";
}

double area(const SurfaceModel& s, const SurfaceTriangle& t) {
  const auto at = [&](int c) {
    return s.points[static_cast<std::size_t>(t.corners[static_cast<std::size_t>(c)])];
  };
  return 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
}

std::vector<std::size_t> drawable_triangles(const SurfaceModel& s) {
  std::vector<std::size_t> list;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    // Written so that a triangle with NaN is kept: pov() then refuses it aloud.
    if (!(area(s, s.triangles[t]) < kLeastArea)) list.push_back(t);
  }
  return list;
}

std::string vertices(const SurfaceModel& s) {
  std::string text = fmt::format("vertex_vectors {{ {}", s.points.size());
  for (const Vec3& p : s.points) text.append(1, ',').append(pov(p));
  return text + " }\n";
}

// Three normals per triangle: neighbours need not agree, at creases and at the border of a break.
std::string normals(const SurfaceModel& s, const std::vector<std::size_t>& drawn) {
  const auto smooth = crease_normals(s, kCrease_rad);
  std::string text = fmt::format("normal_vectors {{ {}", 3 * drawn.size());
  for (std::size_t t : drawn) {
    for (const Vec3& n : smooth[t]) text.append(1, ',').append(pov(n));
  }
  return text + " }\n";
}

std::string faces(const Snapshot::Body& body, const std::vector<std::size_t>& drawn) {
  std::string text = fmt::format("face_indices {{ {}", drawn.size());
  for (std::size_t t : drawn) {
    const SurfaceTriangle& triangle = body.surface.triangles[t];
    const auto& [a, b, c] = triangle.corners;
    text += fmt::format(",<{},{},{}>,{}", a, b, c, look_of(triangle, body.flexible[t]));
  }
  text += fmt::format(" }}\nnormal_indices {{ {}", drawn.size());
  for (int i = 0; i < static_cast<int>(drawn.size()); ++i) {
    text += fmt::format(",<{},{},{}>", 3 * i, 3 * i + 1, 3 * i + 2);
  }
  return text + " }\n";
}

// The sides of the flexible triangles, each once, in the order of their points.
std::set<std::pair<int, int>> lattice_lines(const Snapshot::Body& body,
                                            const std::vector<std::size_t>& drawn) {
  std::set<std::pair<int, int>> lines;
  for (std::size_t t : drawn) {
    if (!body.flexible[t]) continue;
    const auto& c = body.surface.triangles[t].corners;
    for (std::size_t k = 0; k < 3; ++k) lines.insert(std::minmax(c[k], c[(k + 1) % 3]));
  }
  return lines;
}

double mean_length(const SurfaceModel& s, const std::set<std::pair<int, int>>& lines) {
  double sum = 0.0;
  for (const auto& [a, b] : lines) {
    sum += (s.points[static_cast<std::size_t>(a)] - s.points[static_cast<std::size_t>(b)]).norm();
  }
  return sum / static_cast<double>(lines.size());
}

std::string lattice(const Snapshot::Body& body, const std::vector<std::size_t>& drawn) {
  const auto lines = lattice_lines(body, drawn);
  if (lines.empty()) return "";
  const std::string radius = pov(kLatticeLine * mean_length(body.surface, lines));
  std::string text = "union {\n";
  for (const auto& [a, b] : lines) {
    text += fmt::format("cylinder {{ {},{},{} }}\n",
                        pov(body.surface.points[static_cast<std::size_t>(a)]),
                        pov(body.surface.points[static_cast<std::size_t>(b)]), radius);
  }
  return text + "texture { LatticeLine }\n}\n";
}

constexpr double kOpaque = 0.0;  // instead of an index of refraction

double refraction_of(const SurfaceModel& surface, const SurfaceTriangle& t) {
  const auto subobject = static_cast<std::size_t>(std::max(t.subobject, 0));
  if (subobject >= surface.subobject_surfaces.size()) return kOpaque;
  const SurfaceProperties& s = surface.subobject_surfaces[subobject];
  return s.transparency > 0.0 ? s.index_of_refraction : kOpaque;
}

// POV-Ray's meshes have one interior each: the triangles by what light does behind them.
std::map<double, std::vector<std::size_t>> by_refraction(const SurfaceModel& surface,
                                                         const std::vector<std::size_t>& drawn) {
  std::map<double, std::vector<std::size_t>> parts;
  for (std::size_t t : drawn) parts[refraction_of(surface, surface.triangles[t])].push_back(t);
  return parts;
}

std::string mesh(const Snapshot::Body& body, double refraction,
                 const std::vector<std::size_t>& drawn) {
  const std::string interior =
      refraction == kOpaque ? "" : fmt::format("interior {{ ior {} }}\n", pov(refraction));
  return "mesh2 {\n" + vertices(body.surface) + normals(body.surface, drawn) +
         texture_list(body.surface) + faces(body, drawn) + interior + "}\n";
}

std::string strand(const Snapshot::RopeLength& s) {
  // Round joints where lengths meet; POV-Ray wants no cylinder without length.
  std::string text = fmt::format("union {{ sphere {{ {},{} }} sphere {{ {},{} }} ", pov(s.a),
                                 pov(s.radius), pov(s.b), pov(s.radius));
  if ((s.b - s.a).norm() > 1e-9) {
    text += fmt::format("cylinder {{ {},{},{} }} ", pov(s.a), pov(s.b), pov(s.radius));
  }
  return text + (s.flexible ? amber(s.surface) : glazed(s.surface)) + "}\n";
}

}  // namespace

std::string pov_body(const Snapshot::Body& body) {
  const auto drawn = drawable_triangles(body.surface);
  std::string text;
  for (const auto& [refraction, triangles] : by_refraction(body.surface, drawn))
    text += mesh(body, refraction, triangles);
  for (const Snapshot::RopeLength& s : body.strands) text += strand(s);
  return text + lattice(body, drawn);
}

}  // namespace limber::demos
