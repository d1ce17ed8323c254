#pragma once

#include <vector>

#include "core/dynamics/lattice.h"
#include "core/dynamics/rigid_motion.h"

namespace limber::reference {

// The lattice of some models as they are, not stepped.
Lattice compiled(std::vector<PhysicalModel> models);
Lattice compiled(PhysicalModel model);

std::vector<std::int32_t> all_points(const Lattice& lattice);
std::vector<std::int32_t> free_points(const Lattice& lattice);  // not pinned
std::vector<Vec3> positions(const Lattice& lattice);            // of all points, m
std::vector<Vec3> velocities(const Lattice& lattice);           // m/s

RigidMotion rigid_motion(const Lattice& lattice);  // of all points
Mat3 rotation(const Lattice& lattice);             // best fit, from where the points were authored

double kinetic_energy(const Lattice& lattice);       // J
double elastic_energy(const Lattice& lattice);       // J
double energy(const Lattice& lattice);               // kinetic and elastic, J
double energy_about_centre(const Lattice& lattice);  // without that of the centre, J

double stretch(const Lattice& lattice, std::size_t edge);       // L - L0, m
double stretch_rate(const Lattice& lattice, std::size_t edge);  // m/s
double tension(const Lattice& lattice, std::size_t edge);       // of the spring alone, N
double largest_stretch(const Lattice& lattice);  // over the unbroken edges, either way, m

// An angle that is known up to whole turns, counted on beyond them as long as it is asked for at
// least every half turn.
class AngleCounter {
 public:
  double count(double angle);  // rad

 private:
  double counted_ = 0.0;
};

}  // namespace limber::reference
