#include "core/modeller/glue_material.h"

#include <cmath>

#include "core/model/diagnostic_list.h"

namespace limber {

GlueBond bond_like(const Material& material, double area_per_bond_m2, double gap_m) {
  require_valid(material, "glue: material");
  const auto require = [](double x, const char* what) {
    if (x > 0.0 && std::isfinite(x)) return;
    throw InputError({"glue bond", say(what, " is ", x), "give a finite value above 0"});
  };
  require(area_per_bond_m2, "area per bond (m^2)");
  require(gap_m, "gap (m)");
  GlueBond bond;
  bond.distance = gap_m;
  bond.stiffness = material.effective_modulus() * area_per_bond_m2 / gap_m;
  bond.break_strain = material.effective_strain_at_break();
  bond.crush_strain = material.effective_strain_at_crush();
  return bond;
}

}  // namespace limber
