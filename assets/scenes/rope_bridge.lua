-- Planks on two ropes, and a crate that is dropped onto them.

local set = scene{
  summary = "a crate falls onto a bridge of planks and ropes",
  seconds = 4,
  parameters = {
    {name = "mass", value = 20, unit = "kg", meaning = "of the crate", least = 1, most = 500},
    {name = "height", value = 0.1, unit = "m", meaning = "that it falls", least = 0, most = 5},
    {name = "softening", value = 500, meaning = "S of wood and rope: modulus / S", least = 50,
     most = 1e4},
  },
}

local span, deck, width, planks = 2.4, 1, 0.5, 9 -- m, m, m
local pitch = span / (planks + 1)

-- Laid rope, tightly: a third as stiff as its fibres, and as strong.
local fibre = material{like = "hemp"}
local hemp = material{like = fibre, youngs_modulus = fibre.youngs_modulus / 3,
                      strain_at_break = fibre.strain_at_break * 3, damping_ratio = 0.3,
                      softening = set.softening}
local spruce = material{like = "spruce", damping_ratio = 0.3, softening = set.softening}

-- A rope between the cliffs, held at both ends; three segments for each plank.
local function carrier(z)
  local rope = shape.rope{name = "rope", points = {{-0.5 * span, deck, z}, {0.5 * span, deck, z}},
                          segments = 3 * (planks + 1), diameter = 0.02, material = hemp,
                          colour = {0.75, 0.65, 0.4}}
  return rope:pin{index = 1}:pin{index = rope:points()}
end

local bridge = carrier(-0.4 * width)
local knots = bond{material = spruce, area = 4e-4, gap = 0.02}
knots.distance = 0.05
local function add(part, to) return to:glue{to = part, bond = knots} end

for i = 1, planks do
  local x = -0.5 * span + i * pitch
  bridge = add(shape.box{name = "plank " .. i, size = {0.12, 0.04, width}, cells = {2, 1, 10},
                         centre = {x, deck + 0.04, 0}, material = spruce,
                         colour = {0.55, 0.36, 0.18}}, bridge)
end
bridge = add(carrier(0.4 * width), bridge)
bridge:set_damping{ratio = 0.3}
spawn{model = bridge, name = "bridge"}

for _, side in ipairs{-1, 1} do
  rigid.box{name = "cliff", size = {0.8, deck + 0.03, 1.2},
            position = {side * (0.5 * span + 0.42), 0.5 * (deck + 0.03), 0},
            colour = {0.4, 0.38, 0.35}}
end
local crate = rigid.box{name = "crate", size = {0.3, 0.3, 0.3}, mass = set.mass, friction = 0.6,
                        position = {0.1, deck + 0.07 + 0.15 + set.height, 0}, colour = {0.7, 0.45, 0.2}}
after{seconds = 3.9, call = function()
  local p = crate:position()
  local on = math.abs(p.x) < 0.5 * span and math.abs(p.z) < 0.5 * width and p.y > 0.5 * deck
  print("the crate is " .. (on and "on the bridge" or "down"))
end}
camera{position = {1.6, 1.9, 3.4}, target = {0, 0.85, 0}, field_of_view_deg = 34}
