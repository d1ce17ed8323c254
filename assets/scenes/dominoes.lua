-- Biscuits that stand in a curve fall like dominoes; some crumble as they do.

local set = scene{
  summary = "biscuits that stand in a row topple one another",
  seconds = 3,
  parameters = {
    {name = "biscuits", value = 16, meaning = "how many", least = 2, most = 100},
    {name = "push", value = 0.012, unit = "N s", meaning = "that the first one gets", least = 0,
     most = 1},
  },
}

-- Short pastry, estimated: crumbly, light, hardly bouncing.
local pastry = material{density = 700, youngs_modulus = 2e7, strain_at_break = 0.004,
                        damping_ratio = 0.2, internal_damping = 20, friction = 0.4}
local size = vec(0.012, 0.09, 0.055) -- m
local biscuit = shape.box{name = "biscuit", size = size, cells = {1, 6, 4},
                          centre = {0, 0.5 * size.y, 0}, material = pastry,
                          colour = {0.75, 0.5, 0.22}}

-- Along an arc: each is turned the way the row goes on.
local gap, bend = 0.045, 0.07 -- m, rad
local place, direction = vec(-0.3, 0, -0.1), -0.5
local row = {}
for i = 1, math.floor(set.biscuits) do
  row[i] = spawn{model = biscuit, name = "biscuit " .. i, position = place,
                 rotation = {axis = {0, 1, 0}, angle = -direction}}
  place = place + gap * vec(math.cos(direction), 0, math.sin(direction))
  direction = direction + bend
end

function on_start()
  row[1]:push{impulse = set.push * vec(math.cos(-0.5), 0, math.sin(-0.5)),
              at = row[1]:position() + vec(0, 0.4 * size.y, 0)}
end
after{seconds = 2.8, call = function()
  local fallen = 0
  for _, one in ipairs(row) do
    if one:position().y < 0.4 * size.y then fallen = fallen + 1 end
  end
  print(fallen .. " of " .. #row .. " fell")
end}
camera{position = {0.1, 0.36, 0.62}, target = {0.03, 0.02, -0.12}, field_of_view_deg = 34}
