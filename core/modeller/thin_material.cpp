#include "core/modeller/thin_material.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/modeller/plane_fit.h"
#include "core/modeller/shape_checks.h"

namespace limber {
namespace {

// A_iijj of the tensor that sheets are fitted to, in units of E t.
constexpr double kThinIsotropicTrace = 3.0;

PhysicalModel without_mass(GeometricModel geometry, std::string name) {
  PhysicalModel model = with_default_attributes(std::move(geometry), std::move(name));
  for (PointAttributes& point : model.points) point.mass = 0.0;
  return model;
}

void require_empty(std::size_t count, const PhysicalModel& model, const std::string& what,
                   const std::string& remedy) {
  if (count > 0) throw InputError({model.name, say("it has ", count, " ", what), remedy});
}

void require_masses(const PhysicalModel& model, const std::string& holder) {
  for (PointId p : ids_of(model.points)) {
    if (model.points[p].mass > 0.0) continue;
    throw InputError({say(model.name, ": point ", p.value),
                      "it belongs to no " + holder + ", so the material gives it no mass",
                      "join it to the others or leave it out"});
  }
}

double edge_length(const PhysicalModel& model, EdgeId e) {
  const auto& [a, b] = model.geometry.edges[e];
  return (model.geometry.points[b] - model.geometry.points[a]).norm();
}

void set_thresholds(PhysicalModel& model, const Material& material) {
  for (EdgeAttributes& edge : model.edges) {
    edge.break_threshold = material.effective_strain_at_break() * edge.rest_length;
    edge.crush_threshold = material.effective_strain_at_crush() * edge.rest_length;
  }
}

void set_object(PhysicalModel& model, const Material& material) {
  model.object.friction = material.friction;
  model.object.restitution = material.restitution;
  model.object.internal_damping = material.internal_damping;
  model.object.softening = material.softening;
}

// Everything but masses and spring constants.
void finish(PhysicalModel& model, const Material& material) {
  set_thresholds(model, material);
  set_stiffness_proportional_damping(model, material.damping_ratio);
  set_object(model, material);
}

// Sum of the faces' areas as vectors (zero for a closed cell) and as numbers, m^2.
struct CellArea {
  Vec3 vector = Vec3::Zero();
  double total = 0.0;
};

CellArea area_of(const GeometricModel& model, const Cell& cell) {
  CellArea area;
  for (FaceId f : cell.faces) {
    const auto& [a, b, c] = model.faces[f].corners;
    const Vec3 cross = (model.points[b] - model.points[a]).cross(model.points[c] - model.points[a]);
    area.vector += 0.5 * cross;
    area.total += 0.5 * cross.norm();
  }
  return area;
}

void require_flat(const CellArea& area, CellId c, const PhysicalModel& model) {
  const std::string where = say(model.name, ": cell ", c.value);
  if (!(area.total > 0.0)) {
    throw InputError({where, "it has no area", "draw its corners apart or leave it out"});
  }
  if (area.vector.norm() > 1e-6 * area.total) return;
  throw InputError({where, "it is closed, not a part of a sheet",
                    "give solids their attributes by with_material()"});
}

// An equal share of the mass to each corner.
void add_cell_mass(PhysicalModel& model, const Cell& cell, double mass) {
  std::vector<PointId> corners;
  for (FaceId f : cell.faces) {
    for (PointId p : model.geometry.faces[f].corners) corners.push_back(p);
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (PointId p : corners) model.points[p].mass += mass / static_cast<double>(corners.size());
}

void add_cell_stiffness(PhysicalModel& model, const Cell& cell, const CellArea& area,
                        double modulus_thickness) {
  std::vector<Vec3> vectors;
  for (EdgeId e : cell.edges) {
    const auto& [a, b] = model.geometry.edges[e];
    vectors.push_back(model.geometry.points[b] - model.geometry.points[a]);
  }
  const std::vector<double> stiffness =
      isotropic_sheet_stiffness(vectors, area.vector, area.total, modulus_thickness);
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    model.edges[cell.edges[i]].stiffness += stiffness[i];
  }
}

void require_every_edge_in_a_cell(const PhysicalModel& model) {
  const IndexRows cells = edge_cells(model.geometry);
  for (EdgeId e : ids_of(model.edges)) {
    if (!cells[e.index()].empty()) continue;
    throw InputError({say(model.name, ": edge ", e.value),
                      "it belongs to no cell, so the material gives it no stiffness",
                      "put it into a cell, or glue what is no sheet to it afterwards"});
  }
}

}  // namespace

double round_section(double diameter_m) {
  require_positive("rope", "diameter", diameter_m, "m");
  return 0.25 * std::numbers::pi * diameter_m * diameter_m;
}

PhysicalModel with_rope_material(GeometricModel geometry, std::string name,
                                 const Material& material, double section_m2) {
  require_valid(material, name + ": material");
  require_positive(name, "cross-section", section_m2, "m^2");
  PhysicalModel model = without_mass(std::move(geometry), std::move(name));
  require_empty(model.cells.size(), model, "cells",
                "give sheets and solids their attributes by functions of their own");
  for (EdgeId e : ids_of(model.edges)) {
    const double length = edge_length(model, e);
    require_positive(say(model.name, ": edge ", e.value), "length", length, "m");
    model.edges[e].stiffness = material.effective_modulus() * section_m2 / length;
    const auto& [a, b] = model.geometry.edges[e];
    for (PointId p : {a, b}) model.points[p].mass += 0.5 * material.density * section_m2 * length;
  }
  require_masses(model, "edge");
  finish(model, material);
  for (SubobjectAttributes& part : model.parts) {
    part.surface.strand_radius = std::sqrt(section_m2 / std::numbers::pi);
  }
  return model;
}

std::vector<double> isotropic_sheet_stiffness(std::span<const Vec3> edges_m, const Vec3& normal,
                                              double area_m2, double modulus_thickness_N_m) {
  const Eigen::VectorXd share = isotropic_plane_fit(edges_m, normal);  // k_e l_e^2 / (Et area)
  const double scale = kThinIsotropicTrace * modulus_thickness_N_m * area_m2 / share.sum();
  std::vector<double> stiffness;
  for (std::size_t e = 0; e < edges_m.size(); ++e) {
    stiffness.push_back(scale * share[static_cast<Eigen::Index>(e)] / edges_m[e].squaredNorm());
  }
  return stiffness;
}

PhysicalModel with_sheet_material(GeometricModel geometry, std::string name,
                                  const Material& material, const SheetProperties& sheet) {
  require_valid(material, name + ": material");
  require_positive(name, "thickness", sheet.thickness, "m");
  PhysicalModel model = without_mass(std::move(geometry), std::move(name));
  require_every_edge_in_a_cell(model);
  for (CellId c : ids_of(model.geometry.cells)) {
    const Cell& cell = model.geometry.cells[c];
    const CellArea area = area_of(model.geometry, cell);
    require_flat(area, c, model);
    add_cell_mass(model, cell, material.density * sheet.thickness * area.total);
    add_cell_stiffness(model, cell, area, material.effective_modulus() * sheet.thickness);
  }
  require_masses(model, "cell");
  for (FaceAttributes& face : model.faces) face = sheet.faces;
  finish(model, material);
  return model;
}

Particle ball_particle(double density_kg_m3, double radius_m) {
  require_positive("particle", "density", density_kg_m3, "kg/m^3");
  require_positive("particle", "radius", radius_m, "m");
  Particle particle;
  particle.mass = density_kg_m3 * 4.0 / 3.0 * std::numbers::pi * radius_m * radius_m * radius_m;
  particle.radius = radius_m;
  return particle;
}

PhysicalModel with_particles(GeometricModel geometry, std::string name, const Particle& particle) {
  require_positive(name, "the mass of a particle", particle.mass, "kg");
  PhysicalModel model = without_mass(std::move(geometry), std::move(name));
  require_empty(model.edges.size(), model, "edges", "give it rope, sheet or solid material");
  for (PointAttributes& point : model.points) point.mass = particle.mass;
  model.object.friction = particle.friction;
  model.object.restitution = particle.restitution;
  model.object.particle_radius = particle.radius;
  for (SubobjectAttributes& part : model.parts) part.surface.strand_radius = particle.radius;
  require_valid(model);
  return model;
}

}  // namespace limber
