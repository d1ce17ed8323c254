-- A wooden seat on two ropes of hemp, glued on, in gusts of wind.

local set = scene{
  summary = "a wooden seat on two ropes in gusting wind",
  seconds = 8,
  parameters = {
    {name = "push", value = 1.5, unit = "m/s", meaning = "speed of the seat at the start",
     least = -10, most = 10},
    {name = "wind", value = 12, unit = "m/s", meaning = "of the gusts at their height",
     least = -40, most = 40},
    {name = "softening", value = 400,
     meaning = "S of wood and hemp: modulus / S, strain at break x sqrt S", least = 1, most = 1e4},
  },
}

-- m
local bar = 2.2          -- height of what the ropes hang from
local seat_top = 0.5     -- above the floor
local half_width = 0.2   -- between the middle of the seat and a rope
local spacing = 0.05     -- of the seat's cells
local gap = 0.02         -- between a rope's end and the seat

-- Damped by joints, and by the person who sits still on it.
local spruce = material{like = "spruce", softening = set.softening, damping_ratio = 0.1}
local seat = shape.box{name = "seat", size = {0.5, spacing, 0.2}, cells = {10, 1, 4},
                       corner = {-0.25, seat_top - spacing, -0.1}, material = spruce,
                       colour = {0.6, 0.4, 0.2}}
seat:drag{normal = 1.2, tangential = 0.01}

-- Laid, not drawn: softer than its fibres, and as strong.
local fibre = material{like = "hemp"}
local hemp = material{like = fibre, youngs_modulus = fibre.youngs_modulus / 10,
                      strain_at_break = fibre.strain_at_break * 10, damping_ratio = 0.2,
                      softening = set.softening}

local function hanging_rope(name, x)
  local rope = shape.rope{name = name, points = {{x, bar, 0}, {x, seat_top + gap, 0}},
                          segments = 16, diameter = 0.012, material = hemp,
                          colour = {0.75, 0.65, 0.4}}
  return rope:pin{index = 1}
end

-- A knot is as stiff and strong as the wood over one square; it holds the nearest point and its four
-- neighbours.
local knot = bond{material = material{like = "spruce", softening = set.softening},
                  area = spacing * spacing, gap = gap}
knot.distance = math.sqrt(gap ^ 2 + spacing ^ 2) + 1e-6
knot.stiffness = knot.stiffness / 5
knot.damping = 2 * math.sqrt(knot.stiffness * seat:point{index = 1}.mass) * 0.1

local swing = seat:glue{to = hanging_rope("left rope", -half_width), bond = knot}
swing = swing:glue{to = hanging_rope("right rope", half_width), bond = knot}
swing:rename{name = "swing"}

-- It turns about the bar: what hangs lower is faster.
for i = 1, swing:points() do
  local below_bar = (bar - swing:point{index = i}.position.y) / (bar - seat_top)
  swing:set_point{index = i, velocity = {0, 0, set.push * below_bar}}
end
spawn{model = swing}

-- Puffs along the swing's way, one about every period of 2.7 s.
local gusts = {}
for i = 0, 5 do
  local t = 2.7 * i
  table.insert(gusts, {t + 0.1, 0.1 * set.wind})
  table.insert(gusts, {t + 0.6, set.wind})
  table.insert(gusts, {t + 1.2, 0.1 * set.wind})
end
wind.uniform{direction = {0, 0, 1}, speed = gusts}

-- An eddy that drifts past and turns the seat.
wind.vortex{axis = {0, 1, 0}, position = {{2, {-3, 0, 0.4}}, {6, {3, 0, 0.4}}},
            strength = 0.5 * set.wind, core_radius = 0.3}

rigid.box{name = "bar", size = {1, 0.06, 0.06}, position = {0, bar + 0.035, 0},
          colour = {0.4, 0.3, 0.2}}
camera{position = {3.4, 1.5, 2.6}, target = {0, 1.15, 0}, field_of_view_deg = 34}
