-- Leaves in a small whirlwind: a vortex and a sink that move together carry them in and round, an
-- updraught lifts them (they sink at 1.6 m/s), a source above pushes them out again. Beside it a
-- breeze that turns, and somebody who passes.

local set = scene{
  summary = "leaves float and swirl in wind that is made of moving primitives",
  seconds = 9,
  parameters = {
    {name = "leaves", value = 320, meaning = "how many", least = 1, most = 5000},
    {name = "wind", value = 3, unit = "m/s", meaning = "speed that all of the wind is measured by",
     least = 0, most = 20},
    {name = "seed", value = 1, meaning = "of where the leaves start", least = 0, most = 1e9},
  },
}
math.randomseed(math.floor(set.seed + 0.5))

-- m
local length, width, thickness = 0.07, 0.045, 1.2e-4
local hollow = 0.012 -- of the blade between its midrib and its edges
local droop = 0.015  -- of the tip and the stalk below the middle

-- The blade: u from stalk to tip, v across. Bent both ways, so that it is stiff.
local function blade(u, v)
  local along, across = 2 * u - 1, 2 * v - 1
  local half_width = 0.5 * width * math.sin(math.pi * (0.1 + 0.8 * u))
  return vec(0.5 * length * along, hollow * across * across - droop * along * along,
             -half_width * across)
end

local function between(low, high) return low + (high - low) * math.random() end

local function somewhere(low, high)
  local x, y, z = math.random(), math.random(), math.random()
  return low + vec(x * (high.x - low.x), y * (high.y - low.y), z * (high.z - low.z))
end

local green, yellow, red = vec(0.25, 0.35, 0.05), vec(0.85, 0.6, 0.08), vec(0.6, 0.08, 0.03)
local function autumn_colour()
  local share = between(0, 1)
  if share < 0.5 then return green + 2 * share * (yellow - green) end
  return yellow + (2 * share - 1) * (red - yellow)
end

-- A plate across the stream, and friction along it (Hoerner, Fluid-Dynamic Drag, 1965, chapters 3 and
-- 2; a leaf is small and slow, so the friction is that of a laminar layer).
local leaf = shape.sheet{name = "leaf", surface = blade, cells_u = 4, cells_v = 2,
                         thickness = thickness, normal_drag = 1.2, tangential_drag = 0.03,
                         material = "leaf"}
-- Without these only its two bends would keep the blade from folding.
leaf:resist_bending{material = "leaf", thickness = thickness}
leaf:set_damping{ratio = material{like = "leaf"}.damping_ratio}

for i = 1, math.floor(set.leaves + 0.5) do
  leaf:look{colour = autumn_colour(), specularity = 0.1}
  local axis = somewhere(vec(-1, -1, -1), vec(1, 1, 1))
  local rotation = {axis = axis, angle = between(0, 2 * math.pi)}
  spawn{model = leaf, name = "leaf " .. i, rotation = rotation,
        position = somewhere(vec(-1, 0.1, -1), vec(1, 2.2, 1))}
end

-- Strengths by the speed half a metre from an axis, a metre from a point.
local speed = set.wind
local walk = {{0, {-0.4, 0, 0}}, {3, {0.4, 0, 0.3}}, {6, {-0.2, 0, -0.3}}, {9, {0, 0, 0}}}
wind.vortex{position = walk, strength = 2 * math.pi * 0.5 * speed, core_radius = 0.35}
wind.line_source{position = walk, strength = -2 * math.pi * 0.5 * (0.7 * speed),
                 core_radius = 0.35, within = {radius = 2, fade = 1}}
wind.uniform{direction = {0, 1, 0},
             speed = {{0, 0.3 * speed}, {1, speed}, {5, speed}, {6, 0.6 * speed}, {7, 1.2 * speed}},
             within = {centre = {0, 0.5, 0}, radius = 1.2, fade = 0.8}}
wind.point_source{position = {0, 3, 0}, strength = 4 * math.pi * (0.3 * speed), core_radius = 0.5}
local breeze = 0.1 * speed
wind.uniform{direction = {1, 0, 0.3}, speed = {{0, breeze}, {3, -breeze}, {6, breeze}}}
-- Somebody 0.3 m in radius passes.
wind.line_doublet{direction = {-1, 0, 0}, position = {{3, {-4, 0, 0.8}}, {7, {4, 0, 0.8}}},
                  strength = 2 * math.pi * 0.09 * (0.5 * speed), core_radius = 0.3}

camera{position = {0, 1.6, 4.6}, target = {0, 1.15, 0}, field_of_view_deg = 34}
