#include "demos/render/pov_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "demos/render/pov_mesh.h"
#include "demos/render/pov_text.h"

namespace limber::demos {
namespace {

// Linear colours; the horizon of the sky is what the far floor fades into.
constexpr const char* kPrelude = R"(#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 6 }
#declare Horizon = rgb <0.74,0.76,0.76>;
sky_sphere { pigment { gradient y colour_map { [0 Horizon] [0.5 rgb <0.20,0.36,0.62>] } } }
#declare LatticeLine = texture {
  pigment { rgb <0.16,0.02,0.00> } finish { diffuse 0.5 ambient 0 }
}
// A box with rounded edges, centred at the origin.
#macro Rounded_Box(H, R)
  #local I = H - <R,R,R>;
  union {
    box { <-H.x,-I.y,-I.z>, <H.x,I.y,I.z> }
    box { <-I.x,-H.y,-I.z>, <I.x,H.y,I.z> }
    box { <-I.x,-I.y,-H.z>, <I.x,I.y,H.z> }
    #for (A, -1, 1, 2) #for (B, -1, 1, 2)
      cylinder { <-I.x,A*I.y,B*I.z>, <I.x,A*I.y,B*I.z>, R }
      cylinder { <A*I.x,-I.y,B*I.z>, <A*I.x,I.y,B*I.z>, R }
      cylinder { <A*I.x,B*I.y,-I.z>, <A*I.x,B*I.y,I.z>, R }
      sphere { <-I.x,A*I.y,B*I.z>, R }
      sphere { <I.x,A*I.y,B*I.z>, R }
    #end #end
  }
#end
)";

constexpr const char* kFloor = R"(plane { y, 0
  pigment { checker rgb <0.52,0.49,0.44>, rgb <0.40,0.375,0.34> scale 0.25 }
  finish { diffuse 0.75 ambient 0 reflection { 0.02, 0.12 falloff 4 } }
}
)";

constexpr double kBevel = 0.08;  // of a box's smallest half extent
constexpr double kMostBevel_m = 0.006;

Vec3 view(const Camera& camera) {
  const Vec3 v = camera.target - camera.position;
  return v.norm() > 1e-9 ? v : Vec3(0.0, 0.0, -1.0);
}

// Straight up or down there is no "up" in the picture; north is taken.
Vec3 sky_vector(const Vec3& direction) {
  return direction.normalized().cross(Vec3::UnitY()).norm() > 1e-4 ? Vec3::UnitY()
                                                                   : Vec3(0.0, 0.0, -1.0);
}

// POV-Ray wants the horizontal angle of view, degrees.
double horizontal_angle(double vertical_deg, double aspect) {
  const double half = std::clamp(vertical_deg, 1.0, 170.0) * M_PI / 360.0;
  return 2.0 * std::atan(std::tan(half) * aspect) * 180.0 / M_PI;
}

std::string camera_text(const Camera& camera, const PictureSize& size) {
  const Vec3 direction = view(camera);
  const double aspect = static_cast<double>(size.width) / size.height;
  return fmt::format(
      "camera {{ perspective location {} sky {} up y right -x*{} angle {} look_at {} }}\n",
      pov(camera.position), pov(sky_vector(direction)), pov(aspect),
      pov(horizontal_angle(camera.field_of_view_deg, aspect)),
      pov(Vec3(camera.position + direction)));
}

// A soft key light over the photographer's left shoulder, a weak one from the right without
// shadows, and fog that takes the floor into the horizon. All scale with the distance.
std::string light_text(const Camera& camera) {
  const Vec3 v = view(camera);
  const double d = v.norm();
  const Vec3 back = -v / d;
  const Vec3 right = v.cross(sky_vector(v)).normalized();
  const Vec3 up = Vec3::UnitY();
  const Vec3 key = camera.target + d * (-1.2 * right + 2.0 * up + 1.3 * back);
  const Vec3 fill = camera.target + d * (2.0 * right + 0.8 * up + 1.5 * back);
  return fmt::format(
      "light_source {{ {} rgb <1.00,0.95,0.88>*1.55 area_light {},{}, 9,9 adaptive 1 circular "
      "orient }}\n"
      "light_source {{ {} rgb <0.92,0.96,1.00>*0.24 shadowless }}\n"
      "light_source {{ {} rgb <0.92,0.96,1.00>*0.12 shadowless }}\n"
      "fog {{ distance {} Horizon }}\n",
      pov(key), pov(Vec3(0.5 * d * Vec3::UnitX())), pov(Vec3(0.5 * d * Vec3::UnitZ())), pov(fill),
      pov(Vec3(camera.target + 5.0 * d * up)), pov(30.0 * d));
}

std::string pose_text(const Mat3& r, const Vec3& t) {
  // POV-Ray's rows are the images of the axes: our columns.
  const Vec3 x = r.col(0), y = r.col(1), z = r.col(2);
  return fmt::format("matrix <{},{},{}, {},{},{}, {},{},{}, {},{},{}>", pov(x.x()), pov(x.y()),
                     pov(x.z()), pov(y.x()), pov(y.y()), pov(y.z()), pov(z.x()), pov(z.y()),
                     pov(z.z()), pov(t.x()), pov(t.y()), pov(t.z()));
}

// Any colour with a faint grain along x; wood-coloured boxes look like wood.
std::string box_texture(const Vec3& colour) {
  return fmt::format(
      "texture {{ pigment {{ wood turbulence 0.06 octaves 3 colour_map {{ [0 {0}] [0.7 {1}] [1 "
      "{0}] "
      "}} rotate <2,88,0> scale <0.25,0.018,0.018> translate <0,0.07,0.05> }} finish {{ diffuse "
      "0.75 ambient 0 specular 0.15 roughness 0.04 }} }}",
      pov_colour(colour), pov_colour(0.72 * colour));
}

// What POV-Ray draws for a shape, without texture and place.
struct ShapeText {
  std::string operator()(const bullet::BoxShape& box) const {
    const double bevel = std::min(kBevel * box.half_extents.minCoeff(), kMostBevel_m);
    return fmt::format("object {{ Rounded_Box({}, {})", pov(box.half_extents), pov(bevel));
  }
  std::string operator()(const bullet::SphereShape& sphere) const {
    return fmt::format("sphere {{ <0,0,0>, {}", pov(sphere.radius));
  }
  std::string operator()(const bullet::CapsuleShape& capsule) const {
    const std::string low = pov(Vec3(0.0, -0.5 * capsule.height, 0.0));
    const std::string high = pov(Vec3(0.0, 0.5 * capsule.height, 0.0));
    return fmt::format(
        "union {{ cylinder {{ {0}, {1}, {2} }} sphere {{ {0}, {2} }} "
        "sphere {{ {1}, {2} }}",
        low, high, pov(capsule.radius));
  }
  std::string operator()(const bullet::CylinderShape& cylinder) const {
    return round_text(cylinder.height, cylinder.radius, cylinder.radius);
  }
  std::string operator()(const bullet::ConeShape& cone) const {
    return round_text(cone.height, cone.radius, 0.0);
  }
  std::string operator()(const bullet::HullShape& hull) const { return mesh_text(hull); }
  std::string operator()(const bullet::MeshShape& mesh) const { return mesh_text(mesh); }
  std::string operator()(const bullet::TerrainShape& terrain) const { return mesh_text(terrain); }
  std::string operator()(const bullet::CompoundShape& compound) const {
    std::string text = "union {";
    for (const bullet::CompoundShape::Part& part : compound.parts) {
      text += fmt::format(" {} {} }}", std::visit(*this, part.shape),
                          pose_text(part.rotation, part.centre));
    }
    return text;
  }

  static std::string round_text(double height, double low_radius, double high_radius) {
    return fmt::format("cone {{ <0,{},0>, {}, <0,{},0>, {}", pov(-0.5 * height), pov(low_radius),
                       pov(0.5 * height), pov(high_radius));
  }

  static std::string mesh_text(const bullet::StageShape& shape) {
    const bullet::TriangleList list = bullet::triangles_of(shape);
    std::string text = "mesh {";
    for (const auto& t : list.triangles) {
      text += fmt::format(" triangle {{ {},{},{} }}", pov(list.positions[std::size_t(t[0])]),
                          pov(list.positions[std::size_t(t[1])]),
                          pov(list.positions[std::size_t(t[2])]));
    }
    return text;
  }
};

std::string rigid_text(const Snapshot::Rigid& rigid) {
  return fmt::format("{} {} {} }}\n", std::visit(ShapeText{}, rigid.body.shape),
                     box_texture(rigid.body.colour), pose_text(rigid.rotation, rigid.centre));
}

std::string own_light_text(const Light& light) {
  return fmt::format("light_source {{ {} rgb {}{} }}\n", pov(light.position), pov(light.colour),
                     light.shadows ? "" : " shadowless");
}

std::string lights_of(const Snapshot& snapshot) {
  if (snapshot.lights.empty()) return light_text(snapshot.camera);
  std::string text;
  for (const Light& light : snapshot.lights) text += own_light_text(light);
  return text;
}

}  // namespace

std::string pov_scene(const Snapshot& snapshot, const PictureSize& size) {
  std::string text = kPrelude;
  text += camera_text(snapshot.camera, size) + lights_of(snapshot);
  if (snapshot.floor) text += kFloor;
  for (const Snapshot::Rigid& rigid : snapshot.rigid) text += rigid_text(rigid);
  for (const Snapshot::Body& body : snapshot.bodies) text += pov_body(body);
  return text;
}

}  // namespace limber::demos
