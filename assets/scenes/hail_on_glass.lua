-- Hailstones fall on a pane of glass until it breaks.

local set = scene{
  summary = "hail falls on a pane of glass",
  seconds = 2.5,
  parameters = {
    {name = "stones", value = 20, meaning = "how many", least = 1, most = 300},
    {name = "speed", value = 12, unit = "m/s", meaning = "of a stone", least = 0, most = 40},
    {name = "softening", value = 50000, meaning = "S of the glass: modulus / S, strain x sqrt S",
     least = 100, most = 1e6},
    {name = "seed", value = 1, meaning = "of stones and flaws", least = 0, most = 1e9},
  },
}
math.randomseed(math.floor(set.seed))

-- Without flaws glass bears ten times what it does in use and more (Griffith 1921). Cracks start at
-- seams of flaws, which bear 0.03 of that, and what lies between them stays whole: shards, no dust.
local glass = material{like = "glass", softening = set.softening, damping_ratio = 0.5,
                       strain_at_break = 10 * material{like = "glass"}.strain_at_break,
                       internal_damping = 300}
local side, height = 0.6, 0.5 -- m
local pane = shape.shell{name = "pane", width = side, depth = side, centre = {0, height, 0},
                         cells_u = 15, cells_v = 17, wall = 0.004, material = glass,
                         colour = {0.6, 0.85, 0.8}}
pane:flaws{scatter = 0.15, seams = 30, seam_strength = 0.03, seed = set.seed}
pane:look{transparency = 0.6, specularity = 0.8}
local window = spawn{model = pane}

-- It lies on a frame with four legs.
local beam, top = 0.04, height - 0.006 -- m
for _, edge in ipairs{{0, 1}, {0, -1}, {1, 0}, {-1, 0}} do
  local across = edge[1] == 0
  rigid.box{name = "frame", colour = {0.45, 0.3, 0.18},
            size = across and {side + beam, beam, beam} or {beam, beam, side - beam},
            position = {edge[1] * 0.5 * side, top - 0.5 * beam, edge[2] * 0.5 * side}}
end
for _, corner in ipairs{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}} do
  rigid.box{name = "leg", size = {beam, top - beam, beam}, colour = {0.45, 0.3, 0.18},
            position = {corner[1] * 0.5 * side, 0.5 * (top - beam), corner[2] * 0.5 * side}}
end

-- A stone 3 cm across, of ice, every now and then.
local fallen = 0
local pause = 1.5 / set.stones
every{seconds = pause, call = function()
  fallen = fallen + 1
  local x, z = 0.4 * side * (2 * math.random() - 1), 0.4 * side * (2 * math.random() - 1)
  rigid.sphere{name = "hailstone", radius = 0.015, mass = 0.013, restitution = 0.2,
               position = {x, height + 1, z}, velocity = {0, -set.speed, 0},
               colour = {0.9, 0.95, 1}}
  return fallen < set.stones
end}

local first
function on_break(event)
  if first then return end
  first = event.time
  print(string.format("the pane broke at %.2f s, under stone %d", first, fallen))
end
camera{position = {0.9, 1.15, 1.5}, target = {0, 0.38, 0}, field_of_view_deg = 34}
