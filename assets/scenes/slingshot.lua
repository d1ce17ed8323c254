-- A game: stones from a slingshot against bottles on a wall, and a count of what broke. Two inputs
-- drive it: `aim` (rad above the horizon) and `shoot` (m/s). Without a player one is played here;
-- `limber run slingshot --inputs FILE` plays yours.

local set = scene{
  summary = "a slingshot against bottles; counts what broke",
  seconds = 6,
  parameters = {
    {name = "player", value = 1, meaning = "1: it is played, 0: wait for --inputs", least = 0,
     most = 1},
    {name = "softening", value = 20000, meaning = "S of the glass: modulus / S, strain x sqrt S",
     least = 100, most = 1e6},
  },
}

-- Without flaws glass bears ten times what it does in use and more (Griffith 1921). Cracks start at
-- seams of flaws, which bear 0.03 of that, and what lies between them stays whole: shards, no dust.
local glass = material{like = "glass", softening = set.softening, damping_ratio = 0.2,
                       strain_at_break = 10 * material{like = "glass"}.strain_at_break,
                       internal_damping = 30, friction = 0.4}
-- From the foot over the shoulder to the neck.
local bottle = shape.vessel{
  name = "bottle", spacing = 0.014, wall = 0.004, material = glass, colour = {0.15, 0.45, 0.2},
  profile = function(t)
    if t < 0.15 then return 0.035 * t / 0.15, 0 end
    local up = (t - 0.15) / 0.85
    local neck = math.max(0, math.min(1, (up - 0.55) / 0.2))
    return 0.035 - 0.02 * neck, 0.24 * up
  end,
}
bottle:flaws{scatter = 0.15, seams = 15, seam_strength = 0.03}
bottle:look{transparency = 0.4}

local top = 0.6 -- m
rigid.box{name = "wall", size = {0.3, top, 1.2}, position = {3, 0.5 * top, 0},
          colour = {0.5, 0.45, 0.4}}
local bottles = {}
for i = 1, 3 do
  bottles[i] = spawn{model = bottle, name = "bottle " .. i, position = {3, top + 0.001, 0.3 * (i - 2)}}
end

local function whole() -- bottles that are
  local count = 0
  for _, one in ipairs(bottles) do
    if one:broken() == 0 then count = count + 1 end
  end
  return count
end

-- Shoots at the next bottle.
local aim, shots = 0.1, 0
function on_input(name, value)
  if name == "aim" then
    aim = value
  elseif name == "shoot" then
    shots = shots + 1
    local from = vec(0, 0.7, 0)
    local target = bottles[(shots - 1) % #bottles + 1]
    local level = target:position() - from
    local ahead = vec(level.x, 0, level.z):normalized()
    rigid.sphere{name = "stone", radius = 0.025, mass = 0.15, position = from,
                 velocity = value * (math.cos(aim) * ahead + vec(0, math.sin(aim), 0)),
                 colour = {0.4, 0.4, 0.42}}
  end
end

if set.player == 1 then
  for shot = 1, 3 do
    play{name = "aim", at = 1.5 * shot - 1, value = 0.12}
    play{name = "shoot", at = 1.5 * shot - 0.9, value = 12}
  end
end

after{seconds = 5.9, call = function()
  print(string.format("%d shots, %d of %d bottles broke", shots, #bottles - whole(), #bottles))
end}
-- The fork that they fly through.
local function prong(side)
  return {shape = "capsule", radius = 0.018, height = 0.22, position = {0, 0.59, side * 0.075},
          rotation = {axis = {1, 0, 0}, angle = side * 0.5}}
end
rigid.compound{name = "slingshot", colour = {0.4, 0.25, 0.12}, parts = {
  {shape = "capsule", radius = 0.022, height = 0.44, position = {0, 0.242, 0}}, prong(-1), prong(1),
}}
camera{position = {-0.75, 1.05, 0.85}, target = {2.4, 0.55, -0.02}, field_of_view_deg = 28}
