#include "plumbline/harness/wire.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace plumbline {

static_assert(std::endian::native == std::endian::little, "the wire carries little-endian doubles");

std::string encode(const Frame& frame) {
  // Engines print in any encoding: bytes that are not UTF-8 are replaced, never a reason to throw.
  const std::string json = frame.json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string text = "Content-Length: " + std::to_string(json.size()) + "\r\n";
  if (!frame.block.empty()) text += "Binary-Length: " + std::to_string(frame.block.size()) + "\r\n";
  text += "\r\n" + json;
  text.append(reinterpret_cast<const char*>(frame.block.data()), frame.block.size());
  return text;
}

void FrameReader::read_header() {
  const std::size_t end = buffer_.find("\r\n\r\n");
  if (end == std::string::npos) {
    if (buffer_.size() > kMaxHeaderBytes) throw std::runtime_error("no frame header within 4096 bytes");
    return;
  }
  json_bytes_ = block_bytes_ = 0;
  bool have_length = false;
  std::size_t at = 0;
  while (at < end) {
    const std::size_t line_end = buffer_.find("\r\n", at);
    const std::string_view line(buffer_.data() + at, line_end - at);
    const auto number_after = [&](std::string_view key) -> std::optional<std::size_t> {
      if (!line.starts_with(key)) return std::nullopt;
      std::size_t value = 0;
      const auto [p, error] = std::from_chars(line.data() + key.size(), line.data() + line.size(), value);
      if (error != std::errc() || p != line.data() + line.size()) {
        throw std::runtime_error("bad frame header: " + std::string(line.substr(0, 80)));
      }
      return value;
    };
    if (const auto content = number_after("Content-Length: ")) {
      json_bytes_ = *content;
      have_length = true;
    } else if (const auto binary = number_after("Binary-Length: ")) {
      block_bytes_ = *binary;
    } else {
      throw std::runtime_error("bad frame header: " + std::string(line.substr(0, 80)));
    }
    at = line_end + 2;
  }
  if (!have_length) throw std::runtime_error("frame header without Content-Length");
  if (json_bytes_ > kMaxJsonBytes) throw std::runtime_error("frame announces too long a JSON part");
  if (block_bytes_ > max_block_bytes_) throw std::runtime_error("frame announces a larger block than was asked for");
  buffer_.erase(0, end + 4);
  have_header_ = true;
}

std::optional<Frame> FrameReader::next() {
  if (!have_header_) read_header();
  if (!have_header_ || buffer_.size() < json_bytes_ + block_bytes_) return std::nullopt;
  Frame frame;
  frame.json = nlohmann::json::parse(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(json_bytes_));
  frame.block.resize(block_bytes_);
  if (block_bytes_ > 0) std::memcpy(frame.block.data(), buffer_.data() + json_bytes_, block_bytes_);
  buffer_.erase(0, json_bytes_ + block_bytes_);
  have_header_ = false;
  return frame;
}

std::vector<std::byte> pack(const Trajectory& trajectory) {
  std::vector<std::byte> block(trajectory.states().size() * kStateDoubles * sizeof(double));
  std::byte* to = block.data();
  for (const BodyState& s : trajectory.states()) {
    const double row[kStateDoubles] = {s.p_WB.x(), s.p_WB.y(), s.p_WB.z(), s.q_WB.w(), s.q_WB.x(),
                                       s.q_WB.y(), s.q_WB.z(), s.v_WB.x(), s.v_WB.y(), s.v_WB.z(),
                                       s.w_WB.x(), s.w_WB.y(), s.w_WB.z()};
    std::memcpy(to, row, sizeof row);
    to += sizeof row;
  }
  return block;
}

Trajectory unpack(std::span<const std::byte> block, double dt, std::size_t bodies) {
  const std::size_t sample_bytes = bodies * kStateDoubles * sizeof(double);
  if (sample_bytes == 0 || block.size() % sample_bytes != 0) {
    throw std::runtime_error("a block of " + std::to_string(block.size()) + " bytes is no whole number of samples");
  }
  Trajectory trajectory(dt, bodies);
  trajectory.reserve(block.size() / sample_bytes);
  const std::byte* from = block.data();
  for (std::size_t k = 0; k < block.size() / sample_bytes; ++k) {
    for (BodyState& s : trajectory.append()) {
      double row[kStateDoubles];
      std::memcpy(row, from, sizeof row);
      from += sizeof row;
      s.p_WB = Vec3(row[0], row[1], row[2]);
      s.q_WB = Quat(row[3], row[4], row[5], row[6]);
      s.v_WB = Vec3(row[7], row[8], row[9]);
      s.w_WB = Vec3(row[10], row[11], row[12]);
    }
  }
  return trajectory;
}

namespace {

// JSON has no infinity; an engine's "no limit" travels as {"number": "inf"}, so that it cannot pass for a word.
nlohmann::json value_to_json(const SettingValue& value) {
  if (const auto* number = std::get_if<double>(&value); number != nullptr && !std::isfinite(*number)) {
    return {{"number", shortest(*number)}};
  }
  return std::visit([](const auto& v) { return nlohmann::json(v); }, value);
}

SettingValue value_from_json(const nlohmann::json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number()) return json.get<double>();
  if (json.is_object()) return std::stod(json.at("number").get<std::string>());
  return json.get<std::string>();
}

}  // namespace

nlohmann::json to_json(const Settings& settings) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, value] : settings) json[name] = value_to_json(value);
  return json;
}

Settings settings_from_json(const nlohmann::json& json) {
  Settings settings;
  for (const auto& [name, value] : json.items()) settings[name] = value_from_json(value);
  return settings;
}

nlohmann::json to_json(const EngineInfo& info) {
  nlohmann::json features = nlohmann::json::array(), settings = nlohmann::json::array();
  for (std::size_t i = 0; i < kFeatureCount; ++i) {
    if (info.features.contains(static_cast<Feature>(i))) features.push_back(feature_name(static_cast<Feature>(i)));
  }
  for (const Setting& s : info.settings) {
    settings.push_back({{"name", s.name},
                        {"default", value_to_json(s.default_value)},
                        {"matched", value_to_json(s.matched_value)},
                        {"unit", s.unit},
                        {"meaning", s.meaning}});
  }
  return {{"name", info.name},
          {"library", info.library},
          {"version", info.version},
          {"precision", info.precision == Precision::kSingle ? "single" : "double"},
          {"dimension", info.dimension},
          {"scheme", info.scheme},
          {"velocity_offset", info.velocity_offset},
          {"features", features},
          {"settings", settings}};
}

EngineInfo engine_info_from_json(const nlohmann::json& json) {
  EngineInfo info;
  info.name = json.at("name");
  info.library = json.at("library");
  info.version = json.at("version");
  info.precision = json.at("precision") == "single" ? Precision::kSingle : Precision::kDouble;
  info.dimension = json.at("dimension");
  info.scheme = json.at("scheme");
  info.velocity_offset = json.at("velocity_offset");
  for (const auto& name : json.at("features")) {
    for (std::size_t i = 0; i < kFeatureCount; ++i) {
      if (name == feature_name(static_cast<Feature>(i))) info.features.insert(static_cast<Feature>(i));
    }
  }
  for (const auto& s : json.at("settings")) {
    info.settings.push_back({s.at("name"), value_from_json(s.at("default")), value_from_json(s.at("matched")),
                             s.at("unit"), s.at("meaning")});
  }
  return info;
}

}  // namespace plumbline
