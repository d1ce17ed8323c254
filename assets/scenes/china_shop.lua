-- Cups, plates and a vase on a shelf, and a ball that comes through the door.

local set = scene{
  summary = "a ball flies into a shelf of china",
  seconds = 2.5,
  parameters = {
    {name = "speed", value = 6, unit = "m/s", meaning = "of the ball", least = 1, most = 20},
    {name = "softening", value = 20000, meaning = "S of the china: modulus / S, strain x sqrt S",
     least = 100, most = 1e6},
    {name = "seed", value = 1, meaning = "of the flaws", least = 0, most = 1e9},
  },
}

-- Without flaws china bears ten times what it does in use and more (Griffith 1921). Cracks start at
-- seams of flaws, which bear 0.03 of that, and what lies between them stays whole: shards, no dust.
local china = material{like = "porcelain", softening = set.softening, damping_ratio = 0.2,
                       strain_at_break = 10 * material{like = "porcelain"}.strain_at_break,
                       internal_damping = 30, friction = 0.4}

-- A vessel from its profile: (radius, height) along the outer side, from the foot up.
local function vessel(name, colour, spacing, profile)
  local made = shape.vessel{name = name, profile = profile, spacing = spacing, wall = 0.004,
                            material = china, colour = colour}
  return made:flaws{scatter = 0.15, seams = 12, seam_strength = 0.03, seed = set.seed}
end

local cup = vessel("cup", {0.85, 0.85, 0.8}, 0.012, function(t)
  if t < 0.4 then return 0.035 * t / 0.4, 0 end -- the bottom
  local up = (t - 0.4) / 0.6
  return 0.035 + 0.012 * up, 0.08 * up
end)
local vase = vessel("vase", {0.2, 0.35, 0.6}, 0.016, function(t)
  if t < 0.2 then return 0.05 * t / 0.2, 0 end
  local up = (t - 0.2) / 0.8
  return 0.05 + 0.03 * math.sin(math.pi * up), 0.22 * up
end)
local plate = vessel("plate", {0.85, 0.8, 0.7}, 0.018, function(t)
  return 0.12 * t, 0.03 * t * t
end)

-- The shelf: a board on two sides, a back.
local board = 0.8 -- m, its upper side
rigid.box{name = "board", size = {1.2, 0.03, 0.3}, position = {0, board - 0.015, 0},
          colour = {0.5, 0.32, 0.18}}
for _, side in ipairs{-1, 1} do
  rigid.box{name = "side", size = {0.03, board - 0.03, 0.3},
            position = {side * 0.585, 0.5 * (board - 0.03), 0}, colour = {0.5, 0.32, 0.18}}
end
rigid.box{name = "back", size = {1.2, 0.5, 0.02}, position = {0, board + 0.25, -0.16},
          colour = {0.55, 0.36, 0.2}}

local shop = {}
local function put(model, x, z) -- a millimetre above the board
  table.insert(shop, spawn{model = model, name = "piece " .. #shop + 1 ,
                           position = {x, board + 0.001, z or 0}})
end
for i = 0, 3 do put(cup, -0.45 + 0.13 * i) end
put(vase, 0.15)
put(plate, 0.42)

rigid.sphere{name = "ball", radius = 0.07, mass = 1.5, position = {-0.3, board + 0.1, 1},
             velocity = {0.3 * set.speed, 0.3, -set.speed}, colour = {0.7, 0.15, 0.1}}

after{seconds = 2.4, call = function()
  local broken = 0
  for _, one in ipairs(shop) do
    if one:broken() > 0 then broken = broken + 1 end
  end
  print(broken .. " of " .. #shop .. " pieces of china broke")
end}
camera{position = {0.5, 1.35, 2.2}, target = {0, 0.72, 0}, field_of_view_deg = 38}
