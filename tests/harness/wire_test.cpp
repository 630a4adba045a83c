#include "plumbline/harness/wire.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace plumbline {
namespace {

Trajectory awkward_trajectory() {
  Trajectory t(0.5, 2);
  for (int k = 0; k < 3; ++k) {
    auto states = t.append();
    states[0].p_WB = Vec3(std::nan(""), std::numeric_limits<double>::infinity(), -0.0);
    states[0].q_WB = Quat(0.1, 0.2, 0.3, 0.4);
    states[1].v_WB = Vec3(5e-324, 0.1, -1e308);
    states[1].w_WB = Vec3(k, k, k);
  }
  return t;
}

TEST(Wire, CarriesEveryBitOfATrajectory) {
  const Trajectory sent = awkward_trajectory();
  const Trajectory got = unpack(pack(sent), sent.dt(), sent.bodies());
  ASSERT_EQ(got.samples(), sent.samples());
  const auto* a = reinterpret_cast<const double*>(sent.states().data());
  const auto* b = reinterpret_cast<const double*>(got.states().data());
  for (std::size_t i = 0; i < sent.states().size() * kStateDoubles; ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << "number " << i;
  }
}

TEST(Wire, SendsQuaternionsAsWXYZ) {
  Trajectory t(1, 1);
  t.append()[0].q_WB = Quat(0.5, 0.1, 0.2, 0.3);
  const auto block = pack(t);
  EXPECT_EQ(reinterpret_cast<const double*>(block.data())[3], 0.5);
}

TEST(Wire, RefusesABlockThatIsNoWholeNumberOfSamples) {
  EXPECT_THROW(unpack(std::vector<std::byte>(105), 1, 1), std::runtime_error);
}

TEST(FrameReader, ReassemblesFramesThatArriveByteByByte) {
  Frame frame{{{"id", 7}, {"text", "\r\n\r\nContent-Length: 3"}}, std::vector<std::byte>(1000, std::byte{42})};
  const std::string bytes = encode(frame) + encode(frame);
  FrameReader reader(1000);
  int frames = 0;
  for (char c : bytes) {
    reader.feed({&c, 1});
    while (const auto got = reader.next()) {
      EXPECT_EQ(got->json, frame.json);
      EXPECT_EQ(got->block, frame.block);
      ++frames;
    }
  }
  EXPECT_EQ(frames, 2);
}

TEST(FrameReader, RefusesWhatIsNoFrame) {
  const auto refuses = [](std::string bytes) {
    FrameReader reader(100);
    reader.feed(bytes);
    EXPECT_THROW(reader.next(), std::exception) << bytes.substr(0, 60);
  };
  refuses("Hello\r\n\r\n");
  refuses("Content-Length: -5\r\n\r\n");
  refuses("Content-Length: 5x\r\n\r\n");
  refuses("Binary-Length: 5\r\n\r\n");
  refuses("Content-Length: 99999999999999999999999\r\n\r\n");
  refuses("Content-Length: 17000000\r\n\r\n");                   // over the limit of 16 MiB
  refuses("Content-Length: 2\r\nBinary-Length: 101\r\n\r\n{}");  // one byte more than was asked for
  refuses("Content-Length: 2\r\n\r\n{]");
  refuses(std::string(5000, 'x'));
}

TEST(Wire, CarriesEngineInfoWhole) {
  EngineInfo info;
  info.name = "row";
  info.library = "Lib";
  info.version = "1.2";
  info.precision = Precision::kSingle;
  info.dimension = 2;
  info.scheme = "semi-implicit Euler";
  info.velocity_offset = 0.5;
  info.features = {Feature::kFriction, Feature::kBoxBox};
  info.settings = {{"sleeping", true, false, "", "m"},
                   {"erp", 0.2, 0.0, "1", "m"},
                   {"solver", std::string("a"), std::string("b"), "", "m"},
                   {"cap", std::numeric_limits<double>::infinity(), -1.0, "m/s", "m"},
                   {"word", std::string("inf"), std::string("x"), "", "m"}};
  EngineInfo got = engine_info_from_json(to_json(info));
  EXPECT_EQ(to_json(got), to_json(info));
  EXPECT_EQ(got.features, info.features);
  EXPECT_EQ(settings_of(got, Profile::kDefault), settings_of(info, Profile::kDefault));
  EXPECT_EQ(settings_of(got, Profile::kMatched), settings_of(info, Profile::kMatched));
}

}  // namespace
}  // namespace plumbline
