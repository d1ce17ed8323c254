-- A ball on a chain swings into a wall of brick that is weak along its seams.

local set = scene{
  summary = "a ball on a chain swings into a brick wall",
  seconds = 3,
  parameters = {
    {name = "mass", value = 60, unit = "kg", meaning = "of the ball", least = 1, most = 1000},
    {name = "angle", value = 1.1, unit = "rad", meaning = "of the chain at the start", least = 0.2,
     most = 1.5},
    {name = "softening", value = 5000, meaning = "S of the brick: modulus / S, strain x sqrt S",
     least = 100, most = 1e6},
    {name = "seed", value = 1, meaning = "of the seams", least = 0, most = 1e9},
  },
}

-- Bricks bear ten times what the mortar between them does: seams have 0.03 of their strength.
local brick = material{density = 2000, youngs_modulus = 1.5e10, strain_at_break = 3e-3,
                       damping_ratio = 0.2, internal_damping = 30, friction = 0.6,
                       softening = set.softening}
local wall = shape.box{name = "wall", size = {0.2, 1.2, 1.6}, cells = {2, 12, 16},
                       centre = {0, 0.6, 0}, material = brick, colour = {0.6, 0.28, 0.2}}
wall:flaws{scatter = 0.15, seams = 40, seam_strength = 0.03, seed = set.seed}
spawn{model = wall}

-- The chain: a rod without much mass on a hinge, the ball fixed to its end.
local pivot, length, radius = vec(-0.32, 2.4, 0), 1.6, 0.18 -- m
local function along(distance)
  return pivot + distance * vec(-math.sin(set.angle), -math.cos(set.angle), 0)
end
local ball = rigid.sphere{name = "ball", radius = radius, mass = set.mass,
                          position = along(length), colour = {0.15, 0.15, 0.17}}
local rod = rigid.capsule{name = "chain", radius = 0.02, height = length - 0.3, mass = 2,
                          position = along(0.5 * length - 0.05),
                          rotation = {axis = {0, 0, 1}, angle = -set.angle},
                          colour = {0.3, 0.3, 0.32}}
joint.hinge{body = rod, at = pivot, axis = {0, 0, 1}}
joint.fixed{body = ball, to = rod, at = along(length - radius)}

local pieces = 0
function on_split(event) pieces = event.object:pieces() end
after{seconds = 2.9, call = function() print("the wall is in " .. pieces .. " pieces") end}
camera{position = {-2.6, 1.5, 3.6}, target = {-0.3, 0.95, 0}, field_of_view_deg = 40}
