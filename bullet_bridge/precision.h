#pragma once

// Bullet comes in two precisions whose functions have the same names: mixing them links and then
// reads garbage. The precision is therefore part of every name of the bridge, and a game built for
// the other one gets an undefined reference to limber::bullet::bullet_f64::... (or bullet_f32).
#ifdef BT_USE_DOUBLE_PRECISION
#define LIMBER_BULLET_PRECISION bullet_f64
#else
#define LIMBER_BULLET_PRECISION bullet_f32
#endif
