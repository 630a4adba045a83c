// Frames between harness and worker: a JSON header and, behind it, one block of raw numbers.
//
//   Content-Length: 78\r\n
//   Binary-Length: 10400\r\n      (absent: no block)
//   \r\n
//   {"jsonrpc":"2.0",...}<10400 bytes>
//
// Numbers travel as little-endian doubles and not as JSON, which would lose NaN, infinity and -0, the very values
// that a validation suite must see.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plumbline/core/engine.hpp"
#include "plumbline/core/trajectory.hpp"

namespace plumbline {

inline constexpr int kProtocolVersion = 1;
inline constexpr std::size_t kMaxHeaderBytes = 4096;
inline constexpr std::size_t kMaxJsonBytes = std::size_t{16} << 20;

struct Frame {
  nlohmann::json json;
  std::vector<std::byte> block;
};

std::string encode(const Frame& frame);

// Takes bytes as they arrive and hands out whole frames. Nothing is allocated before its announced size was
// checked against the limits. Throws std::runtime_error on anything that is not a frame.
class FrameReader {
 public:
  explicit FrameReader(std::size_t max_block_bytes = 0) : max_block_bytes_(max_block_bytes) {}
  void allow_block(std::size_t bytes) { max_block_bytes_ = bytes; }
  void feed(std::span<const char> bytes) { buffer_.append(bytes.data(), bytes.size()); }
  std::optional<Frame> next();

 private:
  void read_header();

  std::size_t max_block_bytes_;
  std::string buffer_;
  bool have_header_ = false;
  std::size_t json_bytes_ = 0, block_bytes_ = 0;
};

// Columns of a state on the wire, 13 doubles: x y z qw qx qy qz vx vy vz wx wy wz.
inline constexpr std::size_t kStateDoubles = 13;
std::vector<std::byte> pack(const Trajectory& trajectory);
// Throws std::runtime_error when the block is not a whole number of samples.
Trajectory unpack(std::span<const std::byte> block, double dt, std::size_t bodies);

nlohmann::json to_json(const Settings& settings);
Settings settings_from_json(const nlohmann::json& json);
nlohmann::json to_json(const EngineInfo& info);
EngineInfo engine_info_from_json(const nlohmann::json& json);

}  // namespace plumbline
