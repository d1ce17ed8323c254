#include "tests/contact_scenes/run_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tests/bridge/measure.h"
#include "tests/contact_scenes/flexible_world.h"
#include "tests/contact_scenes/penetration.h"

namespace limber::bullet::test {
namespace {

constexpr double kRestSeconds = 0.25;  // the speed at the end is the highest of these

bool is_finite(const SceneState& state) {
  return std::all_of(state.flexible.begin(), state.flexible.end(), [](const auto& model) {
    return std::all_of(model.geometry.points.begin(), model.geometry.points.end(),
                       [](const Vec3& x) { return x.allFinite(); });
  });
}

// Of every body that moves by itself.
std::vector<Sums> sums_of_each(const SceneState& state) {
  std::vector<Sums> all;
  for (const PhysicalModel& model : state.flexible) all.push_back(sums_of(model));
  for (const btRigidBody* body : state.rigid) {
    if (!body->isStaticOrKinematicObject()) all.push_back(sums_of(*body));
  }
  return all;
}

Sums total(const SceneState& state) {
  Sums sums;
  for (const Sums& body : sums_of_each(state)) sums += body;
  return sums;
}

// Root mean square over its mass, m/s.
double fastest(const SceneState& state) {
  double speed = 0.0;
  for (const Sums& body : sums_of_each(state)) {
    speed = std::max(speed, std::sqrt(2.0 * body.kinetic / body.mass));
  }
  return speed;
}

class Observer {
 public:
  Observer(const Scene& scene, const SceneState& start) : scene_(scene), start_(total(start)) {
    measured_.energy_start = least_energy_ = start_.energy(scene.gravity);
    for (const Sums& body : sums_of_each(start)) {
      momenta_ += body.momentum.norm();
      angular_momenta_ += body.angular_momentum.norm();
    }
    for (const Demand& demand : scene.demands) {
      measured_.findings.push_back({demand.what, -kNoLimit, demand.most});
    }
  }

  void see(const SceneState& state) {
    const Sums now = total(state);
    const auto raise = [](double& most, double value) {
      if (!(value <= most)) most = value;  // also to what is not a number
    };
    raise(measured_.penetration, deepest_penetration(state));
    raise(measured_.energy_rise, now.energy(scene_.gravity) - measured_.energy_start);
    least_energy_ = std::min(least_energy_, now.energy(scene_.gravity));
    raise(measured_.energy_climb, now.energy(scene_.gravity) - least_energy_);
    raise(measured_.momentum_error, (now.momentum - start_.momentum).norm() / momenta_);
    raise(measured_.angular_error,
          (now.angular_momentum - start_.angular_momentum).norm() / angular_momenta_);
    const bool at_end = state.time > scene_.seconds - kRestSeconds;
    if (at_end) raise(measured_.rest_speed, fastest(state));
    for (std::size_t i = 0; i < scene_.demands.size(); ++i) {
      const Demand& demand = scene_.demands[i];
      if (demand.when == Demand::When::kAlways)
        raise(measured_.findings[i].value, demand.value(state));
      else
        measured_.findings[i].value = demand.value(state);
    }
    measured_.seconds = state.time;
  }

  Measured finish(std::string failure, double ms_per_frame) {
    const Limits& limits = scene_.limits;
    const auto add = [&](const char* what, double value, double most, double unit) {
      if (most < kNoLimit) measured_.findings.push_back({what, value / unit, most / unit});
    };
    add("penetration mm", measured_.penetration, limits.penetration, 1e-3);
    add("energy rise %", measured_.energy_rise / std::abs(measured_.energy_start),
        limits.energy_rise, 1e-2);
    add("speed at the end m/s", measured_.rest_speed, limits.rest_speed, 1.0);
    add("momentum error", measured_.momentum_error, limits.momentum_error, 1.0);
    add("angular momentum error", measured_.angular_error, limits.momentum_error, 1.0);
    measured_.failure = std::move(failure);
    measured_.ms_per_frame = ms_per_frame;
    return measured_;
  }

 private:
  const Scene& scene_;
  Sums start_;
  double least_energy_ = 0.0;  // J, so far
  double momenta_ = 0.0, angular_momenta_ = 0.0;
  Measured measured_;
};

}  // namespace

std::vector<Finding> Measured::unmet() const {
  std::vector<Finding> list;
  std::copy_if(findings.begin(), findings.end(), std::back_inserter(list),
               [](const Finding& finding) { return !finding.met(); });
  return list;
}

std::string Measured::verdict() const {
  if (good()) return "ok";
  std::string text =
      failure.empty() ? "" : fmt::format("stopped at {:.2f} s: {}", seconds, failure);
  for (const Finding& finding : unmet()) {
    text += fmt::format("{}{} {:.3g} > {:.3g}", text.empty() ? "" : "; ", finding.what,
                        finding.value, finding.most);
  }
  return text;
}

Measured run_scene(const Scene& scene, Engine engine, double tick) {
  using Clock = std::chrono::steady_clock;
  const auto world = engine == Engine::kLimber ? limber_world(scene) : bullet_soft_world(scene);
  Observer observer(scene, world->state());
  Clock::duration spent{};
  double frames = 0.0;
  std::string failure;
  for (double t = 0.0; t < scene.seconds - 0.5 * tick && failure.empty();) {
    const int ticks = std::max(1, int(std::lround(scene.frames_between * kFrame / tick)));
    const auto before = Clock::now();
    for (int n = 0; n < ticks; ++n) world->step(tick);
    spent += Clock::now() - before;
    t += ticks * tick;
    frames += ticks * tick / kFrame;
    const SceneState state = world->state();
    failure = world->failure();
    if (failure.empty() && !is_finite(state)) failure = "positions are not finite";
    if (failure.empty()) observer.see(state);
  }
  const double ms = std::chrono::duration<double, std::milli>(spent).count();
  return observer.finish(std::move(failure), ms / frames);
}

}  // namespace limber::bullet::test
