-- A teapot tips off a table, hits its edge, breaks, and its pieces come down on the floor.

local set = scene{
  summary = "a teapot falls past a table's edge, breaks, and its pieces come down on the floor",
  seconds = 4,
  parameters = {
    {name = "height", value = 1.35, unit = "m", meaning = "of the lowest point above the floor",
     least = 0, most = 100},
    {name = "speed", value = 0.3, unit = "m/s", meaning = "forward, towards the table's edge",
     least = -20, most = 20},
    {name = "spin", value = 1.5, unit = "rad/s", meaning = "forward", least = -50, most = 50},
    {name = "density", value = 2400, unit = "kg/m^3", meaning = "of the ceramic",
     least = 100, most = 2e4},
    {name = "softening", value = 2000,
     meaning = "S of the ceramic: modulus / S, strain at break x sqrt S", least = 1, most = 1e5},
    {name = "seed", value = 1, meaning = "of the flaws", least = 0, most = 1e9},
  },
}

-- The table's edge is 0.1 m beyond the teapot's middle.
local top, thickness = 0.75, 0.04 -- m
rigid.box{name = "table", size = {0.8, thickness, 0.7},
          position = {0.1 - 0.4, top - 0.5 * thickness, 0}, colour = {0.45, 0.28, 0.15}}

-- Where the pieces that slide off the table's edge come down: spruce, 600 kg/m^3.
rigid.box{name = "block", size = {0.016, 0.18, 0.1}, position = {0.18, 0.09, 0},
          mass = 600 * 8 * (0.008 * 0.09 * 0.05), colour = {0.75, 0.55, 0.3}}

local pot = shape.teapot{density = set.density, softening = set.softening, seed = set.seed}
local low = pot:bounds()
spawn{model = pot, position = {0, set.height - low.y, 0}, velocity = {set.speed, 0, 0},
      spin = {0, 0, -set.spin}}
camera{position = {1.05, 1.25, 2.05}, target = {0.06, 0.66, 0}, field_of_view_deg = 36}
