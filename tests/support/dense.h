#pragma once

#include <Eigen/Core>

#include "core/model/physical_model.h"

namespace limber::test {

// By definition, 3 rows a point, without the library's own: the sum of c d d^T over the unbroken
// edges, d the unit vector along an edge and c its stiffness (N/m) or damping (N s/m).
Eigen::MatrixXd dense_matrix(const PhysicalModel& model, double EdgeAttributes::*coefficient);

// Their masses, kg, once for each of 3 components.
Eigen::VectorXd dense_masses(const PhysicalModel& model);

}  // namespace limber::test
