#include "plumbline/core/constraints/rag_doll.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plumbline/core/constraints/angle_range.hpp"
#include "plumbline/core/constraints/link_constraint.hpp"

namespace plumbline {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

// One bone: which joints, its share of the mass, and where its centre of mass is on the way from the first to the
// second.
struct Bone {
  DollJoint from, to;
  double share, centre;
};

constexpr double kTrunk = 0.4346, kTrunkCentre = 0.4310;  // from the line of the shoulders to that of the hips

constexpr Bone kBones[] = {
    {kHead, kNeck, 0.0694, 0.5002},  // vertex to the last vertebra of the neck
    {kLeftShoulder, kLeftElbow, 0.0271, 0.5772},
    {kLeftElbow, kLeftHand, 0.0162, 0.4574},
    {kLeftHip, kLeftKnee, 0.1416, 0.4095},
    {kLeftKnee, kLeftFoot, 0.0433, 0.4459},
    {kRightShoulder, kRightElbow, 0.0271, 0.5772},
    {kRightElbow, kRightHand, 0.0162, 0.4574},
    {kRightHip, kRightKnee, 0.1416, 0.4095},
    {kRightKnee, kRightFoot, 0.0433, 0.4459},
    {kLeftShoulder, kLeftHip, kTrunk / 2, kTrunkCentre},
    {kRightShoulder, kRightHip, kTrunk / 2, kTrunkCentre},
};
constexpr double kHand = 0.0061, kFoot = 0.0137;

// What of the frame the bones above do not hold yet.
constexpr std::pair<DollJoint, DollJoint> kFrame[] = {
    {kNeck, kLeftShoulder},          {kNeck, kRightShoulder}, {kNeck, kLeftHip},          {kNeck, kRightHip},
    {kLeftShoulder, kRightShoulder}, {kLeftHip, kRightHip},   {kLeftShoulder, kRightHip}, {kRightShoulder, kLeftHip},
};

struct Limit {
  DollJoint first, joint, third;
  double low, high;  // [degrees]
};

constexpr Limit kLimits[] = {
    {kLeftShoulder, kLeftElbow, kLeftHand, 30, 180},
    {kRightShoulder, kRightElbow, kRightHand, 30, 180},
    {kLeftHip, kLeftKnee, kLeftFoot, 40, 180},
    {kRightHip, kRightKnee, kRightFoot, 40, 180},
    {kHead, kNeck, kLeftShoulder, 70, 140},
    {kHead, kNeck, kRightShoulder, 70, 140},
    {kRightShoulder, kLeftShoulder, kLeftElbow, 60, 180},
    {kLeftShoulder, kRightShoulder, kRightElbow, 60, 180},
    {kRightHip, kLeftHip, kLeftKnee, 75, 150},
    {kLeftHip, kRightHip, kRightKnee, 75, 150},
    {kLeftShoulder, kLeftHip, kLeftKnee, 60, 180},
    {kRightShoulder, kRightHip, kRightKnee, 60, 180},
};
static_assert(std::size(kBones) + std::size(kFrame) == kDollLinks && std::size(kLimits) == kDollAngles);

// In the x-z plane, from straight down towards +x.
Vec3 leaning(double degrees) { return {std::sin(degrees * kDegree), 0, -std::cos(degrees * kDegree)}; }

std::vector<Vec3> standing() {
  std::vector<Vec3> p(kDollJoints);
  for (const int side : {1, -1}) {  // the left is +y
    const std::size_t first = side > 0 ? kLeftShoulder : kRightShoulder;
    const double y = side;
    p[first] = Vec3(0, 0.18 * y, 0);
    p[first + 1] = p[first] + 0.2817 * Vec3(0, y * std::cos(40 * kDegree), -std::sin(40 * kDegree));
    p[first + 2] = p[first + 1] + 0.2689 * Vec3(std::sin(20 * kDegree), y * std::cos(20 * kDegree), 0);
    p[first + 3] = Vec3(0, 0.09 * y, -0.5155);
    p[first + 4] = p[first + 3] + 0.4222 * leaning(8);
    p[first + 5] = p[first + 4] + 0.4340 * leaning(-8);
  }
  p[kNeck] = Vec3(-0.06, 0, 0.06);
  p[kHead] = p[kNeck] + 0.2429 * Vec3::UnitZ();
  const double foot = p[kLeftFoot].z();
  for (Vec3& joint : p) joint.z() -= foot;
  return p;
}

}  // namespace

Assembly make_rag_doll(double mass) {
  if (!(mass > 0)) throw std::invalid_argument("a rag doll needs a mass > 0");
  std::vector<double> shares(kDollJoints, 0.0);
  for (const Bone& bone : kBones) {
    shares[bone.from] += bone.share * (1 - bone.centre);
    shares[bone.to] += bone.share * bone.centre;
  }
  for (const DollJoint hand : {kLeftHand, kRightHand}) shares[hand] += kHand;
  for (const DollJoint foot : {kLeftFoot, kRightFoot}) shares[foot] += kFoot;

  Assembly doll;
  const std::vector<Vec3> p = standing();
  for (std::size_t i = 0; i < kDollJoints; ++i) doll.add_particle(mass * shares[i], p[i]);
  const auto link = [&](DollJoint a, DollJoint b) { doll.constraints.add(LinkConstraint(a, b, (p[b] - p[a]).norm())); };
  for (const Bone& bone : kBones) link(bone.from, bone.to);
  for (const auto& [a, b] : kFrame) link(a, b);
  for (const Limit& limit : kLimits)
    doll.constraints.add(AngleRange(limit.first, limit.joint, limit.third, limit.low * kDegree,
                                    std::min(limit.high * kDegree, std::numbers::pi)));
  return doll;
}

}  // namespace plumbline
