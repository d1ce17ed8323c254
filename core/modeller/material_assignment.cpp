#include "core/modeller/material_assignment.h"

#include <algorithm>

#include "core/model/diagnostic_list.h"
#include "core/modeller/cell_shape.h"
#include "core/modeller/cell_stiffness.h"

namespace limber {
namespace {

void require_valid_list(std::span<const Material> materials, const std::string& name) {
  if (materials.empty())
    throw InputError({name + ": material", "there is none", "give at least one"});
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const bool only_one = materials.size() == 1;
    require_valid(materials[m], only_one ? name + ": material" : say(name, ": material ", m));
  }
}

// The value that all materials agree on.
double agreed(std::span<const Material> materials, double Material::*value, const char* quantity,
              const char* remedy, const std::string& name) {
  for (std::size_t m = 1; m < materials.size(); ++m) {
    if (materials[m].*value == materials[0].*value) continue;
    throw InputError({say(name, ": material ", m),
                      say(quantity, " is ", materials[m].*value, ", that of material 0 is ",
                          materials[0].*value, "; an object has one"),
                      remedy});
  }
  return materials[0].*value;
}

struct ObjectChoice {
  ObjectAttributes attributes;
  double damping_ratio = 0.0;
};

ObjectChoice whole_object(std::span<const Material> materials, const WholeObjectValues& whole,
                          const std::string& name) {
  const auto stated_or_agreed = [&](std::optional<double> stated, double Material::*value,
                                    const char* quantity) {
    if (stated) return *stated;
    return agreed(materials, value, quantity, "state it in WholeObjectValues", name);
  };
  ObjectChoice choice;
  ObjectAttributes& object = choice.attributes;
  object.softening = agreed(materials, &Material::softening, "softening",
                            "give all the same S, or make two objects", name);
  object.friction = stated_or_agreed(whole.friction, &Material::friction, "friction");
  object.restitution = stated_or_agreed(whole.restitution, &Material::restitution, "restitution");
  object.internal_damping =
      stated_or_agreed(whole.internal_damping, &Material::internal_damping, "internal damping");
  choice.damping_ratio =
      stated_or_agreed(whole.damping_ratio, &Material::damping_ratio, "damping ratio");
  Material stated = materials[0];  // what was stated has the same bounds
  stated.friction = object.friction;
  stated.restitution = object.restitution;
  stated.internal_damping = object.internal_damping;
  stated.damping_ratio = choice.damping_ratio;
  require_valid(stated, name + ": whole object");
  return choice;
}

// Sums what the cells bring.
class CellSums {
 public:
  CellSums(PhysicalModel& model, std::span<const Material> materials, const MaterialChoice& which)
      : model_(model),
        materials_(materials),
        which_(which),
        cells_of_material_(materials.size(), 0),
        in_a_cell_(model.edges.size(), false) {
    for (PointAttributes& point : model.points) point.mass = 0.0;
    for (EdgeAttributes& edge : model.edges) edge.stiffness = 0.0;
  }

  void add_all() {
    for (const Subobject& part : model_.geometry.subobjects) {
      for (std::int32_t c = part.cells.begin; c < part.cells.end; ++c) {
        add(CellId(static_cast<std::size_t>(c)), part.name);
      }
    }
    require_all_used();
    require_every_element_in_a_cell();
    for (EdgeAttributes& edge : model_.edges) {  // strains until here
      edge.break_threshold *= edge.rest_length;
      edge.crush_threshold *= edge.rest_length;
    }
  }

 private:
  void add(CellId c, const std::string& part) {
    const Cell& cell = model_.geometry.cells[c];
    shape_.read(model_.geometry, cell);
    const Material& material = chosen({c, centre(), part});
    const double volume = cell_volume(model_.geometry, c);
    if (!(volume > 0.0)) {
      throw InputError(
          {say(model_.name, ": cell ", c.index()), say("its volume is ", volume * 1e9, " mm^3"),
           "turn its faces outward, or thin the wall where the surface curves more than that"});
    }
    add_mass(material.density * volume);
    add_springs(cell, volume, material);
  }

  Vec3 centre() const {
    Vec3 sum = Vec3::Zero();
    for (PointId p : shape_.points) sum += model_.geometry.points[p];
    return sum / static_cast<double>(shape_.points.size());
  }

  const Material& chosen(const CellPlace& place) {
    const std::size_t m = which_(place);
    if (m < materials_.size()) {
      ++cells_of_material_[m];
      return materials_[m];
    }
    throw InputError(
        {say(model_.name, ": cell ", place.cell.index(), " of subobject ", place.subobject),
         m == kNoMaterial ? std::string("no material is chosen for it")
                          : say("material ", m, " is chosen for it, there are ", materials_.size()),
         "cover every cell, or say what the others get"});
  }

  void add_mass(double mass) {
    const double share = mass / static_cast<double>(shape_.points.size());
    for (PointId p : shape_.points) model_.points[p].mass += share;
  }

  void add_springs(const Cell& cell, double volume, const Material& material) {
    const CellFit& fit = fitter_.fit(shape_.edges);
    const double scale = fit.stiffness_per_weight(volume, material.effective_modulus());
    const double strain_at_break = material.effective_strain_at_break();
    const double strain_at_crush = material.effective_strain_at_crush();
    for (std::size_t i = 0; i < cell.edges.size(); ++i) {
      EdgeAttributes& edge = model_.edges[cell.edges[i]];
      edge.stiffness += fit.weights[i] * scale;
      edge.break_threshold = std::min(edge.break_threshold, strain_at_break);
      edge.crush_threshold = std::min(edge.crush_threshold, strain_at_crush);
      in_a_cell_[cell.edges[i].index()] = true;
    }
  }

  void require_all_used() const {
    const auto unused = std::find(cells_of_material_.begin(), cells_of_material_.end(), 0u);
    // A model without cells is refused for its points and edges.
    if (unused == cells_of_material_.end() || model_.cells.empty()) return;
    throw InputError({say(model_.name, ": material ", unused - cells_of_material_.begin()),
                      "no cell has it", "check the names or regions, or leave it out"});
  }

  void require_every_element_in_a_cell() const {
    const auto bare = std::find(in_a_cell_.begin(), in_a_cell_.end(), false);
    if (bare != in_a_cell_.end()) {
      throw InputError({say(model_.name, ": edge ", bare - in_a_cell_.begin()),
                        "it belongs to no cell, so the material gives it no stiffness",
                        "put it into a cell or set its attributes yourself"});
    }
    const auto massless =
        std::find_if(model_.points.begin(), model_.points.end(),
                     [](const PointAttributes& point) { return !(point.mass > 0.0); });
    if (massless == model_.points.end()) return;
    throw InputError({say(model_.name, ": point ", massless - model_.points.begin()),
                      "it belongs to no cell, so the material gives it no mass",
                      "put it into a cell or leave it out"});
  }

  PhysicalModel& model_;
  std::span<const Material> materials_;
  const MaterialChoice& which_;
  std::vector<std::size_t> cells_of_material_;
  std::vector<bool> in_a_cell_;  // shape (edges)
  CellFitter fitter_;
  CellShape shape_;  // of the present cell
};

}  // namespace

PhysicalModel with_materials(GeometricModel geometry, std::string name,
                             std::span<const Material> materials, const MaterialChoice& which,
                             const WholeObjectValues& whole) {
  require_valid_list(materials, name);
  const ObjectChoice object = whole_object(materials, whole, name);
  PhysicalModel model = with_default_attributes(std::move(geometry), std::move(name));
  CellSums(model, materials, which).add_all();
  set_stiffness_proportional_damping(model, object.damping_ratio);
  model.object = object.attributes;
  return model;
}

MaterialChoice by_subobject(std::vector<std::pair<std::string, std::size_t>> index_of_name,
                            std::size_t otherwise) {
  return [list = std::move(index_of_name), otherwise](const CellPlace& place) {
    for (const auto& [name, index] : list)
      if (name == place.subobject) return index;
    return otherwise;
  };
}

Region in_box(const Vec3& low_m, const Vec3& high_m) {
  return [=](const Vec3& x) {
    return (x.array() >= low_m.array()).all() && (x.array() <= high_m.array()).all();
  };
}

Region in_sphere(const Vec3& centre_m, double radius_m) {
  return [=](const Vec3& x) { return (x - centre_m).norm() <= radius_m; };
}

Region in_half_space(const Vec3& point_m, const Vec3& inward) {
  return [=](const Vec3& x) { return (x - point_m).dot(inward) >= 0.0; };
}

MaterialChoice by_region(std::vector<std::pair<Region, std::size_t>> index_of_region,
                         std::size_t otherwise) {
  return [list = std::move(index_of_region), otherwise](const CellPlace& place) {
    for (const auto& [contains, index] : list)
      if (contains(place.centre)) return index;
    return otherwise;
  };
}

std::vector<EdgeId> edges_in(const GeometricModel& geometry, const Region& region) {
  std::vector<EdgeId> found;
  for (std::size_t i = 0; i < geometry.edges.size(); ++i) {
    const auto [a, b] = geometry.edges[EdgeId(i)];
    if (region(0.5 * (geometry.points[a] + geometry.points[b]))) found.push_back(EdgeId(i));
  }
  return found;
}

}  // namespace limber
