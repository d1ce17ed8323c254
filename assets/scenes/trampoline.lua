-- A sheet held at its rim throws a ball up again.

local set = scene{
  summary = "a ball bounces on a sheet that is held at its rim",
  seconds = 4,
  parameters = {
    {name = "mass", value = 5, unit = "kg", meaning = "of the ball", least = 0.5, most = 30},
    {name = "height", value = 1, unit = "m", meaning = "that it falls", least = 0.1, most = 3},
    {name = "strain", value = 0.1, meaning = "of the sheet before anything falls on it", least = 0,
     most = 0.3},
  },
}

-- Woven bed and its springs in one, estimated: much softer than the cloth alone.
local bed = material{density = 900, youngs_modulus = 4e6, damping_ratio = 0.03,
                     internal_damping = 0.2, friction = 0.6}
local half, height, cells = 0.8, 0.8, 16 -- m, m
local sheet = shape.sheet{name = "bed", width = 2 * half, depth = 2 * half,
                          centre = {0, height, 0}, cells_u = cells, cells_v = cells,
                          pattern = "squares", thickness = 2e-3, material = bed,
                          colour = {0.08, 0.1, 0.16}}

-- Springs that would like to be shorter: the sheet is stretched before anything falls on it.
for i = 1, sheet:edges() do
  sheet:set_edge{index = i, rest_length = sheet:edge{index = i}.rest_length / (1 + set.strain)}
end

-- The rim.
for i = 1, sheet:points() do
  local p = sheet:point{index = i}.position
  if math.max(math.abs(p.x), math.abs(p.z)) > half - 1e-6 then sheet:pin{index = i} end
end
spawn{model = sheet}

for _, along_x in ipairs{true, false} do
  for _, side in ipairs{-1, 1} do
    local offset = side * (half + 0.05)
    rigid.box{name = "frame", colour = {0.2, 0.3, 0.55},
              size = along_x and {2 * half + 0.16, 0.06, 0.06} or {0.06, 0.06, 2 * half + 0.16},
              position = along_x and {0, height, offset} or {offset, height, 0}}
    rigid.box{name = "leg", size = {0.06, height - 0.03, 0.06}, colour = {0.2, 0.3, 0.55},
              position = {side * (half + 0.05), 0.5 * (height - 0.03),
                          along_x and half + 0.05 or -half - 0.05}}
  end
end

local ball = rigid.sphere{name = "ball", radius = 0.15, mass = set.mass, friction = 0.5,
                          position = {0, height + 0.15 + set.height, 0}, colour = {0.8, 0.2, 0.1}}

-- How high it comes up again.
local lowest, highest = math.huge, 0
function on_tick()
  local y = ball:position().y - 0.15 - height
  if y < lowest then
    lowest, highest = y, y
  end
  highest = math.max(highest, y)
end
after{seconds = 2.5, call = function()
  print(string.format("pressed in by %.2f m, up again to %.2f m", -lowest, highest))
end}
camera{position = {2.4, 2.1, 3.4}, target = {0, 0.95, 0}, field_of_view_deg = 36}
