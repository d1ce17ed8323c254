#include "core/modeller/material_table.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/model/errors.h"
#include "core/model/nearest_name.h"

namespace limber {
namespace {

// Sources, by author or number:
//   Ashby: Materials Selection in Mechanical Design, 4th ed., 2011, appendix A
//   Kaye and Laby: Tables of Physical and Chemical Constants, 16th ed., 1995
//   Wood Handbook: USDA Forest Products Laboratory, FPL-GTR-190, 2010, chapter 5
//   Morton and Hearle: Physical Properties of Textile Fibres, 4th ed., 2008
constexpr std::string_view kAshby = "Ashby 2011, appendix A";
constexpr std::string_view kWood =
    "USDA Wood Handbook FPL-GTR-190 (2010), chapter 5, 12 % moisture";

// kg/m^3, Pa, -, -, -, -, -
constexpr Material solid(double density, double modulus, double poisson_ratio, double strain,
                         double damping_ratio, double friction, double restitution) {
  Material m;
  m.density = density;
  m.youngs_modulus = modulus;
  m.poisson_ratio = poisson_ratio;
  m.strain_at_break = strain;
  m.damping_ratio = damping_ratio;
  m.friction = friction;
  m.restitution = restitution;
  return m;
}

constexpr std::array kTable = {
    NamedMaterial{"aluminium", solid(2700, 6.89e10, 0.33, 4.5e-3, 0.001, 1.0, 0.85), Basis::kStated,
                  "ASM Handbook, volume 2 (1990), alloy 6061-T6, typical: tensile strength 310 MPa "
                  "over modulus",
                  "flows from 4e-3 on; there is no plasticity here",
                  "density, modulus, Poisson ratio and strength: the Aluminum Association's "
                  "typical values on a supplier's data sheet"},
    NamedMaterial{"biscuit", solid(600, 5e7, 0.2, 1e-2, 0.03, 0.6, 0.3), Basis::kEstimate,
                  "Baltsavias et al., J. Texture Studies 28 (1997) 205: short-dough biscuits are "
                  "elastic and break at a small strain",
                  "differs tenfold with moisture and fat",
                  "elastic, small strain: the paper's abstract; no number"},
    NamedMaterial{"brick", solid(2000, 3e10, 0.2, 3.5e-4, 0.005, 0.8, 0.5), Basis::kMidRange,
                  kAshby, "modulus 10 to 50 GPa, tensile strength 7 to 14 MPa"},
    NamedMaterial{"concrete", solid(2400, 3.3e10, 0.2, 8.8e-5, 0.01, 0.8, 0.5), Basis::kStated,
                  "EN 1992-1-1 (2004), table 3.1, class C30/37: mean tensile strength 2.9 MPa over "
                  "modulus",
                  "without reinforcement",
                  "modulus and strength: the table as reprinted by buildinghow.com"},
    NamedMaterial{"foam", solid(50, 2e6, 0.3, 1.0, 0.1, 0.9, 0.6), Basis::kMidRange,
                  "Ashby 2011, appendix A, flexible polymer foam of low density; Poisson ratio: "
                  "Gibson and Ashby, Cellular Solids (1997)",
                  "real foam buckles beyond a few per cent of compression and gives way"},
    NamedMaterial{"gelatine", solid(1020, 1e4, 0.5, 0.7, 0.05, 0.4, 0.5), Basis::kEstimate,
                  "Bonavia, arXiv:2512.20502 (2025): 277 kPa with 2 parts of water to one, 4.3 kPa "
                  "with 20, a "
                  "power law; Bot et al., Polymer Gels and Networks 4 (1996) 189: large strains",
                  "a firm table jelly of about 7 %; 10 % has about 18 kPa",
                  "modulus: the abstract"},
    NamedMaterial{"glass", solid(2500, 7e10, 0.2, 6.4e-4, 5e-4, 0.95, 0.95), Basis::kStated,
                  "EN 572-1 (2012), soda-lime silicate: bending strength 45 MPa over modulus",
                  "flawless glass bears far more, scratched glass less: add_flaws()",
                  "all but the contact: makers' data sheets that quote EN 572"},
    NamedMaterial{"hemp", solid(1480, 3.2e10, 0.3, 2.2e-2, 0.02, 0.6, 0.3), Basis::kMidRange,
                  "Morton and Hearle 2008: tensile moduli and breaking extensions of fibres",
                  "of the fibre along itself; a laid rope is 5 to 20 times as soft and breaks at "
                  "about 0.1",
                  "density and strain: tables of natural fibres (1480, 0.8 to 3 %), which have 70 "
                  "GPa for the modulus"},
    NamedMaterial{"ice", solid(917, 9.33e9, 0.325, 1.5e-4, 0.005, 0.2, 0.6), Basis::kStated,
                  "Gammon et al., J. Glaciology 29 (1983) 433, -16 degC; tensile strength 1.4 MPa: "
                  "Petrovic, J. Materials Science 38 (2003) 1",
                  "strength 0.7 to 3.1 MPa; friction near melting is 0.02 and less",
                  "elastic constants: the paper's abstract (their Voigt-Reuss-Hill mean is 9.2 GPa "
                  "and 0.328); range of strength: the review's abstract"},
    NamedMaterial{"leaf", solid(800, 5e7, 0.3, 5e-2, 0.05, 0.5, 0.1), Basis::kEstimate,
                  "Niklas, Plant Biomechanics (1992)",
                  "fresh, of a tree; veins are stiffer than the blade between them"},
    NamedMaterial{"nylon", solid(1140, 3e9, 0.4, 0.2, 0.02, 0.5, 0.6), Basis::kMidRange,
                  "Morton and Hearle 2008, nylon 6.6: tensile moduli and breaking extensions of "
                  "fibres",
                  "of the fibre along itself; a laid rope is 3 to 10 times as soft"},
    NamedMaterial{"oak", solid(760, 1.23e10, 0.37, 8.5e-3, 0.01, 0.75, 0.5), Basis::kStated, kWood,
                  "white oak along the grain, bending strength 105 MPa over modulus; truly "
                  "orthotropic: across the grain ten to twenty times as soft, and as weak",
                  "density, modulus and strength within 3 %: The Wood Database, white oak"},
    NamedMaterial{"paper", solid(800, 4e9, 0.25, 1.5e-2, 0.02, 0.65, 0.2), Basis::kMidRange,
                  "Ashby, Materials and the Environment (2009): 480 to 860 kg/m^3, 3 to 8.9 GPa, "
                  "elongation 0.75 to 2 %",
                  "office paper; along the machine's direction twice as stiff as across",
                  "density, modulus and strain: the book's table"},
    NamedMaterial{"plaster", solid(1100, 4.5e9, 0.2, 1e-3, 0.005, 0.7, 0.4), Basis::kMidRange,
                  "Vekinis, Ashby and Beaumont, J. Materials Science 28 (1993) 3221",
                  "gypsum, set and dry, half of it pores"},
    NamedMaterial{
        "porcelain", solid(2400, 7e10, 0.2, 7e-4, 0.001, 0.6, 0.8), Basis::kMidRange,
        "IEC 60672-3 (1997), group C 110: at least 2200 kg/m^3, 60 GPa, flexural strength "
        "50 MPa; Kingery et al., Introduction to Ceramics (1976)",
        "modulus 60 to 80 GPa, strength 40 to 80 MPa",
        "density: tables of ceramics (2300 to 2400)"},
    NamedMaterial{"rubber", solid(925, 2e6, 0.499, 5.0, 0.05, 1.0, 0.85), Basis::kMidRange, kAshby,
                  "natural rubber; Hooke's law for what truly softens and stiffens again",
                  "strain: MatWeb (100 to 800 %), modulus: its 1.5 MPa at a strain of 1"},
    NamedMaterial{
        "spruce",
        solid(450, 1.08e10, 0.37, 6.5e-3, 0.01, 0.7, 0.5), Basis::kStated, kWood,
        "Sitka spruce along the grain, bending strength 70 MPa over modulus; truly "
        "orthotropic: across the grain ten to twenty times as soft, and as weak",
        "density: specific gravity 0.40 at 12 % moisture, of the Forest Products Laboratory"},
    NamedMaterial{
        "steel", solid(7850, 2.1e11, 0.29, 2.2e-3, 5e-4, 0.8, 0.9), Basis::kMidRange, kAshby,
        "low-carbon, tensile strength 460 MPa over modulus; flows from 1.5e-3 on, there is "
        "no plasticity here",
        "modulus, Poisson ratio and strength within 15 %: data sheets of AISI 1010 and 1020 (200 "
        "to 210 GPa, 0.29, 400 to 464 MPa)"},
    NamedMaterial{"stoneware", solid(2200, 5e10, 0.2, 7e-4, 0.002, 0.65, 0.7), Basis::kEstimate,
                  "Kingery et al., Introduction to Ceramics (1976): between porcelain and brick",
                  "modulus 30 to 60 GPa, flexural strength 25 to 50 MPa"},
    NamedMaterial{"terracotta", solid(1900, 1.5e10, 0.2, 6e-4, 0.005, 0.75, 0.5), Basis::kEstimate,
                  "Ashby 2011, appendix A, brick: fired lower, so lighter and softer",
                  "modulus 10 to 30 GPa, flexural strength 5 to 15 MPa"},
};

}  // namespace

std::string_view word_for(Basis basis) {
  switch (basis) {
    case Basis::kStated:
      return "stated";
    case Basis::kMidRange:
      return "middle of a range";
    case Basis::kEstimate:
      break;
  }
  return "estimate";
}

std::span<const NamedMaterial> named_materials() { return kTable; }

const NamedMaterial& material_named(std::string_view name) {
  const auto found = std::ranges::find(kTable, name, &NamedMaterial::name);
  if (found != kTable.end()) return *found;
  throw InputError({"material " + std::string(name), "there is none of that name",
                    "did you mean " + std::string(nearest_name(kTable, name)) +
                        "? docs/materials.md lists them all"});
}

}  // namespace limber
