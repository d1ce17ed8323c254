#include "bullet_bridge/co_simulation.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bullet_bridge/co_simulation_impl.h"
#include "core/operators/skin_surface.h"
#include "core/storage/state_hash.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

namespace {

void require(bool holds, const std::string& what, const char* remedy) {
  if (!holds) throw InputError({"settings of the simulation", what, remedy});
}

const CoSimulationSettings& valid(const CoSimulationSettings& settings) {
  require(settings.step_scale > 0.0 && std::isfinite(settings.step_scale),
          "step_scale is " + std::to_string(settings.step_scale),
          "give it a value above 0, up to 1");
  require(settings.most_substeps > 0, "most_substeps is " + std::to_string(settings.most_substeps),
          "allow one at least");
  require(settings.debris_lifetime >= 0.0,
          "debris_lifetime is " + std::to_string(settings.debris_lifetime) + " s",
          "give it 0 or more, or infinity");
  return settings;
}

}  // namespace

std::size_t CoSimulation::Impl::add(PhysicalModel model, Integration integration) {
  const bool pinned = std::any_of(model.points.begin(), model.points.end(),
                                  [](const PointAttributes& point) { return point.pinned; });
  if (pinned && settings_.representation == Representation::kAlwaysRigid) {
    throw InputError({model.name + ": points",
                      "pinned points hold it, and it is to be always rigid",
                      "unpin them, or simulate it switching or always flexible"});
  }
  const std::size_t object = add_object(lattice_, std::move(model));
  integration_.push_back(integration);
  removed_.push_back(false);
  if (integration == Integration::kImplicit) time_operator_.make_implicit(object);
  rebuild_active(lattice_);
  time_operator_.roles_changed();
  boundary_.reset(lattice_.breaking);
  Piece whole;
  whole.object = object;
  whole.points = points_of_object(object);
  for (std::vector<std::int32_t>& points : connected_groups(whole)) {
    if (becomes_debris(points)) {
      turn_to_debris(points);
    } else {
      start(add_piece(object, std::move(points)));
    }
  }
  roles_stale_ = true;
  return object;
}

void CoSimulation::Impl::start(Piece& piece) {
  Calmness seen = look_at(piece);
  seen.peak_load = largest_load(lattice_, piece.points);  // no step has sampled it yet
  const bool quiet = !piece.pinned && calm(piece.strength, settings_.switching, seen);
  const bool rigid =
      settings_.representation == Representation::kAlwaysRigid || (switching() && quiet);
  if (rigid) {
    freeze_piece(piece, "start", numbers_of(piece, seen));
  } else {
    piece.seen = std::make_unique<LatticeBody>(world_, lattice_, boundary_, piece.points);
  }
}

void CoSimulation::Impl::sync_points() const {
  for (const auto& piece : pieces_) {
    if (piece->proxy) piece->proxy->write_points(lattice_, piece->points);
  }
}

std::vector<std::int32_t> CoSimulation::Impl::points_of_object(std::size_t object) const {
  const IdRange<PointId>& range = lattice_.objects[object].points;
  std::vector<std::int32_t> points;
  for (std::int32_t p = range.begin; p < range.end; ++p) points.push_back(p);
  return points;
}

CoSimulation::CoSimulation(btDiscreteDynamicsWorld& world, const CoSimulationSettings& settings)
    : impl_(std::make_unique<Impl>(world, valid(settings))) {}

CoSimulation::~CoSimulation() = default;

std::size_t CoSimulation::add(PhysicalModel model, std::optional<Integration> integration) {
  return impl_->add(std::move(model), integration.value_or(impl_->settings_.integration));
}

void CoSimulation::remove(std::size_t object) { impl_->remove(object); }

bool CoSimulation::has_object(std::size_t object) const { return impl_->has_object(object); }

std::vector<btTypedConstraint*> CoSimulation::constraints_on(std::size_t object) const {
  impl_->require_object(object);
  return impl_->constraints_on(object);
}

void CoSimulation::set_air(std::optional<Air> air) {
  Environment changed = impl_->environment_;
  changed.air = std::move(air);
  require_valid(changed);
  impl_->environment_ = std::move(changed);
}

const std::optional<Air>& CoSimulation::air() const { return impl_->environment_.air; }

PhysicalModel CoSimulation::model(std::size_t object) const {
  impl_->require_object(object);
  impl_->sync_points();
  return extract_model(impl_->lattice_, object);
}

SurfaceModel CoSimulation::surface(std::size_t object) const {
  const Lattice& lattice = impl_->lattice_;
  const PhysicalModel now = model(object);
  return skin_surface(
      now, impl_->boundary_.surface(now, lattice.topology, lattice.objects[object].faces));
}

const std::optional<Diagnostic>& CoSimulation::failure() const { return impl_->failure_; }
const std::vector<Diagnostic>& CoSimulation::notes() const { return impl_->notes_; }

std::size_t CoSimulation::object_count() const { return impl_->lattice_.objects.size(); }

std::vector<PieceView> CoSimulation::pieces() const {
  impl_->sync_points();
  std::vector<PieceView> views;
  for (const auto& piece : impl_->pieces_) {
    PieceView view;
    view.id = piece->id;
    view.object = piece->object;
    view.flexible = piece->flexible();
    view.body = &piece->body();
    view.motion = rigid_motion(impl_->lattice_.motion, impl_->lattice_.mass, piece->points);
    const std::int32_t first = impl_->lattice_.objects[piece->object].points.begin;
    for (std::int32_t p : piece->points) view.points.push_back(p - first);
    views.push_back(std::move(view));
  }
  return views;
}

std::optional<std::size_t> CoSimulation::object_of(const btCollisionObject& body) const {
  for (const auto& piece : impl_->pieces_) {
    if (&piece->body() == &body) return piece->object;
  }
  return {};
}

void CoSimulation::apply_impulse(std::size_t object, const Vec3& impulse, const Vec3& at) {
  impl_->require_object(object);
  if (!impulse.allFinite() || !at.allFinite()) {
    throw InputError(
        {"impulse", "it, or the place it acts on, is not finite", "give finite numbers"});
  }
  impl_->apply_impulse(object, impulse, at);
}

double CoSimulation::debris_mass(std::size_t object) const {
  impl_->require_object(object);
  double mass = 0.0;
  for (std::int32_t p : impl_->points_of_object(object)) mass += impl_->lattice_.mass[p];
  for (const auto& piece : impl_->pieces_) {
    if (piece->object == object) mass -= piece->strength.mass;
  }
  return mass;
}

std::vector<bool> CoSimulation::flexible_points(std::size_t object) const {
  impl_->require_object(object);
  const IdRange<PointId>& range = impl_->lattice_.objects[object].points;
  std::vector<bool> flexible(range.size(), false);
  for (const auto& piece : impl_->pieces_) {
    if (piece->object != object || !piece->flexible()) continue;
    for (std::int32_t p : piece->points) flexible[static_cast<std::size_t>(p - range.begin)] = true;
  }
  return flexible;
}

std::pair<Mat3, Vec3> CoSimulation::placement(std::size_t object) const {
  impl_->require_object(object);
  impl_->sync_points();
  const Lattice& lattice = impl_->lattice_;
  const std::vector<std::int32_t> points = impl_->points_of_object(object);
  return {best_rotation(lattice.motion, lattice.authored_position, lattice.mass, points),
          rigid_motion(lattice.motion, lattice.mass, points).centre};
}

const Counters& CoSimulation::counters() const { return impl_->counters_; }
const std::vector<SwitchRecord>& CoSimulation::switches() const { return impl_->switches_; }
const std::vector<BreakRecord>& CoSimulation::breaks() const { return impl_->breaks_; }
const std::vector<LatticeContact>& CoSimulation::lattice_contacts() const {
  return impl_->lattice_contacts_;
}
const std::vector<SplitRecord>& CoSimulation::splits() const { return impl_->splits_; }

std::uint64_t CoSimulation::state_hash() const {
  impl_->sync_points();
  const Lattice& lattice = impl_->lattice_;
  StateHash hash;
  hash.add(std::span<const PointMotion>(lattice.motion));
  hash.add(std::span<const std::uint8_t>(lattice.breaking.edge_broken));
  hash.add(std::span<const std::uint8_t>(lattice.breaking.cell_valid));
  hash.add(std::span<const PointRole>(lattice.role));
  for (int i = 0; i < impl_->world_.getNumCollisionObjects(); ++i) {
    const btCollisionObject* object = impl_->world_.getCollisionObjectArray()[i];
    const btTransform& pose = object->getWorldTransform();
    for (int k = 0; k < 3; ++k) {
      hash.add(pose.getOrigin()[k]);
      for (int l = 0; l < 3; ++l) hash.add(pose.getBasis()[k][l]);
    }
    const btRigidBody* body = btRigidBody::upcast(object);
    if (!body) continue;
    for (int k = 0; k < 3; ++k) {
      hash.add(body->getLinearVelocity()[k]);
      hash.add(body->getAngularVelocity()[k]);
    }
  }
  return hash.value();
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
