-- What `limber run FILE` does with a model from a file: it falls on the floor. The model is the
-- script's argument.

local model = ...
local set = scene{
  summary = "a model from a file falls on the floor",
  seconds = 3,
  parameters = {
    {name = "height", value = 1, unit = "m", meaning = "of the lowest point above the floor",
     least = 0, most = 100},
    {name = "speed", value = 0, unit = "m/s", meaning = "sideways", least = -50, most = 50},
    {name = "spin", value = 0, unit = "rad/s", meaning = "forward", least = -50, most = 50},
    {name = "zoom", value = 1, meaning = "of the camera; at 1 the model fills the picture",
     least = 0.01, most = 100},
  },
}

local low, high = model:bounds()
local middle, size = 0.5 * (low + high), (high - low):length()
local shift = vec(-middle.x, set.height - low.y, -middle.z)
spawn{model = model, position = shift, velocity = {set.speed, 0, 0}, spin = {0, 0, -set.spin}}

-- A little from the right and above, always on the model.
camera{position = middle + shift + size * vec(0.35, 0.25, 0.9), target = middle + shift,
       field_of_view_deg = 32, zoom = set.zoom}
