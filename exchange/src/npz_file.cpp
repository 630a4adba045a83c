// An NPZ is a ZIP archive of NPY files, an NPY one array behind a text header. Formats: numpy.lib.format, version 1.0;
// PKWARE's APPNOTE.TXT, sections 4.3.7 (local header), 4.3.12 (central directory), 4.3.16 (its end). Entries are
// stored, not compressed: doubles of a motion hardly shrink, and stored ones can be mapped into memory.
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "output_file.hpp"
#include "plumbline/exchange/motion_export.hpp"

namespace plumbline {
namespace {

static_assert(std::numeric_limits<double>::is_iec559, "NPY's <f8 is what memory holds");

void put(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

void put(std::string& out, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  put(out, bits, 8);
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t kBefore = 10, kAlignment = 64;  // magic, version, length
  while ((kBefore + header.size() + 1) % kAlignment != 0) header += ' ';
  header += '\n';
  std::string text = "\x93NUMPY";
  put(text, 1, 1);
  put(text, 0, 1);
  put(text, header.size(), 2);
  return text + header + data;
}

// The letters of UTF-8 text; what is no UTF-8 becomes U+FFFD.
std::u32string letters(const std::string& text) {
  std::u32string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned first = byte(i);
    const std::size_t more = first < 0x80 ? 0 : first >> 5 == 6 ? 1 : first >> 4 == 14 ? 2 : first >> 3 == 30 ? 3 : 4;
    char32_t letter = more == 0 ? first : first & (0x3fu >> more);
    std::size_t k = 1;
    while (more < 4 && k <= more && i + k < text.size() && byte(i + k) >> 6 == 2)
      letter = letter << 6 | (byte(i + k++) & 0x3f);
    const bool sound = more < 4 && k == more + 1 && letter <= 0x10ffff;
    result += sound ? letter : U'\ufffd';
    i += sound ? k : 1;
  }
  return result;
}

std::string names_array(const std::vector<std::string>& names) {
  std::vector<std::u32string> all;
  std::size_t longest = 1;
  for (const std::string& name : names) {
    all.push_back(letters(name));
    longest = std::max(longest, all.back().size());
  }
  std::string data;
  for (const std::u32string& name : all) {
    for (std::size_t i = 0; i < longest; ++i) put(data, i < name.size() ? name[i] : 0, 4);
  }
  return npy("<U" + std::to_string(longest), std::to_string(names.size()) + ",", data);
}

template <typename Component>
std::string state_array(const Motion& motion, int width, const Component& component) {
  std::string data;
  data.reserve(motion.states.size() * static_cast<std::size_t>(width) * 8);
  for (const BodyState& state : motion.states) {
    for (int i = 0; i < width; ++i) put(data, component(state, i));
  }
  return npy(
      "<f8",
      std::to_string(motion.times.size()) + ", " + std::to_string(motion.names.size()) + ", " + std::to_string(width),
      data);
}

class Zip {
 public:
  void add(const std::string& name, const std::string& content) {
    const std::uint64_t offset = archive_.size();
    std::string common;
    put(common, 20, 2);       // needs version 2.0
    put(common, 1 << 11, 2);  // names are UTF-8
    put(common, 0, 2);        // stored
    put(common, 0, 2);        // time and date: none, so that equal motions give equal files
    put(common, 0x21, 2);     // 1 January 1980, the first there is
    put(common, crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size()), 4);
    put(common, content.size(), 4);
    put(common, content.size(), 4);
    put(common, name.size(), 2);
    put(common, 0, 2);  // no extra field
    archive_ += "PK\3\4" + common + name + content;
    directory_ += "PK\1\2";
    put(directory_, 20, 2);
    directory_ += common;
    put(directory_, 0, 2 + 2 + 2);  // no comment, disk 0, no internal attributes
    put(directory_, 0, 4);
    put(directory_, offset, 4);
    directory_ += name;
    ++count_;
    if (archive_.size() > std::numeric_limits<std::uint32_t>::max()) {
      throw std::invalid_argument(
          "the motion exceeds 4 GiB, which an archive of this kind cannot hold; take a larger dt");
    }
  }
  std::string finished() const {
    std::string end = "PK\5\6";
    put(end, 0, 4);
    put(end, count_, 2);
    put(end, count_, 2);
    put(end, directory_.size(), 4);
    put(end, archive_.size(), 4);
    put(end, 0, 2);
    return archive_ + directory_ + end;
  }

 private:
  std::string archive_, directory_;
  std::uint64_t count_ = 0;
};

}  // namespace

void write_npz(const Motion& motion, const std::filesystem::path& file) {
  Zip zip;
  std::string times;
  for (const double t : motion.times) put(times, t);
  zip.add("t.npy", npy("<f8", std::to_string(motion.times.size()) + ",", times));
  zip.add("names.npy", names_array(motion.names));
  zip.add("position.npy", state_array(motion, 3, [](const BodyState& s, int i) { return s.p_WB(i); }));
  zip.add("attitude.npy", state_array(motion, 4, [](const BodyState& s, int i) {
            return i == 0 ? s.q_WB.w() : s.q_WB.coeffs()(i - 1);  // Eigen keeps x y z w
          }));
  zip.add("velocity.npy", state_array(motion, 3, [](const BodyState& s, int i) { return s.v_WB(i); }));
  zip.add("angular_velocity.npy", state_array(motion, 3, [](const BodyState& s, int i) { return s.w_WB(i); }));
  exchange::write_file(file, zip.finished());
}

}  // namespace plumbline
