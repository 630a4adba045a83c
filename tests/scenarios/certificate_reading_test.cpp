// [[certificate]]: what it becomes, and its faults.
#include <gtest/gtest.h>

#include <cmath>

#include "faulty_copy.hpp"

namespace plumbline {
namespace {

// The certificate begins in line 21.
const std::string kSound = R"(id = "test/throw"
about = "two balls fly apart"
source = "none"
duration = 2
[parameters]
v = 3
[scales]
length = 1
time = 1
mass = 1
[[body]]
name = "ball"
shape = { sphere = 0.5 }
mass = 1
velocity = ["v", 0, 0]
[[body]]
name = "the other-one"
shape = { sphere = 0.5 }
mass = 1
position = [0, 0, 7]
[[certificate]]
quantity = "ball_x - v*t + the_other_one_z"
equals = "2*v + 1"
within = 1e-12
source = "by hand"
[reference]
kind = "closed_form"
ball.x = "v*t"
[[gate]]
metric = "position.max"
limit = 1
reason = "none"
)";

std::string fault(const std::string& sound, const std::string& faulty) {
  return fault_of(replaced(kSound, sound, faulty));
}

TEST(CertificateReader, ReadsStatesOfTheReferenceAtAnyTime) {
  const Case c = read_scenario(kSound, "f.toml").at(0);
  const Certificate& certificate = c.scenario.certificates.at(0);
  EXPECT_EQ(certificate.text, "ball_x - v*t + the_other_one_z = 2*v + 1");
  EXPECT_EQ(certificate.source, "by hand");
  EXPECT_FALSE(certificate.time.has_value());
  EXPECT_EQ(certificate.within, 1e-12);
  EXPECT_EQ(certificate.place.file, "f.toml");
  EXPECT_EQ(certificate.place.line, 22);
  EXPECT_DOUBLE_EQ(certificate.difference(*c.reference, 0.5), 0);
  const Case off = read_scenario(replaced(kSound, "ball.x = \"v*t\"", "ball.x = \"v*t + t^2\""), "f.toml").at(0);
  EXPECT_DOUBLE_EQ(off.scenario.certificates.at(0).difference(*off.reference, 0.5), 0.25);
}

TEST(CertificateReader, ReadsOneTime) {
  const Case c = read_scenario(replaced(kSound, "within", "time = \"v/2\"\nwithin"), "f.toml").at(0);
  EXPECT_EQ(c.scenario.certificates.at(0).time, 1.5);
}

TEST(CertificateReader, SaysWhatIsWrongAndTheWayOut) {
  EXPECT_NE(fault("\"ball_x", "\"bal_x").find("f.toml:22:12: /certificate/0/quantity: unknown symbol 'bal_x'"),
            std::string::npos);
  EXPECT_EQ(fault("source = \"by hand\"\n", ""),
            "f.toml:21:1: /certificate/0/source: is missing; add source = \"where it is published, or how it was "
            "derived\"");
  EXPECT_EQ(fault("within = 1e-12\n", ""), "f.toml:21:1: /certificate/0/within: is missing; add within = 1e-12");
  EXPECT_EQ(fault("within = 1e-12", "within = 0"), "f.toml:24:10: /certificate/0/within: must be > 0, is 0");
  EXPECT_EQ(fault("within = 1e-12", "within = 1e-12\ntime = 3"),
            "f.toml:25:8: /certificate/0/time: is 3, outside the duration of 2 s");
  EXPECT_EQ(fault("within = 1e-12", "within = 1e-12\ntime = -1"),
            "f.toml:25:8: /certificate/0/time: is -1, outside the duration of 2 s");
  EXPECT_EQ(
      fault("equals = ", "equal = "),
      "f.toml:23:1: /certificate/0/equal: unknown key; did you mean 'equals'? allowed here: quantity, equals, time, "
      "within, source");
}

}  // namespace
}  // namespace plumbline
