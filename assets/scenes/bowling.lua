-- A ball rolls into ten pins of wood. Pins are lattices only while something hits them.

local set = scene{
  summary = "a ball rolls into ten wooden pins",
  seconds = 4,
  parameters = {
    {name = "speed", value = 7, unit = "m/s", meaning = "of the ball", least = 1, most = 15},
    {name = "aside", value = 0.04, unit = "m", meaning = "how far it is off the middle",
     least = -0.5, most = 0.5},
    {name = "softening", value = 2000, meaning = "S of the wood: modulus / S", least = 100,
     most = 1e5},
  },
}

-- m: a pin's foot, belly, neck and head. Its profile runs through these.
local height = 0.38
local profile = {{0, 0.03}, {0.3, 0.06}, {0.65, 0.025}, {0.85, 0.032}, {1, 0.02}}
local function radius(y)
  local share = math.max(0, math.min(1, y / height))
  for i = 2, #profile do
    local low, high = profile[i - 1], profile[i]
    if share <= high[1] then
      local between = (share - low[1]) / (high[1] - low[1])
      return low[2] + (high[2] - low[2]) * between
    end
  end
end

local maple = material{like = "oak", softening = set.softening, damping_ratio = 0.2,
                       internal_damping = 20, friction = 0.3}
local pin = shape.turned{name = "pin", radius = radius, low = 0, high = height, cells_across = 4,
                         cells_along = 10, material = maple, colour = {0.9, 0.87, 0.78}}

-- Four rows, a foot apart.
local pins = {}
for row = 1, 4 do
  for i = 1, row do
    local x, z = 0.264 * (row - 1), 0.305 * (i - 0.5 * (row + 1))
    table.insert(pins, spawn{model = pin, name = "pin " .. #pins + 1, position = {x, 0, z}})
  end
end

-- It rolls: its spin fits its speed.
local r = 0.108
rigid.sphere{name = "ball", radius = r, mass = 6.5, position = {-1.5, r, set.aside},
             velocity = {set.speed, 0, 0}, spin = {0, 0, -set.speed / r}, friction = 0.3,
             colour = {0.1, 0.15, 0.45}}

-- How many lie, or are gone, in the end: what stands has its middle at half its height.
after{seconds = 3.5, call = function()
  local down = 0
  for _, one in ipairs(pins) do
    if one:position().y < 0.12 then down = down + 1 end
  end
  print(down .. " pins down")
end}

camera{position = {-1.6, 0.9, 1.3}, target = {0.35, 0.15, 0}, field_of_view_deg = 34}
