#include "output_file.hpp"
#include "plumbline/exchange/motion_export.hpp"

namespace plumbline {
namespace {

// Names are any text; a file name must not leave its folder.
std::string as_file_name(const std::string& name) {
  std::string result;
  for (const char c : name) result += c == '/' || static_cast<unsigned char>(c) < 0x20 ? '_' : c;
  return result;
}

}  // namespace

std::vector<std::filesystem::path> write_tum(const Motion& motion, const std::filesystem::path& file) {
  std::vector<std::filesystem::path> written;
  for (std::size_t b = 0; b < motion.names.size(); ++b) {
    std::string text = "# t x y z qx qy qz qw of " + as_file_name(motion.names[b]) + ", " + motion.title + "\n";
    for (std::size_t k = 0; k < motion.times.size(); ++k) {
      const BodyState& s = motion.at(k, b);
      text += shortest(motion.times[k]);
      for (const double x : {s.p_WB.x(), s.p_WB.y(), s.p_WB.z(), s.q_WB.x(), s.q_WB.y(), s.q_WB.z(), s.q_WB.w()}) {
        text += ' ' + shortest(x);
      }
      text += '\n';
    }
    std::filesystem::path path = file;
    if (motion.names.size() > 1) {
      path.replace_filename(file.stem().string() + "." + as_file_name(motion.names[b]) + file.extension().string());
    }
    exchange::write_file(path, text);
    written.push_back(std::move(path));
  }
  return written;
}

}  // namespace plumbline
