#include "tests/fuzz/script_from_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "demos/scripting/api.h"

namespace limber::demos::fuzz {
namespace {

constexpr int kMostCalls = 12;

constexpr std::array kStrange = {"0",
                                 "-1",
                                 "1e300",
                                 "-1e300",
                                 "0/0",
                                 "1/0",
                                 "-1/0",
                                 "math.mininteger",
                                 "math.maxinteger",
                                 "0.5",
                                 "true",
                                 "''",
                                 "'porcelain'",
                                 "('x'):rep(2000)",
                                 "{}",
                                 "{1, 2}",
                                 "{0, 0, 0}",
                                 "{0/0, 1, 2}",
                                 "{1e300, 1e300, 1e300}",
                                 "vec(1, 0, 0)",
                                 "vec(0/0, 0, 0)",
                                 "{{0, 1}, {1, 2}}",
                                 "{{1, 1}, {0, 2}}",
                                 "{{0, 0, 0}, {0, 1, 0}}",
                                 "{{}}",
                                 "{a = 1}",
                                 "{[{}] = 1}",
                                 "setmetatable({}, {__index = function() return 1 end})",
                                 "print",
                                 "function() end",
                                 "function() error('no') end",
                                 "function() return 1, 2 end",
                                 "function() while true do end end",
                                 "function() return vec(0/0, 0, 0) end",
                                 "_G",
                                 "string",
                                 "nil",
                                 "object",
                                 "ball",
                                 "gust",
                                 "pot",
                                 "clay",
                                 "{pot}",
                                 "{ball, ball}",
                                 "1e-320",
                                 "1e9"};

// The bytes one after the other, zeros after the last.
class Decisions {
 public:
  explicit Decisions(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool ended() const { return next_ >= bytes_.size(); }
  unsigned byte() { return ended() ? 0u : bytes_[next_++]; }
  std::size_t below(std::size_t count) { return (256 * byte() + byte()) % count; }
  bool once_in(unsigned times) { return byte() % times == 0; }
  double share() { return static_cast<double>(byte()) / 255.0; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
};

// Within the field's range: at its ends as often as between them.
std::string number_for(const Field& field, Decisions& from) {
  const double low = std::max(field.least, -10.0), high = std::clamp(field.most, low, low + 10.0);
  switch (from.byte() % 4) {
    case 0:
      return fmt::format("{:.17g}", field.least);
    case 1:
      return fmt::format("{:.17g}", std::min(field.most, 1e6));
    default:
      return fmt::format("{:.6g}", low + (high - low) * from.share());
  }
}

std::string vector_for(const Field& field, Decisions& from) {
  const std::string x = number_for(field, from), y = number_for(field, from);
  return fmt::format("{{{}, {}, {}}}", x, y, number_for(field, from));
}

std::string whole_for(const Field& field, Decisions& from) {
  const double low = std::max(field.least, 0.0);
  return fmt::format("{:.0f}", std::min(field.most, low + static_cast<double>(from.byte() % 6)));
}

std::string fields_for(const std::vector<Field>& fields, Decisions& from);

std::string fitting(const Field& field, Decisions& from) {
  switch (field.kind) {
    case Kind::kNumber:
      return number_for(field, from);
    case Kind::kWhole:
      return whole_for(field, from);
    case Kind::kFlag:
      return from.once_in(2) ? "true" : "false";
    case Kind::kText:
      return "'thing'";
    case Kind::kChoice:
      return "'" + field.choices[from.below(field.choices.size())] + "'";
    case Kind::kVector:
    case Kind::kDirection:
    case Kind::kColour:
      return vector_for(field, from);
    case Kind::kWholes:
      return fmt::format("{{{0}, {1}, {0}}}", whole_for(field, from), whole_for(field, from));
    case Kind::kSteps:
      return fmt::format("{{{{0, {}}}, {{1, 2}}}}", number_for(field, from));
    case Kind::kPath:
      return fmt::format("{{{{0, {}}}, {{1, {{0, 1, 0}}}}}}", vector_for(field, from));
    case Kind::kVectors:
      return fmt::format("{{{}, {}, {}, {}}}", vector_for(field, from), vector_for(field, from),
                         vector_for(field, from), vector_for(field, from));
    case Kind::kNumbers:
      return fmt::format("{{{}, {}, {}}}", number_for(field, from), number_for(field, from),
                         number_for(field, from));
    case Kind::kFunction:
      return from.once_in(2) ? "function(t) return 0.05, 0.1 * t end"
                             : "function(u, v) return vec(u, 1, v or 0) end";
    case Kind::kMaterial:
      return "clay";
    case Kind::kModel:
      return "pot";
    case Kind::kThing:
      return from.once_in(2) ? "object" : "ball";
    case Kind::kBody:
      return "ball";
    case Kind::kRecord:
      return fields_for(field.fields, from);
    case Kind::kRecords:
      return fmt::format("{{{}, {}}}", fields_for(field.fields, from),
                         fields_for(field.fields, from));
  }
  return "nil";
}

std::string value_for(const Field& field, Decisions& from) {
  if (from.once_in(6)) return kStrange[from.below(kStrange.size())];
  return fitting(field, from);
}

std::string fields_for(const std::vector<Field>& fields, Decisions& from) {
  std::string text = "{";
  for (const Field& field : fields) {
    const bool required = std::holds_alternative<Field::Required>(field.otherwise);
    if (required ? from.once_in(30) : !from.once_in(3)) continue;
    text += field.name + " = " + value_for(field, from) + ", ";
  }
  if (from.once_in(40)) text += "nonsense = 1";
  return text + "}";
}

std::string receiver_of(const std::string& type) {
  if (type == "model") return "pot";
  if (type == "object") return "object";
  if (type == "body") return "ball";
  return type == "flow" ? "gust" : "clay";
}

std::string call_text(const ApiFunction& function, Decisions& from) {
  const std::string fields = from.once_in(20) ? std::string(kStrange[from.below(kStrange.size())])
                                              : fields_for(function.fields, from);
  if (!function.is_method()) return fmt::format("try({}, {})\n", function.full_name(), fields);
  return fmt::format("try({0}.{1}, {0}, {2})\n", receiver_of(function.owner), function.name,
                     fields);
}

std::string calls_text(Decisions& from) {
  std::string calls;
  const auto& functions = api_functions();
  for (int i = 0; i < kMostCalls && !from.ended(); ++i) {
    calls += "  " + call_text(functions[from.below(functions.size())], from);
  }
  return calls;
}

// What calls act on; what they make takes its place.
constexpr const char* kBefore = R"(
local clay = material{like = "stoneware", softening = 1e4, damping_ratio = 0.2}
local pot = shape.box{size = {0.1, 0.1, 0.1}, cells = {1, 1, 1}, material = clay}
local object = spawn{name = "thing", position = {0, 0.06, 0}, model = pot}
local ball = rigid.sphere{radius = 0.1, mass = 1, position = {0, 0.3, 0}}
local gust = wind.uniform{direction = {1, 0, 0}, speed = 1}
local function try(f, ...)
  local good, made = pcall(f, ...)
  if not good then
    assert(type(made) == "string" and #made > 10, "no message")
  elseif type(made) == "userdata" then
    local kind = tostring(made)
    if kind == "model" then pot = made elseif kind == "object" then object = made
    elseif kind == "body" then ball = made elseif kind == "flow" then gust = made
    elseif kind == "material" then clay = made end
  end
end
)";

}  // namespace

std::string script_from_bytes(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return "";
  if (bytes[0] == kAsItStands) return {bytes.begin() + 1, bytes.end()};
  Decisions from(bytes.subspan(1));
  std::string text = kBefore;
  text += calls_text(from);
  text += "function on_start()\n" + calls_text(from) + "end\n";
  text += "function on_tick()\n" + calls_text(from) + "end\n";
  text += "function on_contact(e) try(e.thing.position, e.thing) end\n";
  return text;
}

}  // namespace limber::demos::fuzz
