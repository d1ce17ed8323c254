-- A soft cube and a stiff brick fall side by side. The policy tells them apart by their numbers: the
-- jelly stays a lattice while it wobbles, the brick turns into one when it hits the floor.

local set = scene{
  summary = "a soft cube and a stiff brick dropped side by side, the cube set wobbling",
  seconds = 3,
  parameters = {
    {name = "height", value = 0.5, unit = "m", meaning = "of the lowest points above the floor",
     least = 0, most = 100},
    {name = "wobble", value = 3, unit = "1/s",
     meaning = "rate at which the jelly is being stretched at the start", least = -10, most = 10},
    {name = "softening", value = 1000,
     meaning = "S of the brick: modulus / S, strain at break x sqrt S", least = 1, most = 1e6},
  },
}

local side = 0.2 -- m
local jelly_centre = vec(-0.2, set.height + 0.5 * side, 0)
local brick_centre = vec(0.2, set.height + 0.5 * side, 0)

local firm_gelatine = material{
  density = 1000, youngs_modulus = 1.5e5, damping_ratio = 0.1, internal_damping = 1, friction = 0.6,
}
local fired_clay = material{
  density = 2000, youngs_modulus = 1.5e10, strain_at_break = 3e-4, damping_ratio = 0.2,
  internal_damping = 30, friction = 0.6, softening = set.softening,
}

local function cube(name, material, centre, colour)
  return shape.box{name = name, size = {side, side, side}, cells = {6, 6, 6}, centre = centre,
                   material = material, colour = colour}
end

local jelly = cube("jelly", firm_gelatine, jelly_centre, {0.75, 0.15, 0.2})
local brick = cube("brick", fired_clay, brick_centre, {0.6, 0.3, 0.2})

-- The jelly is being pulled long and thin without a change of volume: it will wobble, and neither
-- move nor turn.
for i = 1, jelly:points() do
  local point = jelly:point{index = i}
  local r = point.position - jelly_centre
  jelly:set_point{index = i, velocity = point.velocity + set.wobble * vec(r.x, -2 * r.y, r.z)}
end

spawn{model = jelly}
spawn{model = brick}
camera{position = {0.5, 0.75, 1.9}, target = {0, 0.33, 0}}
